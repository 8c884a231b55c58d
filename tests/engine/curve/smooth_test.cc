#include "engine/curve/smooth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/curve/bspline.h"
#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr Ends kBothEnds[] = {Ends::kOpen, Ends::kClosed};

TEST(Smooth, BetweenTwoLevelsLiesTheirMixture) {
    for (const Ends ends : kBothEnds) {
        const Points control = dense::random_curve(4, ends, 3, 5);
        const MultiresCurve curve = decompose(control, ends);
        for (const double level : {0.25, 1.5, 2.875, 3.4}) {
            const int j = int(level);
            const double t = level - j;
            const Points smoothed = smooth(curve, level, SmoothedEnds::kFree);
            ASSERT_EQ(smoothed.size(), control_count(j + 1, ends)) << level;
            const Points low = dense::project(control, ends, j);
            const Points high = dense::project(control, ends, j + 1);
            for (const double u : {0.0, 0.2, 0.55, 0.875, 1.0}) {
                const auto found = dense::point(smoothed, ends, u);
                const auto below = dense::point(low, ends, u);
                const auto above = dense::point(high, ends, u);
                for (std::size_t d = 0; d < 3; ++d)
                    EXPECT_NEAR(found[d], (1 - t) * below[d] + t * above[d], 1e-10)
                        << level << ", " << u;
            }
        }
    }
}

TEST(Smooth, AtAnIntegerLevelItIsThatLevel) {
    for (const Ends ends : kBothEnds) {
        const Points control = dense::random_curve(5, ends, 2, 6);
        const MultiresCurve curve = decompose(control, ends);
        for (int level = 0; level <= 5; ++level)
            EXPECT_EQ(smooth(curve, level, SmoothedEnds::kFree),
                      reconstruct(curve, level));
    }
}

TEST(Smooth, PinnedEndsAreThoseOfTheCurve) {
    const Points control = dense::random_curve(7, Ends::kOpen, 3, 7);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const double level : {0.0, 0.5, 1.0, 3.3, 6.9, 7.0}) {
        const Points pinned = smooth(curve, level, SmoothedEnds::kPinned);
        const Points free = smooth(curve, level, SmoothedEnds::kFree);
        ASSERT_EQ(pinned.size(), free.size());
        const std::size_t last = pinned.size() - 1;
        for (std::size_t d = 0; d < 3; ++d) {
            EXPECT_NEAR(pinned[0][d], control[0][d], 1e-11) << level;
            EXPECT_NEAR(pinned[last][d], control[control.size() - 1][d], 1e-11) << level;
            for (std::size_t i = 1; i < last; ++i)
                EXPECT_EQ(pinned[i][d], free[i][d]) << level;
        }
        if (level < 7) {
            EXPECT_GT(std::abs(free[0][0] - control[0][0]), 1e-3) << level;
        }
    }
}

TEST(Smooth, AClosedCurveHasNoEndsToPin) {
    const MultiresCurve curve =
        decompose(dense::random_curve(5, Ends::kClosed, 2, 8), Ends::kClosed);
    EXPECT_EQ(smooth(curve, 2.5, SmoothedEnds::kPinned),
              smooth(curve, 2.5, SmoothedEnds::kFree));
}

TEST(Smooth, ItIsContinuousInTheLevel) {
    const Points control = dense::random_curve(6, Ends::kOpen, 2, 9);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const double level : {1.0, 2.0, 5.0}) {
        const Points at = smooth(curve, level, SmoothedEnds::kFree);
        for (const double near : {level - 1e-7, level + 1e-7}) {
            const Points beside = smooth(curve, near, SmoothedEnds::kFree);
            for (const double u : {0.0, 0.3, 0.7, 1.0})
                EXPECT_NEAR(point_at(beside, Ends::kOpen, u)[0],
                            point_at(at, Ends::kOpen, u)[0],
                            1e-3)
                    << near << ", " << u;
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
