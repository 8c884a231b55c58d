// How far a curve is from its approximations, segment by segment, level by level.
//   multires_curve.h, bspline.h -> [error_bounds.h] -> draw_segment.h
//
// Shape    level j has 2^j segments; segment i owns the Bezier points 3i .. 3i + 3.
// Units    lengths in x and y; what is carried along does not count.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Cost     linear in the control points: every bound is computed once.
// Source   sec. 3.5, equations (3.8), (3.9) and ErrBound of Figure 3.12. (3.9) is printed with
//          k in i .. i + 3, which are not the points of segment i; that bounds nothing.
#pragma once

#include <vector>

#include "engine/curve/multires_curve.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

struct SegmentLevel {
    Points bezier;  // of f^j, 3 * 2^j + 1 rows
    std::vector<double>
        delta;  // of (3.9): by how much f^j differs from f^(j-1); 0 at level 0
    std::vector<double> bound;  // ErrBound: by how much it differs from f^n at most
};

// Levels 0 to n.
[[nodiscard]] std::vector<SegmentLevel> error_bounds(const MultiresCurve& curve);

}  // namespace haarmony::curve
