#include "server/api/image_media.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <span>
#include <utility>

#include "ingest/media_fragment.h"
#include "ingest/sniff.h"
#include "ingest/video_format.h"
#include "server/api/image_id.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

// Media may be kept, but its row may change at any time.
void set_media_headers(http::Response& response, const std::string& media_type) {
    response.headers["Content-Type"] = media_type;
    response.headers["Accept-Ranges"] = "bytes";
    response.headers["Cache-Control"] = "private, no-cache";
    response.headers["X-Content-Type-Options"] = "nosniff";
}

struct OriginalFile {
    std::uint64_t bytes = 0;
    std::string etag;
};

std::string_view media_type_in(std::span<const std::uint8_t> bytes, bool film) {
    if (film) {
        const auto format = ingest::sniff_video(bytes);
        return format ? ingest::media_type_of(*format) : std::string_view();
    }
    const auto type = ingest::sniff(bytes);
    return type && type->format ? type->media_type : std::string_view();
}

// An uploader names any address he likes: what is no picture, and for the frame of a film no
// film, stays where it is.
Result<OriginalFile> inspect(const std::string& path, const schema::Image& image) {
    const Error gone{ErrorCode::kNotFound, "the picture's file is gone"};
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error) return gone;
    const auto modified = fs::last_write_time(path, error);
    if (error) return gone;
    std::array<char, ingest::kSniffBytes> head{};
    std::ifstream file(path, std::ios::binary);
    file.read(head.data(), head.size());
    const std::string_view type =
        media_type_in({reinterpret_cast<const std::uint8_t*>(head.data()),
                       static_cast<std::size_t>(file.gcount())},
                      ingest::is_key_frame_uri(image.uri));
    if (type.empty() || type != image.media_type)
        return Error{ErrorCode::kNotFound,
                     "the picture's file is not the picture any more"};
    return OriginalFile{size,
                        '"' + std::to_string(size) + '-' +
                            std::to_string(modified.time_since_epoch().count()) + '"'};
}

}  // namespace

Reply get_thumbnail(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = image_id_of(request);
    if (!id) return id.problem();
    const auto image = context.images.get(*id);
    if (!image) return image.error();
    auto thumbnail = context.images.thumbnail(*id);
    if (!thumbnail) return thumbnail.error();
    http::Response response;
    response.body = std::string(thumbnail->bytes.begin(), thumbnail->bytes.end());
    set_media_headers(response, thumbnail->media_type);
    response.headers["ETag"] = etag_of(image.value());
    return response;
}

Reply get_original(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = image_id_of(request);
    if (!id) return id.problem();
    const auto image = context.images.get(*id);
    if (!image) return image.error();
    auto path = context.media_roots.locate(image->uri);
    if (!path) return path.error();
    const auto file = inspect(path.value(), image.value());
    if (!file) return file.error();
    http::Response response;
    set_media_headers(response, image->media_type);
    response.headers["ETag"] = file->etag;
    response.body = http::FileRange{std::move(path).value(), 0, file->bytes};
    return response;
}

}  // namespace haarmony::server
