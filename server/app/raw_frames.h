// Frames of straight RGBA, eight bits a channel, one after the other without padding.
//
//   [raw_frames] -> video_job -> engine/video/build.h
//
// Errors   none: what is behind the last whole frame is left.
// Threads  one.
#pragma once

#include <cstddef>
#include <span>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"

namespace haarmony::server {

class RawFrames final : public video::FrameSource {
  public:
    // `bytes` must outlive the source.
    RawFrames(std::span<const std::byte> bytes, const video::FrameFormat& format)
        : bytes_(bytes), format_(format) {}

    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(video::SourceFrame& frame) override;

  private:
    std::span<const std::byte> bytes_;
    video::FrameFormat format_;
};

// Of one frame. Requires: sides within the limits of a clip.
[[nodiscard]] std::size_t raw_frame_bytes(const video::FrameFormat& format);

}  // namespace haarmony::server
