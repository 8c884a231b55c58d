#include "server/api/video_wishes.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/api/job_json.h"
#include "server/api/points_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

constexpr std::int64_t kMostFrames = std::int64_t{1} << video::kMaxTimeLevels;
constexpr std::size_t kMostNameBytes = 256;
constexpr double kMostDelta = 255;  // grey levels
constexpr double kSlowest = 0.001;  // frames a second
constexpr double kFastest = 1'000;

// A number of any size: what a clip can have is said later, in a 422.
std::int32_t side(Inputs& inputs, std::string_view name) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    const auto number = inputs.integer(name, -kMost, kMost).value_or(0);
    if (number < 1 && inputs.has(name))
        inputs.refuse(impossible(
            "out_of_range",
            std::string(name) + " '" + std::to_string(number) + "' is not above 0",
            name));
    return static_cast<std::int32_t>(
        std::clamp<std::int64_t>(number,
                                 std::numeric_limits<std::int32_t>::min(),
                                 std::numeric_limits<std::int32_t>::max()));
}

}  // namespace

VideoWishes read_video_wishes(Inputs& inputs) {
    VideoWishes wishes;
    wishes.name = inputs.text("name").value_or("");
    if (wishes.name.size() > kMostNameBytes)
        inputs.refuse("name",
                      "is longer than " + std::to_string(kMostNameBytes) + " bytes");
    wishes.delta = inputs.number("delta", 0, kMostDelta).value_or(0);
    wishes.max_frames = inputs.integer("max_frames", 1, kMostFrames).value_or(0);
    wishes.index = inputs.boolean("index").value_or(false);
    return wishes;
}

video::FrameFormat read_frame_format(Inputs& inputs) {
    video::FrameFormat format;
    format.width = side(inputs, "width");
    format.height = side(inputs, "height");
    if (const auto rate = inputs.number("rate", kSlowest, kFastest))
        format.rate = rate_of(*rate);
    return format;
}

Reply queue_video(const Context& context,
                  VideoRequest video,
                  std::span<const std::byte> input) {
    VideoFiles& files = context.videos.files();
    if (!input.empty()) {
        auto kept = files.take_input(input);
        if (!kept) return kept.error();
        video.input = *std::move(kept);
    }
    const auto job = context.jobs.create("video", to_text(video));
    if (!job) {
        if (!video.input.empty()) files.remove_input(video.input);
        return job.error();
    }
    http::Response response =
        http::json_response(202, job_json(job.value(), context.jobs));
    response.headers["Cache-Control"] = "no-store";
    response.headers["Location"] = job_address(job->id);
    return response;
}

}  // namespace haarmony::server
