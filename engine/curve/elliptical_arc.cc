#include "engine/curve/elliptical_arc.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace haarmony::curve {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<PathPoint> straight(PathPoint from, PathPoint to) {
    return {{from.x + (to.x - from.x) / 3, from.y + (to.y - from.y) / 3},
            {to.x + (from.x - to.x) / 3, to.y + (from.y - to.y) / 3},
            to};
}

}  // namespace

std::vector<PathPoint> arc_beziers(const EllipticalArc& arc) {
    if (arc.from == arc.to) return {};
    double rx = std::fabs(arc.radius_x);
    double ry = std::fabs(arc.radius_y);
    if (rx == 0 || ry == 0) return straight(arc.from, arc.to);

    // Everything in the axes of the ellipse, in which it is the unit circle: `p` is half the
    // way from `to` to `from`, and the middle of the chord is the origin.
    const double turn = std::fmod(arc.rotation_degrees, 360.0) * kPi / 180;
    const double cos = std::cos(turn);
    const double sin = std::sin(turn);
    const double dx = (arc.from.x - arc.to.x) / 2;
    const double dy = (arc.from.y - arc.to.y) / 2;
    PathPoint p{(cos * dx + sin * dy) / rx, (cos * dy - sin * dx) / ry};
    const double reach = std::hypot(p.x, p.y);
    if (reach == 0) return straight(arc.from, arc.to);  // radii beyond all proportion
    if (reach > 1) {
        rx *= reach;
        ry *= reach;
        p = {p.x / reach, p.y / reach};
    }
    const double half = std::fmin(reach, 1.0);
    const double away = std::sqrt((1 - half) * (1 + half)) / half;
    const double side = arc.large != arc.sweep ? away : -away;
    const PathPoint center{side * p.y, -side * p.x};

    const double first = std::atan2(p.y - center.y, p.x - center.x);
    double span = std::atan2(-p.y - center.y, -p.x - center.x) - first;
    if (arc.sweep && span < 0) span += 2 * kPi;
    if (!arc.sweep && span > 0) span -= 2 * kPi;

    const double middle_x = arc.to.x + dx;
    const double middle_y = arc.to.y + dy;
    const auto on_page = [&](double x, double y) {
        const double ex = rx * (center.x + x);
        const double ey = ry * (center.y + y);
        return PathPoint{middle_x + cos * ex - sin * ey, middle_y + sin * ex + cos * ey};
    };

    // Half an ellipse whose angles are rounded must not need one more segment.
    const int segments = 1 + static_cast<int>(std::fabs(span) / (kPi / 4) - 1e-9);
    const double step = span / segments;
    const double pull = 4.0 / 3.0 * std::tan(step / 4);
    std::vector<PathPoint> points;
    points.reserve(std::size_t(segments) * 3);
    for (int i = 0; i < segments; ++i) {
        const double a = first + step * i;
        const double b = first + step * (i + 1);
        points.push_back(
            on_page(std::cos(a) - pull * std::sin(a), std::sin(a) + pull * std::cos(a)));
        points.push_back(
            on_page(std::cos(b) + pull * std::sin(b), std::sin(b) - pull * std::cos(b)));
        points.push_back(on_page(std::cos(b), std::sin(b)));
    }
    points.back() = arc.to;
    return points;
}

}  // namespace haarmony::curve
