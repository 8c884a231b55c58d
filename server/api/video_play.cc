#include "server/api/video_play.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/video/constant_speed.h"
#include "server/api/inputs.h"
#include "server/api/picture_format.h"
#include "server/api/points_json.h"
#include "server/app/video_picture.h"

namespace haarmony::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kBoundary = "frame";
constexpr double kFastestFps = 120;
constexpr double kSlowestFps = 6;
constexpr double kMostSpeed = 1'000'000;
constexpr std::chrono::milliseconds kPoll{5};
// Below 1/16 of the finest level's side the frame rate gives way instead.
constexpr int kCoarser = 4;

struct PlayOptions {
    std::int64_t video = 0;
    std::optional<double> fps;
    double speed = 1;
    double budget = 1;
    std::optional<std::int64_t> level;
    PictureFormat format = PictureFormat::kJpeg;
};

PlayOptions read_play_options(Inputs& inputs) {
    constexpr std::array<std::string_view, 3> kFormats{"png", "webp", "jpeg"};
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    PlayOptions options;
    if (!inputs.has("video")) inputs.refuse("video", "is missing");
    options.video = inputs.integer("video", 1, kMost).value_or(0);
    options.fps = inputs.number("fps", 0.1, kFastestFps);
    options.speed = inputs.number("speed", -kMostSpeed, kMostSpeed).value_or(1);
    options.budget = inputs.number("budget", 0, 1).value_or(1);
    options.level = inputs.integer("level", -kMost, kMost);
    const auto format = inputs.one_of("format", kFormats);
    if (format == "png") options.format = PictureFormat::kPng;
    if (format == "webp") options.format = PictureFormat::kWebp;
    return options;
}

// Pulled by one thread at a time (http::ChunkSource).
class PlayStream {
  public:
    PlayStream(std::shared_ptr<const OpenVideo> video,
               const PlayOptions& options,
               const video::QualityOptions& quality)
        : video_(std::move(video)),
          format_(options.format),
          playing_(video_->clip().shape(), playback(*video_, options), quality, 0) {}

    std::optional<std::string> next() {
        if (ended_) return {};
        const double now = seconds();
        if (now < due_) return std::string();
        const auto step = playing_.next(now);
        if (!step) {
            ended_ = true;
            return "--" + std::string(kBoundary) + "--\r\n";
        }
        due_ = step->until_s;
        // The same picture again: what the client shows is right.
        if (step->time.repeated) return std::string();
        std::string part = part_of(*step);
        playing_.drawn(seconds() - now);
        return part;
    }

  private:
    static video::PlaybackOptions playback(const OpenVideo& video,
                                           const PlayOptions& options) {
        video::PlaybackOptions playback;
        playback.speed = options.speed;
        if (options.speed < 0)
            playback.position = static_cast<double>(video.clip().shape().frames());
        return playback;
    }

    [[nodiscard]] double seconds() const {
        return std::chrono::duration<double>(Clock::now() - start_).count();
    }

    [[nodiscard]] std::string part_of(const video::QualityStep& step) const {
        const video::TimeTree& clip = video_->clip();
        VideoPicture wish;
        wish.node = step.time.at;
        wish.frames = clip.shape().frames_of(step.time.at);
        wish.level = step.space_level;
        wish.box = {0,
                    0,
                    clip.shape().width_at(step.space_level),
                    clip.shape().height_at(step.space_level)};
        const auto picture = draw_picture(clip, wish);
        if (!picture) throw std::runtime_error(picture.error().message);
        const auto bytes = encode_picture(*picture, format_, std::nullopt);
        if (!bytes) throw std::runtime_error(bytes.error().message);
        return "--" + std::string(kBoundary) +
               "\r\nContent-Type: " + std::string(media_type_of(format_)) +
               "\r\nContent-Length: " + std::to_string(bytes->size()) +
               "\r\nX-Frame-Interval: " + std::to_string(wish.frames.first) + '-' +
               std::to_string(wish.frames.end - 1) +
               "\r\nX-Time-Level: " + std::to_string(step.time.at.time_level) +
               "\r\nX-Level: " + std::to_string(step.space_level) + "\r\n\r\n" + *bytes +
               "\r\n";
    }

    std::shared_ptr<const OpenVideo> video_;
    PictureFormat format_;
    video::ConstantSpeed playing_;
    Clock::time_point start_ = Clock::now();
    double due_ = 0;
    bool ended_ = false;
};

}  // namespace

Reply get_play(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const PlayOptions options = read_play_options(*inputs);
    if (const auto problem = inputs->refused()) return *problem;
    if (options.speed == 0)
        return impossible("out_of_range", "speed 0 never ends", "speed");
    auto video = context.videos.clip(options.video);
    if (!video) return video.error();
    const video::ClipShape& shape = (*video)->clip().shape();
    const std::int64_t level = options.level.value_or(shape.space_levels());
    if (level < 0 || level > shape.space_levels())
        return impossible("out_of_range",
                          "level '" + std::to_string(level) +
                              "' is outside the clip: 0 to " +
                              std::to_string(shape.space_levels()),
                          "level");
    video::QualityOptions quality;
    quality.fps = options.fps.value_or(std::min(shape.rate().per_second(), kFastestFps));
    quality.slowest_fps = std::min(kSlowestFps, quality.fps);
    quality.finest_level = static_cast<int>(level);
    quality.coarsest_level = std::max(0, quality.finest_level - kCoarser);
    quality.budget = options.budget;
    http::Response response;
    response.headers["Content-Type"] =
        "multipart/x-mixed-replace; boundary=" + std::string(kBoundary);
    response.headers["Cache-Control"] = "no-store";
    response.poll_interval = kPoll;
    const auto stream = std::make_shared<PlayStream>(*std::move(video), options, quality);
    response.body = http::ChunkSource([stream] { return stream->next(); });
    return response;
}

}  // namespace haarmony::server
