#include "server/api/video_export.h"

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "server/api/image_id.h"
#include "server/api/inputs.h"
#include "server/api/video_json.h"
#include "server/app/video_picture.h"

namespace haarmony::server {
namespace {

constexpr std::array<std::string_view, 1> kFormats{"mrv"};

// The video's own file, whole or in ranges.
Reply own_file(const Context& context, const schema::Video& video) {
    std::string path = context.videos.files().clip_path(video.id, video.revision);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error)
        return Error{ErrorCode::kIo,
                     "video " + std::to_string(video.id) + ": " + error.message()};
    http::Response response;
    response.headers["Content-Type"] = "application/octet-stream";
    response.headers["Content-Disposition"] =
        "attachment; filename=\"" + std::to_string(video.id) + ".mrv\"";
    response.headers["ETag"] = etag_of("mrv." + video.revision);
    response.headers["Accept-Ranges"] = "bytes";
    response.headers["Cache-Control"] = "no-cache";
    response.headers["X-Content-Type-Options"] = "nosniff";
    response.body = http::FileRange{std::move(path), 0, size};
    return response;
}

}  // namespace

Reply get_export(const Context& context, const http::Request& request) {
    auto id = video_id_of(request);
    if (!id) return id.problem();
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    (void)inputs->one_of("format", kFormats);
    if (const auto problem = inputs->refused()) return *problem;
    const auto video = context.videos.get(*id);
    if (!video) return video.error();
    return own_file(context, *video);
}

}  // namespace haarmony::server
