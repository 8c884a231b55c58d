#include "engine/curve/elliptical_arc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace haarmony::curve {
namespace {

constexpr double kPi = std::numbers::pi;

PathPoint bezier_at(const std::array<PathPoint, 4>& p, double t) {
    const double s = 1 - t;
    const double a = s * s * s, b = 3 * s * s * t, c = 3 * s * t * t, d = t * t * t;
    return {a * p[0].x + b * p[1].x + c * p[2].x + d * p[3].x,
            a * p[0].y + b * p[1].y + c * p[2].y + d * p[3].y};
}

// An ellipse by its centre, which the arc's end points do not tell.
struct Ellipse {
    double cx, cy, rx, ry, turn;
    [[nodiscard]] PathPoint at(double angle) const {
        const double x = rx * std::cos(angle), y = ry * std::sin(angle);
        return {cx + std::cos(turn) * x - std::sin(turn) * y,
                cy + std::sin(turn) * x + std::cos(turn) * y};
    }
};

// The arc, sampled.
std::vector<PathPoint> drawn(const EllipticalArc& arc) {
    std::vector<PathPoint> points{arc.from};
    const std::vector<PathPoint> rows = arc_beziers(arc);
    PathPoint from = arc.from;
    for (std::size_t i = 0; i + 2 < rows.size(); i += 3) {
        for (int k = 1; k <= 16; ++k)
            points.push_back(
                bezier_at({from, rows[i], rows[i + 1], rows[i + 2]}, k / 16.0));
        from = rows[i + 2];
    }
    return points;
}

double distance(PathPoint a, PathPoint b) { return std::hypot(a.x - b.x, a.y - b.y); }

TEST(EllipticalArc, IsTheArcOfTheEllipseThatItsEndsAndFlagsName) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 300; ++round) {
        const Ellipse ellipse{200 * unit(random) - 100,
                              200 * unit(random) - 100,
                              1 + 50 * unit(random),
                              1 + 50 * unit(random),
                              2 * kPi * unit(random)};
        const double first = 2 * kPi * unit(random);
        // Not within 3 degrees of nothing, of a half and of a whole, where flags are moot.
        double span = 0.05 + (kPi - 0.1) * unit(random);
        if (unit(random) < 0.5) span += kPi;
        if (unit(random) < 0.5) span = -span;
        EllipticalArc arc;
        arc.from = ellipse.at(first);
        arc.to = ellipse.at(first + span);
        arc.radius_x = ellipse.rx;
        arc.radius_y = -ellipse.ry;  // the sign does not count
        arc.rotation_degrees = ellipse.turn * 180 / kPi + 360;
        arc.large = std::fabs(span) > kPi;
        arc.sweep = span > 0;
        const std::vector<PathPoint> points = drawn(arc);
        ASSERT_EQ(points.size(),
                  1 + 16 * std::size_t(std::ceil(std::fabs(span) / (kPi / 4))));
        EXPECT_EQ(points.back(), arc.to);
        const double radius = std::max(ellipse.rx, ellipse.ry);
        const std::size_t steps = 20 * (points.size() - 1);
        std::size_t reached = 0;  // points of the ellipse come in order
        for (const PathPoint& point : points) {
            double nearest = distance(point, ellipse.at(first));
            std::size_t best = reached;
            for (std::size_t k = reached; k <= steps; ++k) {
                const double d =
                    distance(point, ellipse.at(first + span * double(k) / double(steps)));
                if (d < nearest) {
                    nearest = d;
                    best = k;
                }
                if (k > best + 60) break;
            }
            reached = best;
            // The step along the ellipse, halved, plus the bound.
            const double step = radius * std::fabs(span) / double(steps) / 2;
            EXPECT_LE(nearest, step + 4.3e-6 * radius) << "round " << round;
        }
        EXPECT_GE(reached + 40, steps);
    }
}

TEST(EllipticalArc, OfACircleIsWithinItsBound) {
    // Distance to a circle needs no search: all of the bound is seen, and it is tight.
    const EllipticalArc arc{{100, 0}, 100, 100, 0, false, true, {0, 100}};
    double worst = 0;
    for (const PathPoint& point : drawn(arc))
        worst = std::max(worst, std::fabs(std::hypot(point.x, point.y) - 100));
    EXPECT_LE(worst, 100 * 4.3e-6);
    EXPECT_GE(worst, 100 * 4.0e-6);
}

TEST(EllipticalArc, RadiiThatAreTooSmallGrowUntilTheyReach) {
    const EllipticalArc arc{{-50, 0}, 1, 2, 0, false, true, {50, 0}};
    double highest = 0;
    for (const PathPoint& point : drawn(arc)) {
        EXPECT_NEAR(std::hypot(point.x / 50, point.y / 100), 1, 1e-5);
        highest = std::min(highest, point.y);
    }
    EXPECT_NEAR(highest, -100, 1e-9);
}

TEST(EllipticalArc, HalfACircleHasFourSegments) {
    for (const bool sweep : {false, true}) {
        EXPECT_EQ(arc_beziers({{-1, 0}, 1, 1, 0, false, sweep, {1, 0}}).size(), 12U);
        EXPECT_EQ(arc_beziers({{0.1, 0.2}, 1, 1, 77, true, sweep, {0.3, 0.7}}).size() % 3,
                  0U);
    }
}

TEST(EllipticalArc, ThatCannotCurveIsStraightOrNothing) {
    EXPECT_TRUE(arc_beziers({{3, 4}, 5, 5, 0, true, true, {3, 4}}).empty());
    for (const auto& [rx, ry] : {std::pair(0.0, 5.0), {5.0, 0.0}, {1e300, 1e300}}) {
        const std::vector<PathPoint> points =
            arc_beziers({{0, 0}, rx, ry, 30, false, true, {1e-30, 3e-30}});
        ASSERT_EQ(points.size(), 3U) << rx << " " << ry;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(points[i].x, 1e-30 * double(i + 1) / 3, 1e-44);
            EXPECT_NEAR(points[i].y, 1e-30 * double(i + 1), 1e-44);
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
