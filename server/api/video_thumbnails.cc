#include "server/api/video_thumbnails.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "engine/video/display.h"
#include "server/api/image_id.h"
#include "server/api/video_json.h"
#include "server/app/video_picture.h"

namespace haarmony::server {
namespace {

constexpr std::int64_t kMostCells = 100;
constexpr std::int32_t kLongestSide = 160;
constexpr std::int32_t kColumns = 10;

// How the pictures are laid out: one for each of `cells` stretches of frames.
struct Grid {
    std::int64_t cells = 0;
    int level = 0;
    std::int32_t width = 0;  // of a cell
    std::int32_t height = 0;

    [[nodiscard]] std::int32_t columns() const {
        return static_cast<std::int32_t>(std::min<std::int64_t>(cells, kColumns));
    }
    [[nodiscard]] std::int32_t rows() const {
        return static_cast<std::int32_t>((cells + kColumns - 1) / kColumns);
    }
    [[nodiscard]] std::int32_t x(std::int64_t cell) const {
        return static_cast<std::int32_t>(cell % kColumns) * width;
    }
    [[nodiscard]] std::int32_t y(std::int64_t cell) const {
        return static_cast<std::int32_t>(cell / kColumns) * height;
    }
};

Grid grid_of(const video::ClipShape& shape) {
    Grid grid;
    grid.cells = std::min(shape.frames(), kMostCells);
    grid.level = shape.space_levels();
    while (grid.level > 0 && std::max(shape.width_at(grid.level),
                                      shape.height_at(grid.level)) > kLongestSide)
        --grid.level;
    grid.width = shape.width_at(grid.level);
    grid.height = shape.height_at(grid.level);
    return grid;
}

video::FrameRange frames_of(const video::ClipShape& shape,
                            const Grid& grid,
                            std::int64_t cell) {
    return {cell * shape.frames() / grid.cells, (cell + 1) * shape.frames() / grid.cells};
}

// "00:01:02.345": when frame `frame` begins.
std::string time_text(const video::ClipShape& shape, std::int64_t frame) {
    const video::FrameRate& rate = shape.rate();
    const std::int64_t ms =
        (2'000 * frame * rate.denominator + rate.numerator) / (2 * rate.numerator);
    char text[48];
    std::snprintf(text,
                  sizeof text,
                  "%02lld:%02lld:%02lld.%03lld",
                  static_cast<long long>(ms / 3'600'000),
                  static_cast<long long>(ms / 60'000 % 60),
                  static_cast<long long>(ms / 1'000 % 60),
                  static_cast<long long>(ms % 1'000));
    return text;
}

Result<video::Picture> sprite_of(const video::TimeTree& clip) {
    const video::ClipShape& shape = clip.shape();
    const Grid grid = grid_of(shape);
    video::Picture sprite(grid.columns() * grid.width, grid.rows() * grid.height);
    for (std::int64_t cell = 0; cell < grid.cells; ++cell) {
        const video::FrameRange frames = frames_of(shape, grid, cell);
        const auto frame = clip.frame(
            {shape.time_levels(), (frames.first + frames.end - 1) / 2}, grid.level);
        if (!frame) return frame.error();
        video::draw(*frame,
                    grid.level,
                    video::Edge::kNormalize,
                    {0, 0, grid.width, grid.height},
                    &sprite.at(grid.x(cell), grid.y(cell)),
                    sprite.width);
    }
    return sprite;
}

void set_headers(http::Response& response, const schema::Video& video) {
    response.headers["ETag"] = etag_of("thumbnails.1." + video.revision);
    response.headers["Accept-Ranges"] = "bytes";
    response.headers["Cache-Control"] = "no-cache";
    response.headers["X-Content-Type-Options"] = "nosniff";
}

}  // namespace

Reply get_thumbnail_track(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = video_id_of(request);
    if (!id) return id.problem();
    const auto video = context.videos.get(*id);
    if (!video) return video.error();
    const auto shape = shape_of(*video);
    if (!shape) return shape.error();
    const Grid grid = grid_of(*shape);
    std::string track = "WEBVTT\n";
    for (std::int64_t cell = 0; cell < grid.cells; ++cell) {
        const video::FrameRange frames = frames_of(*shape, grid, cell);
        track += '\n' + time_text(*shape, frames.first) + " --> " +
                 time_text(*shape, frames.end) +
                 "\nthumbnails.jpg#xywh=" + std::to_string(grid.x(cell)) + ',' +
                 std::to_string(grid.y(cell)) + ',' + std::to_string(grid.width) + ',' +
                 std::to_string(grid.height) + '\n';
    }
    http::Response response;
    response.headers["Content-Type"] = "text/vtt";
    set_headers(response, *video);
    response.body = std::move(track);
    return response;
}

Reply get_thumbnail_sprite(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = video_id_of(request);
    if (!id) return id.problem();
    const auto video = context.videos.clip(*id);
    if (!video) return video.error();
    const auto sprite = sprite_of((*video)->clip());
    if (!sprite) return sprite.error();
    auto bytes = encode_picture(*sprite, PictureFormat::kJpeg, std::nullopt);
    if (!bytes) return bytes.error();
    http::Response response;
    response.headers["Content-Type"] = "image/jpeg";
    set_headers(response, (*video)->row());
    response.body = *std::move(bytes);
    return response;
}

}  // namespace haarmony::server
