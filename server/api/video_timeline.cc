#include "server/api/video_timeline.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "engine/video/timeline.h"
#include "server/api/content_tag.h"
#include "server/api/inputs.h"
#include "server/api/points_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostBuckets = 4'096;
constexpr std::int64_t kUsualBuckets = 256;
// Squares of 1/64 of the picture's side and what is coarser: enough for a graph, and little
// to read.
constexpr int kUsualLevel = 6;

json bucket_json(const video::TimelineBucket& bucket) {
    return {{"first", bucket.frames.first},
            {"last", bucket.frames.end - 1},
            {"temporal", bucket.temporal()},
            {"changed", bucket.changed},
            {"spatial", bucket.deepest_level},
            {"squares", bucket.squares}};
}

}  // namespace

Reply get_timeline(const Context& context, const http::Request& request) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    if (!inputs->has("video")) inputs->refuse("video", "is missing");
    const auto id = inputs->integer("video", 1, kMost);
    const auto buckets = inputs->integer("buckets", 1, kMostBuckets);
    const auto level = inputs->integer("level", -kMost, kMost);
    if (const auto problem = inputs->refused()) return *problem;
    const auto video = context.videos.clip(*id);
    if (!video) return video.error();
    const video::ClipShape& shape = (*video)->clip().shape();
    const int finest = shape.space_levels();
    if (level && (*level < 0 || *level > finest))
        return impossible("out_of_range",
                          "level '" + std::to_string(*level) +
                              "' is outside the clip: 0 to " + std::to_string(finest),
                          "level");
    const int least = std::min(video::kBrickLevel, finest);
    const auto timeline = video::timeline(
        (*video)->clip(),
        std::min(buckets.value_or(kUsualBuckets), shape.frames()),
        std::clamp(static_cast<int>(level.value_or(kUsualLevel)), least, finest));
    if (!timeline) return timeline.error();
    json list = json::array();
    for (const video::TimelineBucket& bucket : timeline->buckets)
        list.push_back(bucket_json(bucket));
    http::Response response = http::json_response(200,
                                                  {{"video", *id},
                                                   {"frames", shape.frames()},
                                                   {"rate", shape.rate().per_second()},
                                                   {"time_levels", shape.time_levels()},
                                                   {"space_levels", finest},
                                                   {"buckets", std::move(list)}});
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = content_tag(std::get<std::string>(response.body));
    return response;
}

}  // namespace haarmony::server
