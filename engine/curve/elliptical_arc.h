// An arc of an ellipse between two points as cubic Bezier segments.
//   [elliptical_arc.h] -> svg_path.h
//
// Scale   a segment spans at most 45 degrees of the ellipse and is within 4.3e-6 of its larger
//         radius (2/27 of sin^6(a/4) / cos^2(a/4), a = 45 degrees).
// Errors  none; numbers that overflow give numbers that are not finite.
// Threads const-thread-safe.
// Source  SVG 2, appendix B.2, implementation notes on elliptical arcs.
#pragma once

#include <vector>

namespace haarmony::curve {

struct PathPoint {
    double x = 0;
    double y = 0;
    friend bool operator==(const PathPoint&, const PathPoint&) = default;
};

struct EllipticalArc {
    PathPoint from;
    double radius_x = 0;  // the sign does not count
    double radius_y = 0;
    double rotation_degrees = 0;  // of the ellipse's x axis
    bool large = false;           // more than half of the ellipse
    bool sweep = false;           // in the direction of growing angles
    PathPoint to;
};

// Three control points for each segment; the first one starts at `from`, the last point is
// exactly `to`. Nothing if the ends are equal, a straight segment if a radius is 0; radii
// that are too small for the ends grow until they just reach.
[[nodiscard]] std::vector<PathPoint> arc_beziers(const EllipticalArc& arc);

}  // namespace haarmony::curve
