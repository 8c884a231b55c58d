// The pictures of a clip of unknown origin, one after the other
// (video, step 1): bytes -> [video_source] -> engine/video/create_frame.h -> build.h.
//
// What the first bytes say (video_sniff.h) decides how they are read, and a child process
// with limits (haarmony-video) reads them: this process never shows foreign bytes to libav.
//
// Shape   one picture for each decoded frame, in the order of presentation, all of one size;
//         straight RGBA, clear pixels canonical, turned as the file's display matrix says.
//         Pixels are as coded: their aspect ratio is ignored, fields stay interlaced.
// Units   8 bits as the file means them, BT.709 where a larger picture (720 lines or more)
//         does not say, BT.601 in a smaller one; high dynamic range is not tone-mapped.
//         The rate is the file's average; variable frame durations are not kept.
// Errors  kUnsupportedFormat (names what the bytes are, or the codec; no video in it),
//         kUndecodable (damaged, its decoder crashed or ran out of time), kTooLarge (pixels,
//         frames or memory, with the limit), kIo (the child cannot be started).
// Threads one caller a source.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/frame_source.h"
#include "ingest/file_descriptor.h"
#include "ingest/picture_source.h"
#include "ingest/video_wire.h"

namespace haarmony::ingest {

struct VideoSourceOptions {
    VideoFrames frames = VideoFrames::kAll;
    std::int64_t max_pixels = std::int64_t{1} << 25;  // of one picture
    std::int64_t max_frames = std::int64_t{1} << 20;
    std::int64_t child_bytes = std::int64_t{2} << 30;  // address space of the child
    std::chrono::seconds cpu_time{3600};               // of the child, for the whole clip
    std::chrono::milliseconds patience{60'000};        // for one picture, by the clock
    std::string program = {};  // empty: haarmony-video beside us or in ../libexec
};

// Whether the bytes at the beginning of a file (kSniffBytes of them) are of a kind that
// open_video() reads.
[[nodiscard]] bool is_video(std::span<const std::uint8_t> first_bytes);

// Requires: `file` is a regular file, open for reading; its bytes stay as they are while the
// source lives. The child starts here and goes with the source.
[[nodiscard]] Result<std::unique_ptr<PictureSource>> open_video(
    FileDescriptor file,
    const VideoSourceOptions& options);
// The same from memory, which is copied.
[[nodiscard]] Result<std::unique_ptr<PictureSource>> open_video(
    std::span<const std::uint8_t> bytes,
    const VideoSourceOptions& options);

// Pictures as the frames that the engine builds a clip from.
class PictureFrameSource : public video::FrameSource {
  public:
    // Requires: pictures != nullptr.
    explicit PictureFrameSource(std::unique_ptr<PictureSource> pictures);

    [[nodiscard]] const video::FrameFormat& format() const override;
    [[nodiscard]] Result<bool> next(video::SourceFrame& frame) override;

  private:
    std::unique_ptr<PictureSource> pictures_;
    TimedPicture shown_;
};

}  // namespace haarmony::ingest
