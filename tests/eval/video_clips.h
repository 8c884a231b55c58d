// The clips that multiresolution video is measured on, their frames in memory.
//   ingest/video_source.h, generator.h, video_clip_art.h -> [video_clips.h] -> video_sizes.h,
//   video_bound.h, video_speed.h
//
// Errors  kNotFound for a folder that cannot be listed, kIo for a file that cannot be opened;
//         what reading or generating a clip meets, with its name.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/picture.h"

namespace haarmony::eval {

enum class VideoKind : std::uint8_t { kNatural, kGenerated, kClipArt };

[[nodiscard]] const char* video_kind_name(VideoKind kind);

struct VideoClip {
    std::string name;
    VideoKind kind = VideoKind::kNatural;
    video::FrameFormat format;
    std::vector<video::Picture> frames;

    // RGBA of all frames.
    [[nodiscard]] std::uint64_t raw_bytes() const;
};

// A clip that is not in memory yet; load() reads its first frames, at most so many.
struct VideoClipSource {
    std::string name;
    std::function<Result<VideoClip>(std::int64_t frames)> load;
};

// Every clip of a folder and of those within, by name; files that are no clips are passed.
[[nodiscard]] Result<std::vector<VideoClipSource>> folder_clips(
    const std::string& folder);

// The six examples of generator.h, `side` pixels high (a power of two).
[[nodiscard]] std::vector<VideoClipSource> generated_clips(std::int32_t side);

// What is left of a source, drawn.
[[nodiscard]] Result<std::vector<video::Picture>> drawn_frames(
    video::FrameSource& source);

// Pictures as a source of frames.
class PictureFrames final : public video::FrameSource {
  public:
    // Requires: pictures of the format's size, which outlive this.
    PictureFrames(const video::FrameFormat& format,
                  std::span<const video::Picture> pictures)
        : format_(format), pictures_(pictures) {}

    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(video::SourceFrame& frame) override;

  private:
    video::FrameFormat format_;
    std::span<const video::Picture> pictures_;
    std::size_t next_ = 0;
};

}  // namespace haarmony::eval
