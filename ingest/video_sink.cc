#include "ingest/video_sink.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "ingest/animated_png.h"
#include "ingest/film_child.h"
#include "ingest/png_zip.h"

namespace haarmony::ingest {
namespace {

constexpr std::array kContainers = {
    ContainerDescription{Container::kMp4, "mp4", "video/mp4", "mp4"},
    ContainerDescription{Container::kWebm, "webm", "video/webm", "webm"},
    ContainerDescription{Container::kApng, "apng", "image/apng", "png"},
    ContainerDescription{Container::kPngZip, "png-zip", "application/zip", "zip"},
};

// Holds every container to what was announced.
class CountedSink : public VideoSink {
  public:
    CountedSink(const VideoSinkOptions& options, std::unique_ptr<VideoSink> sink)
        : format_(options.format), frames_(options.frames), sink_(std::move(sink)) {}

    [[nodiscard]] Result<void> add(const ImageView& picture) override {
        assert(picture.channels == 4);
        if (picture.width != format_.width || picture.height != format_.height) {
            return Error{ErrorCode::kInvalidArgument,
                         "a picture of " + std::to_string(picture.width) + " x " +
                             std::to_string(picture.height) + " pixels in a film of " +
                             std::to_string(format_.width) + " x " +
                             std::to_string(format_.height)};
        }
        if (added_ == frames_) {
            return Error{ErrorCode::kInvalidArgument,
                         "more than the " + std::to_string(frames_) +
                             " pictures that were announced"};
        }
        ++added_;
        return sink_->add(picture);
    }
    [[nodiscard]] Result<void> finish() override {
        if (added_ != frames_) {
            return Error{ErrorCode::kInvalidArgument,
                         std::to_string(added_) + " pictures of " +
                             std::to_string(frames_) + " that were announced"};
        }
        return sink_->finish();
    }

  private:
    video::FrameFormat format_;
    std::int64_t frames_;
    std::int64_t added_ = 0;
    std::unique_ptr<VideoSink> sink_;
};

Result<std::unique_ptr<VideoSink>> open_container(const VideoSinkOptions& options,
                                                  FilmOutput output) {
    switch (options.container) {
        case Container::kMp4:
        case Container::kWebm:
            return open_film_child(options, std::move(output));
        case Container::kApng:
            return open_animated_png(options, std::move(output));
        case Container::kPngZip:
            break;
    }
    return open_png_zip(options, std::move(output));
}

}  // namespace

std::span<const ContainerDescription> containers() { return kContainers; }

const ContainerDescription& describe_container(Container container) {
    const auto index = static_cast<std::size_t>(container);
    assert(index < kContainers.size() && kContainers[index].container == container);
    return kContainers[index];
}

std::optional<Container> container_named(std::string_view name) {
    const auto found = std::find_if(
        kContainers.begin(),
        kContainers.end(),
        [name](const ContainerDescription& entry) { return entry.name == name; });
    if (found == kContainers.end()) return std::nullopt;
    return found->container;
}

Result<std::unique_ptr<VideoSink>> open_video_sink(const VideoSinkOptions& options,
                                                   FilmOutput output) {
    assert(options.frames >= 1 && options.background.a == 255);
    if (const auto shape = video::ClipShape::make(options.format, options.frames);
        !shape) {
        return shape.error();
    }
    Result<std::unique_ptr<VideoSink>> sink = open_container(options, std::move(output));
    if (!sink) return sink;
    return std::unique_ptr<VideoSink>(
        std::make_unique<CountedSink>(options, std::move(sink).value()));
}

}  // namespace haarmony::ingest
