// Analysis of a change that is 0 but for a few control points, without looking at the rest.
//   multires_curve.h -> [local_analysis.h] -> sparse_detail.h
//
// A long curve is locally like a shorter one: the change is put on a curve just long enough,
// as far from its ends as on the long one, or beyond where that matters.
//
// Shape   rows first, first + 1, ...; of a closed curve modulo its count.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 3.2.2; B-spline projections fall off by 0.5353, the largest zero of the
//         Euler-Frobenius polynomial of degree 6, from one coefficient to the next.
#pragma once

#include <cstddef>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

struct LocalRows {
    std::size_t first = 0;
    Points rows;
};

// What of C^(j-1) and D^(j-1) moves a control point of level j by more than `least`; inner
// rows are kept whatever they are.
struct LocalStep {
    LocalRows coarse;
    LocalRows detail;
    std::size_t visited = 0;  // control points of the shorter curve
};

// Of C^level, a level above 0. `precision` is how far rows that are cut off may reach back,
// in parts of the change. Requires: not empty, 1e-16 <= precision < 1.
[[nodiscard]] LocalStep analyze_local(const LocalRows& control,
                                      int level,
                                      Ends ends,
                                      double least,
                                      double precision);

}  // namespace haarmony::curve
