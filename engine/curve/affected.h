// Which part of a curve an edit moves.
//   bspline.h -> [affected.h] -> sweep_edit.h
//
// Units    u in [0, 1].
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.4.1, "the portion of the curve affected".
#pragma once

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

// From knot to knot. Equal ends: nothing. A closed curve's interval that holds u = 0 within
// has from > to; all of it is [0, 1].
struct Interval {
    double from = 0;
    double to = 0;

    friend bool operator==(const Interval&, const Interval&) = default;
};

// The smallest interval between knots of `knot_level` outside which no point moves by more
// than `tolerance`, where the control points move by `change`.
// Requires: `change` is of a level of at least knot_level.
// Cost: linear in the rows of `change`.
[[nodiscard]] Interval affected_interval(const Points& change,
                                         Ends ends,
                                         int knot_level,
                                         double tolerance);

// The largest |number| of all: what tolerances of coordinates are relative to.
[[nodiscard]] double coordinate_size(const Points& points);
[[nodiscard]] bool all_finite(const Points& points);

}  // namespace haarmony::curve
