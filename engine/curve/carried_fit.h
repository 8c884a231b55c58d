// What a curve carries along (thickness, colour), for a cubic that replaces a run of pieces.
//   run_bound.h -> [carried_fit.h] -> merge.h
//
// The ends keep their values; the two in between are least squares over the run, at the
// parameters where the cubic was proved to be close.
//
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.6 [thickness and colour].
#pragma once

#include <cstddef>

#include "engine/curve/points.h"
#include "engine/curve/run_bound.h"

namespace haarmony::curve {

// Writes the dimensions from the third on of the four rows of `bezier` from `row` on.
// Requires: the chain's rows are 3k + 1; cuts of the pieces from `first` to `last`.
void fit_carried(const Points& chain,
                 std::size_t first,
                 std::size_t last,
                 const Cuts& cuts,
                 Points& bezier,
                 std::size_t row);

}  // namespace haarmony::curve
