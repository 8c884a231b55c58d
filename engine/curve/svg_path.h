// SVG path data as cubic Bezier segments, one curve for each of its subpaths.
//   elliptical_arc.h -> [svg_path.h] -> path_samples.h -> fit.h
//
// All commands and the whole grammar of SVG 2, absolute and relative: numbers that need no
// separator, exponents, the one-character flags of arcs. Unlike a browser, which draws what
// it could read, data with an error is refused as a whole.
//
// Shape   a subpath is 3 n + 1 points, neighbouring segments share their ends; lines, quadratic
//         segments and arcs are raised to cubic ones (elliptical_arc.h has the error of arcs,
//         all others are exact).
// Units   coordinates are at most kMostPathCoordinate in size.
// Errors  kInvalidArgument: the message carries the position, in bytes from 0, and the text
//         found there.
// Threads const-thread-safe.
// Source  SVG 2, sec. 9.3, "Path data".
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/result.h"
#include "engine/curve/points.h"

namespace haarmony::curve {

inline constexpr double kMostPathCoordinate = 1e100;

struct SvgSubpath {
    Points bezier;        // x, y
    bool closed = false;  // ended by z; its last point then is its first
};

// The subpaths that draw something, in order; a moveto that nothing follows draws nothing.
// What follows z without a moveto starts where the closed subpath did. Data in which nothing
// is drawn is an error, so there is at least one.
[[nodiscard]] Result<std::vector<SvgSubpath>> parse_svg_path(std::string_view text);

}  // namespace haarmony::curve
