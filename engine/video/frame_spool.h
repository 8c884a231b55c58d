// Exact frames put into a spool and taken out again.
//   exact_mean.h -> [frame_spool.h] -> time_sums.h, build.h
//
// Shape    a frame is one piece of bytes: a head (counts, roots, apexes, bounds), nodes,
//          bricks, as they are in memory; it is read by the process that wrote it.
// Errors   what the spool meets; kIo where it gives back other bytes than it was given.
// Threads  one caller.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/image_tree.h"
#include "engine/video/spool.h"

namespace haarmony::video {

struct SpooledFrame {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
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
    std::vector<std::byte> bytes_;
};

}  // namespace haarmony::video
