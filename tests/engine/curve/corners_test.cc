#include "engine/curve/corners.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "engine/curve/bspline.h"
#include "engine/curve/fit.h"

namespace haarmony::curve {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr double kPi = std::numbers::pi;

using Corner = std::array<double, 2>;

// A polyline through the vertices, `per_side` samples a side, with noise.
Points polyline(const std::vector<Corner>& vertices,
                std::size_t per_side,
                double noise,
                unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, 1);
    Points points((vertices.size() - 1) * per_side + 1, 2);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t side = std::min(i / per_side, vertices.size() - 2);
        const double t = double(i - side * per_side) / double(per_side);
        for (std::size_t axis = 0; axis < 2; ++axis) {
            points[i][axis] = vertices[side][axis] +
                              t * (vertices[side + 1][axis] - vertices[side][axis]) +
                              noise * normal(random);
        }
    }
    return points;
}

Points circle(std::size_t count, double radius, double turns) {
    Points points(count, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const double a = 2 * kPi * turns * double(i) / double(count);
        points[i][0] = radius * std::cos(a);
        points[i][1] = radius * std::sin(a);
    }
    return points;
}

const std::vector<Corner> kZigzag = {{0, 0}, {100, 0}, {100, 80}, {20, 120}, {150, 150}};

TEST(Corners, OfAPolylineAreItsVertices) {
    for (const std::size_t per_side : {1U, 2U, 10U, 200U, 5000U}) {
        EXPECT_THAT(detect_corners(polyline(kZigzag, per_side, 0, 1), Ends::kOpen, {}),
                    ElementsAre(per_side, 2 * per_side, 3 * per_side))
            << per_side;
    }
}

TEST(Corners, AreFoundUnderNoise) {
    // The diagonal is 212: noise of 0.2 % of it, which puts the corners a few samples off.
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const std::vector<std::size_t> corners =
            detect_corners(polyline(kZigzag, 150, 0.4, seed), Ends::kOpen, {});
        ASSERT_EQ(corners.size(), 3U) << "seed " << seed;
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_NEAR(double(corners[i]), 150.0 * double(i + 1), 4) << "seed " << seed;
    }
}

TEST(Corners, OfAMillionNoisySamplesAreFoundInLinearTime) {
    const std::vector<std::size_t> corners =
        detect_corners(polyline(kZigzag, 50'000, 0.2, 1), Ends::kOpen, {});
    ASSERT_EQ(corners.size(), 3U);
    // A noisy sample near the vertex is as far out as the vertex itself.
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(double(corners[i]), 50'000.0 * double(i + 1), 1000);
}

TEST(Corners, AnArcHasNone) {
    EXPECT_THAT(detect_corners(circle(500, 50, 0.9), Ends::kOpen, {}), IsEmpty());
    EXPECT_THAT(detect_corners(circle(500, 50, 1), Ends::kClosed, {}), IsEmpty());
    // Loops whose radius is a few windows, beside a long line.
    Points loops(1200, 2);
    for (std::size_t i = 0; i < loops.size(); ++i) {
        const double a = 8 * kPi * double(i) / 1200;
        loops[i][0] = 12 * a + 25 * std::cos(a);
        loops[i][1] = 25 * std::sin(a);
    }
    EXPECT_THAT(detect_corners(loops, Ends::kOpen, {}), IsEmpty());
}

TEST(Corners, ABendTighterThanTheWindowIsOne) {
    // Two legs with an arc of radius 2 between; the diagonal is 141, the window 4.2 or 40.
    Points bend(0, 2);
    std::vector<Corner> rows;
    for (int i = 0; i <= 98; ++i) rows.push_back({double(i), 0});
    for (int i = 1; i < 10; ++i) {
        const double a = kPi / 20 * i;
        rows.push_back({98 + 2 * std::sin(a), 2 - 2 * std::cos(a)});
    }
    for (int i = 2; i <= 100; ++i) rows.push_back({100, double(i)});
    bend = Points(rows.size(), 2);
    for (std::size_t i = 0; i < rows.size(); ++i)
        std::ranges::copy(rows[i], bend[i].begin());
    EXPECT_THAT(detect_corners(bend, Ends::kOpen, {.degrees = 40, .window = 40}),
                ElementsAre(testing::AllOf(testing::Ge(98U), testing::Le(108U))));
    EXPECT_THAT(detect_corners(bend, Ends::kOpen, {.degrees = 40, .window = 2}),
                IsEmpty());
}

TEST(Corners, TurnByTheAngleAtLeast) {
    const std::vector<Corner> shallow = {
        {0, 0}, {100, 0}, {200, 100 * std::tan(kPi / 6)}};
    const Points samples = polyline(shallow, 100, 0, 1);
    EXPECT_THAT(detect_corners(samples, Ends::kOpen, {.degrees = 29}), ElementsAre(100));
    EXPECT_THAT(detect_corners(samples, Ends::kOpen, {.degrees = 31}), IsEmpty());
}

TEST(Corners, AReversalIsOne) {
    const Points samples = polyline({{0, 0}, {100, 0}, {30, 0.001}}, 100, 0, 1);
    EXPECT_THAT(detect_corners(samples, Ends::kOpen, {}), ElementsAre(100));
}

TEST(Corners, OfAClosedStrokeMayBeAtItsStart) {
    const std::vector<Corner> square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0.1}};
    const Points samples = polyline(square, 100, 0, 1);
    EXPECT_THAT(detect_corners(samples, Ends::kClosed, {}),
                ElementsAre(0, 100, 200, 300));
    EXPECT_THAT(detect_corners(samples, Ends::kOpen, {}), ElementsAre(100, 200, 300));
}

TEST(Corners, OfNothingAreNone) {
    EXPECT_THAT(detect_corners(Points(2, 2), Ends::kOpen, {}), IsEmpty());
    EXPECT_THAT(detect_corners(Points(50, 2), Ends::kClosed, {}), IsEmpty());
    EXPECT_THAT(detect_corners(Points(50, 1), Ends::kOpen, {}), IsEmpty());
    // Samples that rest at the end.
    Points rest = polyline({{0, 0}, {10, 0}, {10, 0}}, 20, 0, 1);
    EXPECT_THAT(detect_corners(rest, Ends::kOpen, {}), IsEmpty());
    EXPECT_THAT(detect_corners(rest, Ends::kClosed, {}), testing::Each(testing::Lt(41U)));
}

TEST(CurveCorners, AreWhereControlPointsCoincide) {
    // Three equal control points of an inner part make the curve pass through them with a
    // corner, at the middle one's peak.
    Points control(control_count(5, Ends::kOpen), 2);
    const std::size_t middle = 14;
    for (std::size_t i = 0; i < control.size(); ++i) {
        const std::size_t k = i < middle ? i : i > middle + 2 ? i - 2 : middle;
        control[i][0] = double(k);
        control[i][1] = std::fabs(double(k) - double(middle));
    }
    const std::vector<double> corners = detect_curve_corners(control, Ends::kOpen, {});
    ASSERT_EQ(corners.size(), 1U);
    EXPECT_NEAR(corners[0], peak_of_basis(5, Ends::kOpen, middle + 1), 1.0 / 512);
    const Points round = fit(circle(300, 50, 1), 4, {.ends = Ends::kClosed}).control;
    EXPECT_THAT(detect_curve_corners(round, Ends::kClosed, {}), IsEmpty());
}

}  // namespace
}  // namespace haarmony::curve
