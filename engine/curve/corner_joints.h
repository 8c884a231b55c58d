// Corners, given as parameters, made joints of a chain of Bezier segments.
//   bspline.h -> [corner_joints.h] -> approximate.h
//
// Shape    3k + 1 rows; u in [0, 1], each piece having an equal share of it.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   FvDFH, sec. 11.2 [de Casteljau].
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::curve {

struct CorneredChain {
    Points chain;                     // the same curve, pieces split at corners
    std::vector<std::size_t> joints;  // ascending, without the ends
};

// Where corners are, in pieces: the whole part is a joint, the rest lies within the piece that
// follows. Ascending; places that are as good as the same count once, and what is as good as a
// joint is one. Requires: each corner in [0, 1], in any order.
[[nodiscard]] std::vector<double> corner_places(std::span<const double> corners,
                                                std::size_t pieces);

// Corners at the ends are none. Requires: each in [0, 1], in any order.
[[nodiscard]] CorneredChain split_at_corners(const Points& chain,
                                             std::span<const double> corners);

}  // namespace haarmony::curve
