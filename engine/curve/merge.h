// A chain of Bezier segments approximated by as few as possible, with a proof for each.
//   cubic_fit.h, run_bound.h -> [merge.h] -> approximate.h
//
// Joints of the result are joints of the chain, and lie on it; its tangents are the chain's
// tangents, so the result turns at a joint only where the chain itself does. A segment
// replaces a run of pieces if a bound is proved; a single piece replaces itself. Runs are
// found by breadth: of all joints that k segments reach, the farthest few are tried further,
// because what ends a little earlier, with a better tangent, often goes on farther.
//
// Shape    of the chain 3k + 1 rows; of the result four rows a segment, in order.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.5 ["methods with higher compression ratios are certainly possible"].
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::curve {

struct MergedSegments {
    Points bezier;
    std::vector<std::size_t> joints;  // of the chain; one more than segments
    double bound =
        0;  // on the two-sided Hausdorff distance in x and y, segment by segment
};

// At most as many segments as the chain has; bound <= tolerance.
// Requires: tolerance > 0; `corners` ascending joints of the chain, which stay joints.
// Cost: some twenty fits and proofs a segment, each linear in its run.
[[nodiscard]] MergedSegments merge(const Points& chain,
                                   double tolerance,
                                   std::span<const std::size_t> corners);

}  // namespace haarmony::curve
