// Exact frames put into a spool and taken out again.
//   exact_mean.h -> [frame_spool.h] -> time_sums.h, build.h
//
// Shape    a frame's nodes and bricks as they are in memory, and then a head that says how
//          many and where, with the roots, apexes and bounds. It is read by the process that
//          wrote it.
// Errors   what the spool meets; kIo where it gives back other bytes than it was given.
// Threads  one caller.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/image_tree.h"
#include "engine/video/spool.h"

namespace haarmony::video {

struct SpooledFrame {
    std::uint64_t head = 0;  // offset
    std::uint64_t checksum = 0;

    friend bool operator==(const SpooledFrame&, const SpooledFrame&) = default;
};

class FrameSpool {
  public:
    // `spool` must outlive this.
    explicit FrameSpool(Spool& spool) : spool_(spool) {}

    [[nodiscard]] Result<SpooledFrame> put(const ExactFrame& frame);
    // `frame`'s storage is used again.
    [[nodiscard]] Result<void> get(const SpooledFrame& from, ExactFrame& frame);

  private:
    Spool& spool_;
};

}  // namespace haarmony::video
