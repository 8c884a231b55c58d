// Which segments to merge next: geometric, so that a picture is moved a logarithmic number
// of times and the number of segments stays close to pictures / kMaxSegmentSlots.
//
// Rules   1. a segment of which at least half is removed is rewritten alone;
//         2. the smallest kMergeFanIn segments or more of one size class (sizes within a
//            factor of 4), as long as the result has at most kMaxSegmentSlots pictures and
//            a quarter of all: while it is built, memory holds it and its parts. So many as
//            kSmallMerge are never too many.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace haarmony::image {

inline constexpr std::size_t kMergeFanIn = 4;
inline constexpr int kSmallMerge = 8192;

struct SegmentSize {
    int slots = 0;
    int live = 0;
};

// The positions of the segments to be merged into one; empty where nothing is due. Carrying
// the plan out and asking again comes to an end.
[[nodiscard]] std::vector<std::size_t> plan_merge(std::span<const SegmentSize> segments);

}  // namespace haarmony::image
