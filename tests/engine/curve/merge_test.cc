#include "engine/curve/merge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/curve/bspline.h"
#include "engine/curve/multires_curve.h"
#include "engine/curve/plane_cubic.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

// In degrees, where segment i ends and segment `next` starts.
double turn(const Points& bezier, std::size_t i, std::size_t next) {
    const PlaneVector in = tangent_at_end(cubic_at(bezier, 4 * i));
    const PlaneVector out = tangent_at_start(cubic_at(bezier, 4 * next));
    const double cross = in.x * out.y - in.y * out.x;
    return std::abs(std::atan2(cross, dot(in, out))) * 180 / std::numbers::pi;
}

Points rows(const Points& from, std::size_t first, std::size_t last) {
    Points part(last - first, from.dimension());
    for (std::size_t i = first; i < last; ++i) {
        std::ranges::copy(from[i], part[i - first].begin());
    }
    return part;
}

class Merge : public testing::TestWithParam<Ends> {};

TEST_P(Merge, KeepsTheToleranceInBothDirectionsSegmentBySegment) {
    for (const double noise : {0.0, 0.5, 4.0}) {
        const Points chain = bezier_points(
            drawn_stroke({.level = 6, .ends = GetParam(), .noise = noise}), GetParam());
        for (const double tolerance : {0.2, 1.0, 6.0}) {
            const MergedSegments merged = merge(chain, tolerance, {});
            EXPECT_LE(merged.bound, tolerance);
            ASSERT_EQ(merged.joints.size(), merged.bezier.size() / 4 + 1);
            for (std::size_t i = 0; i + 1 < merged.joints.size(); ++i) {
                const std::size_t from = merged.joints[i];
                const std::size_t to = merged.joints[i + 1];
                const Points run = four_rows_each(rows(chain, 3 * from, 3 * to + 1));
                const Points segment = rows(merged.bezier, 4 * i, 4 * i + 4);
                const std::size_t dense = 20 * (to - from);
                const double gap =
                    std::max(widest_gap(run, dense), widest_gap(segment, dense));
                EXPECT_LE(sampled_hausdorff(run, segment, dense), merged.bound + gap)
                    << noise << ' ' << tolerance << ' ' << i;
            }
        }
    }
}

TEST_P(Merge, JointsLieOnTheChainAndDoNotTurn) {
    const Points chain = bezier_points(
        drawn_stroke({.level = 7, .ends = GetParam(), .noise = 1}), GetParam());
    const MergedSegments merged = merge(chain, 2, {});
    const std::size_t count = merged.bezier.size() / 4;
    ASSERT_GT(count, 3U);
    ASSERT_LT(count, 100U);
    for (std::size_t i = 0; i < count; ++i) {
        EXPECT_TRUE(
            std::ranges::equal(merged.bezier[4 * i], chain[3 * merged.joints[i]]));
        EXPECT_TRUE(std::ranges::equal(merged.bezier[4 * i + 3],
                                       chain[3 * merged.joints[i + 1]]));
        if (i + 1 < count || GetParam() == Ends::kClosed) {
            EXPECT_LT(turn(merged.bezier, i, (i + 1) % count), 1e-3) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Both,
                         Merge,
                         testing::Values(Ends::kOpen, Ends::kClosed),
                         [](const auto& ends) {
                             return ends.param == Ends::kOpen ? "Open" : "Closed";
                         });

TEST(Merging, NeverTakesMoreSegmentsThanThereWere) {
    for (const double tolerance : {1e-13, 1e-6, 0.01, 0.1}) {
        const Points chain =
            bezier_points(drawn_stroke({.level = 6, .noise = 30}), Ends::kOpen);
        EXPECT_LE(merge(chain, tolerance, {}).joints.size() - 1, 64U) << tolerance;
    }
}

TEST(Merging, ATinyToleranceLeavesTheCurveAsItIs) {
    const Points chain = bezier_points(
        drawn_stroke({.level = 6, .dimension = 3, .noise = 30}), Ends::kOpen);
    const MergedSegments merged = merge(chain, 1e-13, {});
    EXPECT_EQ(merged.bezier, four_rows_each(chain));
    EXPECT_EQ(merged.bound, 0);
}

// A cubic refined to 64 pieces becomes one again.
TEST(Merging, UndoesRefinement) {
    Points control(control_count(0, Ends::kOpen), 3);
    const double rows[4][3] = {{0, 0, 1}, {100, 200, 4}, {250, -100, 2}, {300, 80, 3}};
    for (std::size_t i = 0; i < 4; ++i) std::ranges::copy(rows[i], control[i].begin());
    const Points original = control;
    for (int level = 0; level < 6; ++level)
        control = synthesize(control, {}, Ends::kOpen);
    const MergedSegments merged = merge(bezier_points(control, Ends::kOpen), 0.1, {});
    ASSERT_EQ(merged.bezier.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t d = 0; d < 3; ++d) {
            EXPECT_NEAR(merged.bezier[i][d], original[i][d], 1) << i << ' ' << d;
        }
    }
}

TEST(Merging, AVastToleranceGivesOneSegment) {
    const Points chain =
        bezier_points(drawn_stroke({.level = 6, .noise = 3}), Ends::kOpen);
    EXPECT_EQ(merge(chain, 1e6, {}).bezier.size(), 4U);
}

TEST(Merging, TakesFewerSegmentsTheMoreItMayErr) {
    const Points chain =
        bezier_points(drawn_stroke({.level = 8, .noise = 0.5}), Ends::kOpen);
    std::size_t before = 257;
    for (const double tolerance : {0.1, 0.5, 2.0, 10.0}) {
        const std::size_t count = merge(chain, tolerance, {}).bezier.size() / 4;
        EXPECT_LT(count, before) << tolerance;
        before = count;
    }
}

TEST(Merging, CornersStayJoints) {
    const Points chain =
        bezier_points(drawn_stroke({.level = 6, .noise = 0.1}), Ends::kOpen);
    const std::array<std::size_t, 2> corners = {13, 50};
    const MergedSegments merged = merge(chain, 5, corners);
    for (const std::size_t corner : corners) {
        EXPECT_NE(std::ranges::find(merged.joints, corner), merged.joints.end())
            << corner;
    }
}

// Two straight lines at a right angle, 8 pieces each.
TEST(Merging, AChainThatTurnsAtADeclaredCornerTurnsThere) {
    Points chain(3 * 16 + 1, 2);
    for (std::size_t i = 0; i < chain.size(); ++i) {
        chain[i][0] = std::min<double>(double(i), 24);
        chain[i][1] = std::max<double>(double(i), 24);
    }
    const std::array<std::size_t, 1> corner = {8};
    const MergedSegments merged = merge(chain, 0.01, corner);
    EXPECT_EQ(merged.joints, (std::vector<std::size_t>{0, 8, 16}));
    EXPECT_NEAR(turn(merged.bezier, 0, 1), 90, 1e-6);
}

TEST(Merging, WhatIsCarriedAlongFollows) {
    const Points chain = bezier_points(
        drawn_stroke({.level = 7, .dimension = 4, .noise = 0}), Ends::kOpen);
    const MergedSegments merged = merge(chain, 1, {});
    ASSERT_LT(merged.bezier.size() / 4, 64U);
    for (std::size_t i = 0; i + 1 < merged.joints.size(); ++i) {
        const std::vector<double> middle = bernstein_sum(merged.bezier, 4 * i, 0.5);
        // Within the values of the run, which are waves of unit height.
        const Points run =
            rows(chain, 3 * merged.joints[i], 3 * merged.joints[i + 1] + 1);
        for (std::size_t d = 2; d < 4; ++d) {
            double low = INFINITY;
            double high = -INFINITY;
            for (std::size_t k = 0; k < run.size(); ++k) {
                low = std::min(low, run[k][d]);
                high = std::max(high, run[k][d]);
            }
            EXPECT_GE(middle[d], low - 0.05) << i;
            EXPECT_LE(middle[d], high + 0.05) << i;
        }
    }
}

TEST(Merging, APointIsOneSegment) {
    Points still(3 * 8 + 1, 2);
    for (double& number : still.numbers()) number = 12;
    const MergedSegments merged = merge(still, 0.5, {});
    EXPECT_EQ(merged.bezier.size(), 4U);
    EXPECT_LE(merged.bound, 0.5);
}

TEST(Merging, ACurveOfOneDimensionIsMergedToo) {
    const Points chain = bezier_points(
        drawn_stroke({.level = 6, .dimension = 1, .noise = 2}), Ends::kOpen);
    const MergedSegments merged = merge(chain, 3, {});
    EXPECT_EQ(merged.bezier.dimension(), 1);
    EXPECT_LT(merged.bezier.size() / 4, 64U);
}

}  // namespace
}  // namespace haarmony::curve
