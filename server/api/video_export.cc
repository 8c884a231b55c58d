#include "server/api/video_export.h"

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "ingest/video_sink.h"
#include "server/api/image_id.h"
#include "server/api/inputs.h"
#include "server/api/picture_format.h"
#include "server/api/points_json.h"
#include "server/api/video_json.h"
#include "server/app/video_picture.h"

namespace haarmony::server {
namespace {

constexpr std::array<std::string_view, 5> kFormats{"mrv",
                                                   "mp4",
                                                   "webm",
                                                   "apng",
                                                   "png-zip"};

// An encoder that holds pictures back is given the next one at once.
constexpr std::chrono::milliseconds kPoll{1};

void name_file(http::Response& response,
               const schema::Video& video,
               std::string_view extension) {
    response.headers["Content-Disposition"] = "attachment; filename=\"" +
                                              std::to_string(video.id) + "." +
                                              std::string(extension) + '"';
    response.headers["X-Content-Type-Options"] = "nosniff";
}

// The video's own file, whole or in ranges.
Reply own_file(const Context& context, const schema::Video& video) {
    std::string path = context.videos.files().clip_path(video.id, video.revision);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error)
        return Error{ErrorCode::kIo,
                     "video " + std::to_string(video.id) + ": " + error.message()};
    http::Response response;
    name_file(response, video, "mrv");
    response.headers["Content-Type"] = "application/octet-stream";
    response.headers["ETag"] = etag_of("mrv." + video.revision);
    response.headers["Accept-Ranges"] = "bytes";
    response.headers["Cache-Control"] = "no-cache";
    response.body = http::FileRange{std::move(path), 0, size};
    return response;
}

// One picture is drawn and given to the encoder in each pull.
class FilmStream {
  public:
    FilmStream(std::shared_ptr<const OpenVideo> video, int time_level, int level)
        : video_(std::move(video)), time_level_(time_level), level_(level) {}

    Result<void> open(const ingest::VideoSinkOptions& options) {
        auto sink = ingest::open_video_sink(
            options, [this](std::span<const std::uint8_t> bytes) -> Result<void> {
                waiting_.append(reinterpret_cast<const char*>(bytes.data()),
                                bytes.size());
                return {};
            });
        if (!sink) return sink.error();
        sink_ = *std::move(sink);
        frames_ = options.frames;
        return {};
    }

    std::optional<std::string> next() {
        if (ended_ && waiting_.empty()) return {};
        if (!ended_) {
            const Result<void> done = next_ < frames_ ? add() : finish();
            if (!done) throw std::runtime_error(done.error().message);
        }
        return std::exchange(waiting_, {});
    }

  private:
    Result<void> add() {
        const video::TimeTree& clip = video_->clip();
        const auto frame = clip.frame({time_level_, next_++}, level_);
        if (!frame) return frame.error();
        const video::Picture picture =
            video::draw(*frame, level_, video::Edge::kNormalize);
        return sink_->add(picture.view());
    }
    Result<void> finish() {
        ended_ = true;
        return sink_->finish();
    }

    std::shared_ptr<const OpenVideo> video_;
    const int time_level_;
    const int level_;
    std::int64_t frames_ = 0;
    std::int64_t next_ = 0;
    bool ended_ = false;
    std::string waiting_;
    std::unique_ptr<ingest::VideoSink> sink_;  // before the bytes that it writes
};

// The pace at which a time level's nodes follow each other.
video::FrameRate slowed(const video::FrameRate& rate, int halvings) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    std::int64_t numerator = rate.numerator;
    std::int64_t denominator = std::int64_t{rate.denominator} << halvings;
    while (denominator > kMost) {
        denominator /= 2;
        numerator = std::max<std::int64_t>(1, numerator / 2);
    }
    return {static_cast<std::int32_t>(numerator), static_cast<std::int32_t>(denominator)};
}

struct FilmOptions {
    ingest::Container container;
    std::optional<std::int64_t> time_level;
    std::optional<std::int64_t> level;
    std::optional<video::Rgba> background;
};

Reply film(const Context& context, std::int64_t id, const FilmOptions& wanted) {
    auto video = context.videos.clip(id);
    if (!video) return video.error();
    const video::ClipShape& shape = (*video)->clip().shape();
    const std::int64_t time_level = wanted.time_level.value_or(shape.time_levels());
    const std::int64_t level = wanted.level.value_or(shape.space_levels());
    const auto outside = [](std::string_view name, std::int64_t value, int most) {
        return impossible("out_of_range",
                          std::string(name) + " '" + std::to_string(value) +
                              "' is outside the clip: 0 to " + std::to_string(most),
                          name);
    };
    if (time_level < 0 || time_level > shape.time_levels())
        return outside("time_level", time_level, shape.time_levels());
    if (level < 0 || level > shape.space_levels())
        return outside("level", level, shape.space_levels());
    const auto k = static_cast<int>(time_level);
    const auto l = static_cast<int>(level);
    ingest::VideoSinkOptions options;
    options.container = wanted.container;
    options.format = {shape.width_at(l),
                      shape.height_at(l),
                      slowed(shape.rate(), shape.time_levels() - k)};
    options.frames = shape.nodes_at(k);
    if (wanted.background) options.background = *wanted.background;
    const schema::Video row = (*video)->row();
    const auto stream = std::make_shared<FilmStream>(*std::move(video), k, l);
    if (const auto opened = stream->open(options); !opened) {
        if (opened.error().code == ErrorCode::kInvalidArgument)
            return impossible(opened.error());
        return opened.error();
    }
    const auto& container = ingest::describe_container(wanted.container);
    http::Response response;
    name_file(response, row, container.extension);
    response.headers["Content-Type"] = container.media_type;
    response.headers["Cache-Control"] = "no-store";
    response.poll_interval = kPoll;
    response.body = http::ChunkSource([stream] { return stream->next(); });
    return response;
}

}  // namespace

Reply get_export(const Context& context, const http::Request& request) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    auto id = video_id_of(request);
    if (!id) return id.problem();
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const std::string format = inputs->one_of("format", kFormats).value_or("mrv");
    FilmOptions wanted{};
    wanted.time_level = inputs->integer("time_level", -kMost, kMost);
    wanted.level = inputs->integer("level", -kMost, kMost);
    wanted.background = read_background(*inputs);
    if (format == "mrv")
        for (const std::string_view name : {"time_level", "level", "background"})
            if (inputs->has(name))
                inputs->refuse(malformed(
                    std::string(name) + " does not apply: a .mrv file has all levels",
                    name));
    if (const auto problem = inputs->refused()) return *problem;
    if (const auto container = ingest::container_named(format)) {
        wanted.container = *container;
        return film(context, *id, wanted);
    }
    const auto video = context.videos.get(*id);
    if (!video) return video.error();
    return own_file(context, *video);
}

}  // namespace haarmony::server
