// Exact sums of frames over time, and the averages of a time node at every space level, each
// rounded once.
//   image_tree.h -> [exact_mean.h] -> build.h
//
// Bounds   the box of finest pixels whose mean, padding counted, is not clear after rounding.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Cost     linear in the detail of what is added, and of what is asked. Nothing is allocated
//          once storage is there; mean_into() takes 16 KB of stack a space level.
// Source   sec. 5.3.1, AverageChildren(); ERRATA of the project, video 14 to 17.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"

namespace haarmony::video {

// The sum of frames of one format, at the finest detail that any of them has.
class FrameSum {
  public:
    explicit FrameSum(const FrameFormat& format);
    ~FrameSum();
    FrameSum(FrameSum&&) noexcept;
    FrameSum& operator=(FrameSum&&) noexcept;

    // `tree` stays for `repeats` frames.
    void add(const ImageTree& tree, std::int64_t repeats);
    void add(const FrameSum& other);
    // As new; keeps its storage.
    void clear();
    [[nodiscard]] std::int64_t frames() const;
    // The exact averages of all frames added. `out`'s storage is used again.
    // Requires: frames() >= 1.
    void mean_into(ExactFrame& out) const;

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::video
