// A curve smoothed to any level between its sweep and itself.
//   multires_curve.h -> [smooth.h] -> direct_edit.h, portion.h
//
// Shape   f^(j+t) = (1 - t) f^j + t f^(j+1); its control points are of level ceil(j + t).
// Errors  none; a level that the curve does not have is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 3.3, equation (3.1); sec. 3.4.1, equation (3.2) [C^(j+t) = P C^j + t Q D^j].
#pragma once

#include "engine/curve/multires_curve.h"

namespace haarmony::curve {

// A projection moves the ends of an open curve. Pinned, the first and the last control point
// of the smoothed curve are put where those of the curve itself are, and the others stay: only
// the first and the last segment follow.
enum class SmoothedEnds { kFree, kPinned };

// C^level. Pinning changes nothing in a closed curve. Requires: 0 <= level <= curve.level().
[[nodiscard]] Points smooth(const MultiresCurve& curve, double level, SmoothedEnds ends);

// The first control point of C^n, or the last, of an open curve, which are its ends.
// Cost: constant for each level.
[[nodiscard]] std::vector<double> first_point(const MultiresCurve& curve);
[[nodiscard]] std::vector<double> last_point(const MultiresCurve& curve);

}  // namespace haarmony::curve
