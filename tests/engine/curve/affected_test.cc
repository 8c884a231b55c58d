#include "engine/curve/affected.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

Points one_point_moved(int level, Ends ends, std::size_t index, double by) {
    Points change(control_count(level, ends), 2);
    change[index][1] = by;
    return change;
}

// Whether the curve goes further than `tolerance` between two knots, by looking closely.
bool moves(const Points& change, Ends ends, double from, double to, double tolerance) {
    constexpr int kSamples = 200;
    for (int i = 0; i <= kSamples; ++i) {
        const double u = from + (to - from) * i / kSamples;
        double square = 0;
        for (const double number : dense::point(change, ends, u)) {
            square += number * number;
        }
        if (std::sqrt(square) > tolerance) return true;
    }
    return false;
}

TEST(Affected, ByOneControlPointIsItsSupport) {
    for (std::size_t index = 0; index < 19; ++index) {
        const Points change = one_point_moved(4, Ends::kOpen, index, 1);
        const double first = std::max(0.0, double(index) - 3) / 16;
        const double last = std::min(16.0, double(index) + 1) / 16;
        EXPECT_EQ(affected_interval(change, Ends::kOpen, 4, 1e-9),
                  (Interval{first, last}))
            << index;
        EXPECT_EQ(affected_interval(change, Ends::kOpen, 2, 1e-9),
                  (Interval{std::floor(first * 4) / 4, std::ceil(last * 4) / 4}))
            << index;
    }
}

TEST(Affected, LooksAtTheCurveAndNotAtItsControlPoints) {
    // The basis function comes to 2/3 at the knot in the middle of its support.
    const Points change = one_point_moved(4, Ends::kOpen, 9, 1);
    EXPECT_EQ(affected_interval(change, Ends::kOpen, 4, 0.6667), Interval{});
    EXPECT_EQ(affected_interval(change, Ends::kOpen, 4, 0.6666),
              (Interval{7.0 / 16, 9.0 / 16}));
}

TEST(Affected, AgreesWithSamplesAtAnyTolerance) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const Points change = dense::random_curve(3, Ends::kOpen, 3, seed);
        for (const double tolerance : {5.0, 20.0, 40.0, 60.0, 90.0}) {
            Interval expected;
            for (int segment = 0; segment < 8; ++segment) {
                const double from = segment / 8.0;
                const double to = (segment + 1) / 8.0;
                if (!moves(change, Ends::kOpen, from, to, tolerance)) continue;
                if (expected == Interval{}) expected.from = from;
                expected.to = to;
            }
            EXPECT_EQ(affected_interval(change, Ends::kOpen, 3, tolerance), expected)
                << "seed " << seed << " tolerance " << tolerance;
        }
    }
}

TEST(Affected, OfAClosedCurveGoesRoundTheJoint) {
    // A point peaks at index / 16 and reaches two segments to both sides.
    EXPECT_EQ(affected_interval(
                  one_point_moved(4, Ends::kClosed, 8, 1), Ends::kClosed, 4, 1e-9),
              (Interval{6.0 / 16, 10.0 / 16}));
    EXPECT_EQ(affected_interval(
                  one_point_moved(4, Ends::kClosed, 1, 1), Ends::kClosed, 4, 1e-9),
              (Interval{15.0 / 16, 3.0 / 16}));
    EXPECT_EQ(affected_interval(
                  one_point_moved(4, Ends::kClosed, 2, 1), Ends::kClosed, 4, 1e-9),
              (Interval{0, 4.0 / 16}));
    EXPECT_EQ(affected_interval(
                  one_point_moved(4, Ends::kClosed, 14, 1), Ends::kClosed, 4, 1e-9),
              (Interval{12.0 / 16, 1}));
}

TEST(Affected, OfAClosedCurveLeavesOutTheLongestRest) {
    Points change = one_point_moved(4, Ends::kClosed, 2, 1);
    change[10][0] = 1;
    // Two rests of four segments: 4 to 8 and 12 to 16. The first one stays out.
    EXPECT_EQ(affected_interval(change, Ends::kClosed, 4, 1e-9),
              (Interval{8.0 / 16, 4.0 / 16}));
    change[4][0] = 1;
    EXPECT_EQ(affected_interval(change, Ends::kClosed, 4, 1e-9),
              (Interval{0, 12.0 / 16}));
}

TEST(Affected, OfACoarseClosedCurveIsAllOfIt) {
    for (const int level : {0, 1, 2}) {
        EXPECT_EQ(
            affected_interval(
                one_point_moved(level, Ends::kClosed, 0, 1), Ends::kClosed, level, 0),
            (Interval{0, 1}))
            << level;
    }
}

TEST(Affected, ByNothingIsNothing) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        EXPECT_EQ(affected_interval(Points(control_count(3, ends), 2), ends, 3, 0),
                  Interval{});
    }
}

// A coarse closed curve moves as a whole, by the same everywhere but for rounding.
TEST(Affected, EndsAtOnceWhereEverythingMovesByTheTolerance) {
    for (const double by : {1.0, 0.1, 1.0 / 3}) {
        Points change(control_count(6, Ends::kClosed), 2);
        for (std::size_t i = 0; i < change.size(); ++i) change[i][1] = by;
        // The last bit decides, one way or the other, but not by halving 2^26 times.
        for (const double ulps : {-1.0, 0.0, 1.0}) {
            const double tolerance = by * (1 + ulps * 2.2e-16);
            const Interval found = affected_interval(change, Ends::kClosed, 6, tolerance);
            EXPECT_TRUE(found.from >= 0 && found.to <= 1) << by;
        }
        EXPECT_EQ(affected_interval(change, Ends::kClosed, 6, by * (1 + 1e-8)),
                  Interval{});
        EXPECT_EQ(affected_interval(change, Ends::kClosed, 6, by * (1 - 1e-8)),
                  (Interval{0, 1}));
    }
}

TEST(Affected, ByWhatIsNotANumberIsAllThatItReaches) {
    EXPECT_EQ(affected_interval(
                  one_point_moved(4, Ends::kOpen, 8, std::nan("")), Ends::kOpen, 4, 1),
              (Interval{5.0 / 16, 9.0 / 16}));
}

TEST(Affected, AllFiniteFindsTheOneThatIsNot) {
    Points points(2, 3);
    EXPECT_TRUE(all_finite(points));
    points[1][1] = std::numeric_limits<double>::infinity();
    EXPECT_FALSE(all_finite(points));
}

TEST(Affected, CoordinateSizeIsTheLargestOfAll) {
    Points points(2, 3);
    EXPECT_EQ(coordinate_size(points), 0);
    points[1][2] = -7;
    points[0][0] = 5;
    EXPECT_EQ(coordinate_size(points), 7);
}

}  // namespace
}  // namespace haarmony::curve
