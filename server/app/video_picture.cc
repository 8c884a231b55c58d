#include "server/app/video_picture.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/video/pixel.h"
#include "engine/video/shutter.h"
#include "ingest/describe.h"
#include "ingest/picture_encoder.h"
#include "ingest/thumbnail.h"

namespace haarmony::server {
namespace {

// In every key: another number where the same address gives other bytes.
constexpr std::string_view kRendering = "2";

constexpr int kJpegQuality = 90;

// The background shines through what is transparent; one rounding.
video::Rgba over(video::Rgba pixel, video::Rgba background) {
    const auto mix = [&](int top, int below) {
        return static_cast<std::uint8_t>(
            (2 * (top * pixel.a + below * (255 - pixel.a)) + 255) / 510);
    };
    return {mix(pixel.r, background.r),
            mix(pixel.g, background.g),
            mix(pixel.b, background.b),
            255};
}

// The level up to which a frame has to be there, so that it can be drawn and asked for what
// is finer.
int needed_level(const video::ClipShape& shape, const VideoPicture& picture) {
    const int drawn =
        picture.root_side ? video::zoom_level(shape, *picture.root_side) : picture.level;
    return std::min(std::max(drawn + 1, video::kBrickLevel), shape.space_levels());
}

Result<video::Picture> draw_frame(const video::Frame& frame,
                                  const VideoPicture& picture) {
    if (picture.root_side)
        return video::zoom(
            frame, *picture.root_side, picture.edge, picture.box, picture.finer);
    return video::draw(frame, picture.level, picture.edge, picture.box);
}

// Of frames that no node covers.
Result<video::Picture> draw_range(const video::TimeTree& clip,
                                  const VideoPicture& picture) {
    if (picture.root_side)
        return video::zoom_shutter(clip,
                                   picture.frames,
                                   *picture.root_side,
                                   picture.edge,
                                   picture.box,
                                   picture.finer);
    return video::draw_shutter(
        clip, picture.frames, picture.level, picture.edge, picture.box);
}

// Takes the time in laps.
class Stopwatch {
  public:
    std::chrono::nanoseconds lap() {
        const Clock::time_point start = std::exchange(since_, Clock::now());
        return since_ - start;
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point since_ = Clock::now();
};

// Whether levels finer than the last one that a picture shows in full have more to show.
bool finer_in_space(const video::Frame& frame, const VideoPicture& picture) {
    const video::ClipShape& shape = frame.shape();
    if (!picture.root_side)
        return video::finer_in_space(frame, picture.level, picture.box);
    const auto side = static_cast<std::uint32_t>(*picture.root_side);
    const int whole = std::bit_width(side) - 1;  // floor(log2)
    if (whole >= shape.space_levels()) return false;
    // The box in pixels of that level, outward.
    const auto down = [&](std::int64_t at) {
        return static_cast<std::int32_t>((at << whole) / side);
    };
    const auto up = [&](std::int64_t at) {
        return static_cast<std::int32_t>(((at << whole) + side - 1) / side);
    };
    video::PixelBox box;
    box.x = down(picture.box.x);
    box.y = down(picture.box.y);
    box.width = std::min(up(std::int64_t{picture.box.x} + picture.box.width),
                         shape.width_at(whole)) -
                box.x;
    box.height = std::min(up(std::int64_t{picture.box.y} + picture.box.height),
                          shape.height_at(whole)) -
                 box.y;
    return video::finer_in_space(frame, whole, box);
}

}  // namespace

std::string_view media_type_of(PictureFormat format) {
    switch (format) {
        case PictureFormat::kPng:
            return "image/png";
        case PictureFormat::kWebp:
            return "image/webp";
        case PictureFormat::kJpeg:
            return "image/jpeg";
        case PictureFormat::kRgba:
            break;
    }
    return "application/octet-stream";
}

std::optional<video::NodeAddress> node_of(const video::ClipShape& shape,
                                          const video::FrameRange& frames) {
    const auto nodes = video::covering_nodes(shape, frames);
    return nodes.size() == 1 ? std::optional(nodes.front()) : std::nullopt;
}

std::string key_of(const schema::Video& video, const VideoPicture& picture) {
    std::string key(kRendering);
    const auto add = [&key](std::int64_t number) { key += '.' + std::to_string(number); };
    key += '.' + video.revision;
    // A node is drawn from its own averages, a range from several: these may differ.
    add(picture.node ? picture.node->time_level : -1);
    add(picture.node ? picture.node->index : picture.frames.first);
    add(picture.node ? 0 : picture.frames.end);
    add(picture.root_side ? -1 : picture.level);
    add(picture.root_side.value_or(0));
    for (const std::int32_t side :
         {picture.box.x, picture.box.y, picture.box.width, picture.box.height})
        add(side);
    add(static_cast<int>(picture.edge));
    add(static_cast<int>(picture.finer));
    add(static_cast<int>(picture.format));
    if (const auto& background = picture.background)
        add(background->r << 16 | background->g << 8 | background->b);
    return key;
}

std::string etag_of(const std::string& key) {
    constexpr std::size_t kDigits = 32;
    const std::string hash = ingest::content_hash(
        {reinterpret_cast<const std::uint8_t*>(key.data()), key.size()});
    return '"' + hash.substr(0, kDigits) + '"';
}

Result<video::Picture> draw_picture(const video::TimeTree& clip,
                                    const VideoPicture& picture) {
    if (!picture.node) return draw_range(clip, picture);
    const auto frame = clip.frame(*picture.node, needed_level(clip.shape(), picture));
    if (!frame) return frame.error();
    return draw_frame(*frame, picture);
}

Result<std::string> encode_picture(const video::Picture& picture,
                                   PictureFormat format,
                                   const std::optional<video::Rgba>& background) {
    if (background) {
        video::Picture opaque = picture;
        for (video::Rgba& pixel : opaque.pixels) pixel = over(pixel, *background);
        return encode_picture(opaque, format, std::nullopt);
    }
    const ImageView view = picture.view();
    if (format == PictureFormat::kRgba)
        return std::string(reinterpret_cast<const char*>(view.pixels),
                           4 * picture.pixels.size());
    const auto bytes = format == PictureFormat::kPng ? ingest::encode_png(view)
                       : format == PictureFormat::kWebp
                           ? ingest::encode_webp(view)
                           : ingest::encode_jpeg(view, kJpegQuality);
    if (!bytes) return bytes.error();
    return std::string(bytes->begin(), bytes->end());
}

Result<PictureAnswer> picture_reply(VideoService& videos,
                                    const OpenVideo& video,
                                    const VideoPicture& picture,
                                    const std::string& alias) {
    const std::string key = key_of(video.row(), picture);
    if (ReplyCache::Reply kept = videos.replies().find(key, alias))
        return PictureAnswer{std::move(kept), std::nullopt};
    const video::TimeTree& clip = video.clip();
    PictureTimes times;
    Stopwatch watch;
    // Of a range that no node covers, the first frame's node tells of space; of time there
    // is finer detail than an average of several nodes.
    const video::NodeAddress at = picture.node.value_or(
        video::NodeAddress{clip.shape().time_levels(), picture.frames.first});
    const auto frame = clip.frame(at, needed_level(clip.shape(), picture));
    if (!frame) return frame.error();
    times.decode = watch.lap();
    const auto drawn =
        picture.node ? draw_frame(*frame, picture) : draw_range(clip, picture);
    if (!drawn) return drawn.error();
    auto reply = std::make_shared<PictureReply>();
    reply->width = drawn->width;
    reply->height = drawn->height;
    reply->first_frame = picture.frames.first;
    reply->last_frame = picture.frames.end - 1;
    reply->finer_in_space = finer_in_space(*frame, picture);
    reply->finer_in_time = !picture.node || clip.finer_in_time(at);
    times.draw = watch.lap();
    auto encoded = encode_picture(*drawn, picture.format, picture.background);
    if (!encoded) return encoded.error();
    reply->bytes = *std::move(encoded);
    times.encode = watch.lap();
    videos.replies().put(video.row().id, key, alias, reply);
    return PictureAnswer{std::move(reply), times};
}

}  // namespace haarmony::server
