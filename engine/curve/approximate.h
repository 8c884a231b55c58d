// A curve as few Bezier segments, within a tolerance, and how good they are.
//   draw_segment.h, merge.h, cornered_curve.h -> [approximate.h] -> bezier_text.h
//
// Shape    four rows of `bezier` for each segment, in the order of u.
// Units    lengths in x and y; what is carried along does not count.
// Errors   kInvalidArgument: a tolerance, a corner or a coordinate out of range.
// Threads  const-thread-safe.
// Source   sec. 3.5.
#pragma once

#include <cstddef>
#include <span>

#include "engine/core/result.h"
#include "engine/curve/cornered_curve.h"
#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

enum class Joining {
    kDyadic,  // Figure 3.12: segments need not meet
    kC0,      // they meet
    kG1,      // they meet smoothly where the curve is smooth, and are the fewest
};

struct Approximation {
    Points bezier;
    bool closed = false;
    std::size_t possible = 0;  // segments of the curve itself
    double tolerance = 0;
    // max_error <= bound <= tolerance. kDyadic, kC0: the distance at equal u, and its
    // supremum; kG1: the two-sided Hausdorff distance, and what was measured of it.
    double bound = 0;
    double max_error = 0;

    [[nodiscard]] std::size_t count() const { return bezier.size() / 4; }
};

inline constexpr double kLargestCoordinate = 1e100;  // squares must not overflow

// `corners`: parameters at which the result may turn, and has a joint, which is on the curve
// unless the result is kDyadic.
// Requires: control points of a level. Cost: linear in them, usually.
[[nodiscard]] Result<Approximation> approximate(const Points& control,
                                                Ends ends,
                                                double tolerance,
                                                Joining joining,
                                                std::span<const double> corners);

// kG1 of any chain of Bezier segments (3k + 1 rows), such as an SVG path: where the chain
// itself turns at a joint, the result may.
[[nodiscard]] Result<Approximation> approximate_chain(const Points& chain,
                                                      Ends ends,
                                                      double tolerance,
                                                      std::span<const double> corners);

// A curve in pieces, which the result has as the curve has them: it may turn at their ends,
// and where it is not kDyadic goes through them.
[[nodiscard]] Result<Approximation> approximate_pieces(const CorneredCurve& curve,
                                                       double tolerance,
                                                       Joining joining);

}  // namespace haarmony::curve
