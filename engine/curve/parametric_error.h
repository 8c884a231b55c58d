// How far segments of different levels are from the curve at equal u, at most: measured.
//   draw_segment.h -> [parametric_error.h] -> approximate.h
//
// Where a segment and a piece of the curve are compared, the square of their distance is a
// polynomial of degree 6 in Bernstein form; its largest value is closed in on by halving,
// with the largest coefficient from above and the ends from below.
//
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.5, the L-infinity norm.
#pragma once

#include <span>

#include "engine/curve/draw_segment.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// The supremum over u, to a relative 1e-12. `curve` has the 3 * 2^n + 1 Bezier points of f^n.
// Requires: the segments cover it, in order. Cost: linear in the curve.
[[nodiscard]] double parametric_error(const Points& curve,
                                      int level,
                                      const DrawnSegments& segments);

}  // namespace haarmony::curve
