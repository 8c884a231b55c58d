#include "engine/curve/plane_cubic.h"

#include <gtest/gtest.h>

#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

constexpr PlaneCubic kArch = {PlaneVector{0, 0}, {10, 40}, {50, 30}, {60, -5}};

TEST(PlaneCubic, PowersOfTAndBernsteinPolynomialsAreTheSameCurve) {
    const PlanePolynomial polynomial(kArch);
    const Points rows = rows_of(kArch);
    for (int i = 0; i <= 20; ++i) {
        const double t = i / 20.0;
        const std::vector<double> want = bernstein_sum(rows, 0, t);
        EXPECT_NEAR(polynomial.value(t).x, want[0], 1e-12) << t;
        EXPECT_NEAR(polynomial.value(t).y, want[1], 1e-12) << t;
    }
}

TEST(PlaneCubic, SlopeAndBendAreItsDerivatives) {
    const PlanePolynomial polynomial(kArch);
    const double h = 1e-5;
    for (const double t : {0.1, 0.5, 0.9}) {
        const PlaneVector slope =
            (1 / (2 * h)) * (polynomial.value(t + h) - polynomial.value(t - h));
        const PlaneVector bend =
            (1 / (2 * h)) * (polynomial.slope(t + h) - polynomial.slope(t - h));
        EXPECT_NEAR(norm(polynomial.slope(t) - slope), 0, 1e-6) << t;
        EXPECT_NEAR(norm(polynomial.bend(t) - bend), 0, 1e-6) << t;
    }
}

TEST(PlaneCubic, SplitPartsAreTheSameCurve) {
    const PlanePolynomial whole(kArch);
    const auto [before, after] = split(kArch, 0.3);
    for (int i = 0; i <= 10; ++i) {
        const double t = i / 10.0;
        EXPECT_NEAR(
            norm(PlanePolynomial(before).value(t) - whole.value(0.3 * t)), 0, 1e-12);
        EXPECT_NEAR(
            norm(PlanePolynomial(after).value(t) - whole.value(0.3 + 0.7 * t)), 0, 1e-12);
    }
}

TEST(PlaneCubic, NewtonsStepsEndWhereTheNormalGoesThroughThePoint) {
    const PlanePolynomial polynomial(kArch);
    const PlaneVector q{25, 15};
    const double t = polynomial.nearest(q, 0.3, 0, 1, 20);
    EXPECT_NEAR(dot(polynomial.value(t) - q, polynomial.slope(t)), 0, 1e-9);
}

TEST(PlaneCubic, NewtonsStepsStayWithinTheirLimits) {
    const PlanePolynomial polynomial(kArch);
    EXPECT_EQ(polynomial.nearest({500, -300}, 0.3, 0.2, 0.4, 20), 0.4);
    EXPECT_EQ(polynomial.nearest({-500, -300}, 0.3, 0.2, 0.4, 20), 0.2);
}

TEST(PlaneCubic, ANewtonStepOnAPointGoesNowhere) {
    const PlanePolynomial still(PlaneCubic{PlaneVector{1, 1}, {1, 1}, {1, 1}, {1, 1}});
    EXPECT_EQ(still.nearest({5, 5}, 0.5, 0, 1, 3), 0.5);
}

TEST(PlaneCubic, TangentsLookPastControlPointsThatCoincide) {
    const PlaneCubic cubic = {PlaneVector{0, 0}, {0, 0}, {0, 0}, {0, 2}};
    EXPECT_EQ(tangent_at_start(cubic), (PlaneVector{0, 1}));
    EXPECT_EQ(tangent_at_end(cubic), (PlaneVector{0, 1}));
    const PlaneCubic late = {PlaneVector{0, 0}, {3, 0}, {5, 5}, {5, 5}};
    EXPECT_EQ(tangent_at_start(late), (PlaneVector{1, 0}));
    EXPECT_NEAR(norm(tangent_at_end(late) - unit({2, 5})), 0, 1e-15);
}

TEST(PlaneCubic, TangentsDoNotFollowRoundingErrors) {
    const PlaneCubic cubic = {
        PlaneVector{300, 100}, {300, 100 + 2e-14}, {310, 100}, {320, 100}};
    EXPECT_EQ(tangent_at_start(cubic), (PlaneVector{1, 0}));
}

TEST(PlaneCubic, APointHasNoTangent) {
    const PlaneCubic still = {PlaneVector{7, 7}, {7, 7}, {7, 7}, {7, 7}};
    EXPECT_EQ(tangent_at_start(still), PlaneVector{});
    EXPECT_EQ(tangent_at_end(still), PlaneVector{});
}

TEST(PlaneCubic, ACurveOfOneDimensionLiesOnTheAxis) {
    Points rows(4, 1);
    rows[2][0] = 9;
    EXPECT_EQ(cubic_at(rows, 0)[2], (PlaneVector{9, 0}));
    EXPECT_EQ(cubics_of(rows).size(), 1U);
}

}  // namespace
}  // namespace haarmony::curve
