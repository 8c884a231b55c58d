// Frames of leaf squares, as an adaptive source sends them: in memory, and as the bytes that
// wait in a file for their job.
//
//   server/api/video_upload -> [leaf_frames] -> video_job -> engine/video/build.h
//
// Shape    bytes: for each frame the 64-bit number of repeats, the 32-bit number of leaves,
//          and of each leaf level, x and y in 32 bits and its four bytes of colour; numbers
//          with the least significant byte first.
// Errors   next(): kIo for bytes that end in the middle, kInvalidArgument for leaves that
//          create_frame() refuses, naming the frame; param frames.
// Threads  one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/create_frame.h"
#include "engine/video/frame_source.h"

namespace haarmony::server {

void append_leaf_frame(std::span<const video::LeafSquare> leaves,
                       std::int64_t repeats,
                       std::vector<std::byte>& bytes);

class LeafFrames final : public video::FrameSource {
  public:
    // `bytes` must outlive the source.
    LeafFrames(std::span<const std::byte> bytes, const video::FrameFormat& format);

    [[nodiscard]] const video::FrameFormat& format() const override { return format_; }
    [[nodiscard]] Result<bool> next(video::SourceFrame& frame) override;

  private:
    std::span<const std::byte> bytes_;
    video::FrameFormat format_;
    std::int64_t number_ = 0;
    std::vector<video::LeafSquare> leaves_;
};

}  // namespace haarmony::server
