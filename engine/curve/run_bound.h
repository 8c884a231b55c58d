// A proof that one cubic stays close to a run of Bezier segments, and they to it.
//   chain.h -> [run_bound.h] -> merge.h
//
// The cubic is cut where it is nearest to the joints of the run, and each part is compared
// with its segment at equal local parameters: the difference of two cubics is a cubic, which
// lies within the convex hull of its Bernstein coefficients. The longest coefficient bounds
// the distance of points that belong together (the Frechet distance), and so the Hausdorff
// distance in both directions. Parts for which that is too coarse are halved.
//
// Errors   none; rounding errors are allowed for.
// Threads  const-thread-safe.
// Source   sec. 3.5 [convex hull, after equation (3.8)].
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "engine/curve/chain.h"
#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {

// Parameters of `cubic` at the joints of a run, first 0, last 1, ascending.
using Cuts = std::vector<double>;

// A bound that is at most `tolerance`, if one was proved. `cuts` is left with what it was
// proved for, and is passed in so that its memory is used again.
// Requires: first < last <= pieces; cubic starts and ends where the run does.
// Cost: linear in the run.
[[nodiscard]] std::optional<double> proved_bound(const Chain& chain,
                                                 std::size_t first,
                                                 std::size_t last,
                                                 const PlaneCubic& cubic,
                                                 double tolerance,
                                                 Cuts& cuts);

}  // namespace haarmony::curve
