// Where a wavelet is largest: the place on a curve that its detail belongs to.
//   multires_curve.h -> [wavelet_peak.h] -> frame.h
//
// Errors   none; a row that the level does not have is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 3.4.3, "the parameter position u0 corresponding to the maximum value".
#pragma once

#include <cstddef>

#include "engine/curve/level.h"

namespace haarmony::curve {

// u where |psi| of row `row` of D^level is largest. The one wavelet of an open curve's level
// 0 is as large at both ends: there it is 1/2. Requires: row < 2^level.
// Cost: constant; the first call works out the few wavelets at the ends.
[[nodiscard]] double wavelet_peak(int level, Ends ends, std::size_t row);

}  // namespace haarmony::curve
