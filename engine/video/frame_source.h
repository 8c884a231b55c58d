// Where the frames of a clip come from, one after the other.
//
// Errors   whatever the source meets; it is passed on and nothing is built.
// Threads  one caller.
// Source   sec. 5.3.1.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"

namespace haarmony::video {

// A frame and how many frames long it stays: an adaptive source may have less detail in time
// here than elsewhere.
struct SourceFrame {
    ImageTree tree;
    std::int64_t repeats = 1;
};

class FrameSource {
  public:
    virtual ~FrameSource() = default;
    [[nodiscard]] virtual const FrameFormat& format() const = 0;
    // The next frame into `frame` (its storage is used again), or false at the end.
    [[nodiscard]] virtual Result<bool> next(SourceFrame& frame) = 0;
};

}  // namespace haarmony::video
