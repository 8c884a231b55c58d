#include "server/api/video_match.h"

#include "engine/image/symmetry.h"
#include "server/api/json_text.h"
#include "server/api/video_json.h"

namespace haarmony::server {
namespace {

constexpr std::int32_t kThumbnailSide = 256;

// The finest level that a list of results has room for.
int thumbnail_level(const video::ClipShape& shape) {
    int level = shape.space_levels();
    while (level > 0 && (shape.width_at(level) > kThumbnailSide ||
                         shape.height_at(level) > kThumbnailSide))
        --level;
    return level;
}

}  // namespace

void append_frame_match(const FoundFrame& found,
                        const PlannedWay& way,
                        int rank,
                        std::string& reply) {
    const schema::Video& video = found.video;
    const auto shape = shape_of(video);
    std::string thumbnail;
    double time = 0;
    if (shape) {
        const auto frames = shape->frames_of({found.time_level, found.node});
        time = static_cast<double>(frames.first) / shape->rate().per_second();
        thumbnail = "/video/frame?video=" + std::to_string(video.id) +
                    "&time_level=" + std::to_string(found.time_level) +
                    "&index=" + std::to_string(found.node) +
                    "&level=" + std::to_string(thumbnail_level(*shape)) +
                    "&rev=" + video.revision;
    }
    std::string frame;
    JsonObject(frame)
        .integer("video", video.id)
        .integer("time_level", found.time_level)
        .integer("index", found.node)
        .number("time", time)
        .end();
    JsonObject match(reply);
    match.integer("id", found.id)
        .integer("rank", rank)
        .number("distance", found.match.distance)
        .number("similarity", found.match.similarity)
        .text("orientation", image::symmetry_name(way.symmetry));
    if (found.match.combined_rank)
        match.number("combined_rank", *found.match.combined_rank);
    match.json("uri", "null")
        .integer("width", video.width)
        .integer("height", video.height)
        .text("thumbnail", thumbnail)
        .json("tags", "[]")
        .json("metadata", "{}")
        .json("frame", frame)
        .end();
}

}  // namespace haarmony::server
