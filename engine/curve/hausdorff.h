// The distance of two curves as sets of points: measured, knowing nothing of how one was made
// from the other.
//   nearest_cubic.h -> [hausdorff.h] -> approximate.h
//
// Each curve is sampled, some eight times a segment of the finer one; where a sample is
// farthest from the other curve, its neighbourhood is searched for the largest distance.
// What is returned is the distance of a point that exists, so at most the true one; a peak
// narrower than the samples can be missed.
//
// Errors   none.
// Threads  const-thread-safe.
#pragma once

#include <span>

#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {

// Two-sided. `usual`: a point that seems farther away is looked for on the whole curve at
// once; it decides how quick this is, not what is returned.
// Requires: neither is empty. Cost: linear in the segments, where `usual` is.
[[nodiscard]] double hausdorff(std::span<const PlaneCubic> a,
                               std::span<const PlaneCubic> b,
                               double usual);

}  // namespace haarmony::curve
