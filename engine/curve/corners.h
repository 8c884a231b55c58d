// Corners of a stroke or curve: where its direction turns at once, and not along a bend.
//   [corners.h] -> cornered_curve.h
//
// At each place the direction is taken over a window before it and one behind it, each from
// the mean of its nearer to that of its farther half. A corner is where these two differ by
// `degrees` at least, where windows of half the size show 3/4 of that turn still (along an
// arc it is the half), and where neighbours within the window turn less. Of the samples
// there it is the one that is furthest out between the two directions.
//
// Units   a window is a distance in x and y. By default 20 times the noise, but 3 % to 12 %
//         of the diagonal of the bounding box; bends tighter than a fourth of it are corners.
//         Noise: median second difference of the samples / 2.88, the ratio for normal noise.
// Errors  none.
// Threads const-thread-safe.
// Cost    linear in the samples; 16 places a window are looked at.
// Source  ours; windows of distance as in the corner finders of sketch recognition.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/curve/level.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

struct CornerOptions {
    double degrees = 40;
    double window = 0;  // 0: from the samples
};

// Ascending indices of samples; the ends of an open stroke are none. Requires: finite
// samples, 0 < degrees <= 180, window >= 0.
[[nodiscard]] std::vector<std::size_t> detect_corners(const Points& samples,
                                                      Ends ends,
                                                      const CornerOptions& options);

// Ascending u of the curve with these control points, each to 1/16 of a
// segment, from level 16 on to 2^-20.
[[nodiscard]] std::vector<double> detect_curve_corners(const Points& control,
                                                       Ends ends,
                                                       const CornerOptions& options);

}  // namespace haarmony::curve
