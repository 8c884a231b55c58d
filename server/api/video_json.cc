#include "server/api/video_json.h"

#include <limits>

#include "engine/video/accounting.h"
#include "server/api/image_id.h"
#include "server/api/json_text.h"

namespace haarmony::server {
namespace {

std::string storage_text(const schema::Video& video) {
    const schema::VideoStorage& storage = video.storage;
    std::string text;
    JsonObject(text)
        .integer("time_nodes", storage.time_nodes)
        .integer("complete_subtrees", storage.complete_subtrees)
        .integer("pruned_subtrees", storage.pruned_subtrees)
        .integer("own_subtrees", storage.own_subtrees)
        .integer("uplinks", storage.uplinks)
        .integer(
            "paper_bytes",
            static_cast<std::int64_t>(video::kSubtreeBytes) * storage.own_subtrees +
                static_cast<std::int64_t>(video::kTimeNodeBytes) * storage.time_nodes)
        .integer("memory_bytes", storage.memory_bytes)
        .integer("disk_bytes", storage.disk_bytes)
        .integer("raw_bytes", 4 * video.width * video.height * video.frames)
        .end();
    return text;
}

}  // namespace

Outcome<std::int64_t> video_id_of(const http::Request& request) {
    auto id = image_id_of(request);
    if (!id) return id.problem();
    return to_int(*id);
}

std::string video_address(std::int64_t id) { return "/videos/" + std::to_string(id); }

Result<video::ClipShape> shape_of(const schema::Video& video) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    const auto narrow = [](std::int64_t number) {
        return number > kMost ? 0 : static_cast<std::int32_t>(number);
    };
    const video::FrameFormat format{
        narrow(video.width),
        narrow(video.height),
        {narrow(video.rate_numerator), narrow(video.rate_denominator)}};
    auto shape = video::ClipShape::make(format, video.frames);
    if (!shape)
        return Error{ErrorCode::kIo,
                     "video " + std::to_string(video.id) + ": " + shape.error().message};
    return shape;
}

void append_video(const schema::Video& video, std::string& out) {
    JsonObject object(out);
    object.integer("id", video.id)
        .text("revision", video.revision)
        .text_or_null("name", video.name)
        .integer("width", video.width)
        .integer("height", video.height)
        .integer("frames", video.frames)
        .number("rate",
                static_cast<double>(video.rate_numerator) /
                    static_cast<double>(video.rate_denominator));
    if (const auto shape = shape_of(video))
        object.integer("time_levels", shape->time_levels())
            .integer("space_levels", shape->space_levels());
    object.number("delta", video.delta)
        .boolean("indexed", video.indexed)
        .text("created_at", video.created_at)
        .json("storage", storage_text(video))
        .end();
}

}  // namespace haarmony::server
