// Samples of a path of Bezier segments, dense enough to be fitted like a drawn stroke.
//   svg_path.h -> [path_samples.h] -> fit.h, cornered_curve.h
//
// Bound   no point of the path is further than `deviation` from the chord between the samples
//         before and after it (a chord over the parameter step h of a segment p0 .. p3 is
//         within h^2 / 8 * 6 max(|p0 - 2 p1 + p2|, |p1 - 2 p2 + p3|)), and neighbours are at
//         most 1/512 of the length of the control polygon apart.
// Errors  kTooLarge if that takes more than kMostPathSamples.
// Threads const-thread-safe.
// Source  the bound: error of linear interpolation, second derivative of a cubic.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/result.h"
#include "engine/curve/points.h"
#include "engine/curve/svg_path.h"

namespace haarmony::curve {

inline constexpr std::size_t kMostPathSamples = 4'000'000;

// Joints of segments that turn by more count as corners.
inline constexpr double kPathCornerDegrees = 5;

struct PathSamples {
    Points points;  // x, y; of a closed path without the last point, which is the first
    std::vector<std::size_t> corners;  // samples where the path turns, ascending
};

// Requires: deviation > 0, finite points, at least one segment.
[[nodiscard]] Result<PathSamples> sample_path(const SvgSubpath& path, double deviation);

}  // namespace haarmony::curve
