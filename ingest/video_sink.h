// Our own pictures as a film that others can read, written while they come
// (video export): display.h -> [video_sink] -> a file or a reply.
//
//   mp4      H.264, 4:2:0, fragmented; alpha over the background; an odd side gets one more
//            row or column, a repetition of the last
//   webm     VP9 with alpha, 4:2:0
//   apng     lossless with alpha
//   png-zip  lossless with alpha: 000000.png, 000001.png, ..., stored, without ZIP64
//
// H.264 and VP9 are made by libav in a child process (haarmony-video), so that the daemon
// does not load it; the rest is made here. Bytes leave in order and are never taken back.
//
// Errors  kInvalidArgument (a picture of another size; not as many as announced), kTooLarge
//         (more than the container can say), kUnavailable (no such encoder; it ended), kIo
//         (the child cannot be started), and whatever the output returns. After an error
//         nothing more is written.
// Threads one caller a sink.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/core/image_view.h"
#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/pixel.h"

namespace haarmony::ingest {

enum class Container : std::uint8_t { kMp4, kWebm, kApng, kPngZip };

struct ContainerDescription {
    Container container;
    std::string_view name;        // "png-zip", as in ?format=
    std::string_view media_type;  // "application/zip"
    std::string_view extension;   // "zip"
};

// All of them, in the order of the enumeration.
[[nodiscard]] std::span<const ContainerDescription> containers();
[[nodiscard]] const ContainerDescription& describe_container(Container container);
[[nodiscard]] std::optional<Container> container_named(std::string_view name);

struct VideoSinkOptions {
    Container container = Container::kMp4;
    video::FrameFormat format;
    std::int64_t frames = 0;                     // how many will come
    video::Rgba background = {0, 0, 0, 255};     // opaque; what mp4 shows below alpha
    std::chrono::milliseconds patience{60'000};  // for one picture in the child
    std::int64_t child_bytes = std::int64_t{4} << 30;  // address space of the child
    std::string program = {};  // empty: haarmony-video beside us or in ../libexec
};

// The next bytes of the film. An error ends it: so it is cancelled.
using FilmOutput = std::function<Result<void>(std::span<const std::uint8_t>)>;

class VideoSink {
  public:
    virtual ~VideoSink() = default;
    // Requires: no error before, 4 channels.
    [[nodiscard]] virtual Result<void> add(const ImageView& picture) = 0;
    // The end of the film. Requires: no error before; nothing is added after.
    [[nodiscard]] virtual Result<void> finish() = 0;
};

// Requires: options.frames >= 1. kInvalidArgument names what the container cannot hold.
[[nodiscard]] Result<std::unique_ptr<VideoSink>> open_video_sink(
    const VideoSinkOptions& options,
    FilmOutput output);

}  // namespace haarmony::ingest
