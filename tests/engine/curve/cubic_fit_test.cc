#include "engine/curve/cubic_fit.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

// A cubic cut at uneven places, as a chain.
Points pieces_of(PlaneCubic cubic, const std::vector<double>& shares) {
    Points chain(3 * (shares.size() + 1) + 1, 2);
    const auto write = [&chain](std::size_t piece, const PlaneCubic& part) {
        for (std::size_t i = 0; i < 4; ++i) {
            chain[3 * piece + i][0] = part[i].x;
            chain[3 * piece + i][1] = part[i].y;
        }
    };
    for (std::size_t i = 0; i < shares.size(); ++i) {
        const auto [before, after] = split(cubic, shares[i]);
        write(i, before);
        cubic = after;
    }
    write(shares.size(), cubic);
    return chain;
}

TEST(CubicFit, FindsTheCubicThatWasCut) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> length(30, 50);
    std::uniform_real_distribution<double> angle(-0.7, 0.7);
    int found = 0;
    for (int i = 0; i < 50; ++i) {
        const double a = angle(random);
        const double b = angle(random);
        const PlaneVector leave = length(random) * PlaneVector{std::cos(a), std::sin(a)};
        const PlaneVector arrive = length(random) * PlaneVector{std::cos(b), std::sin(b)};
        const PlaneVector end{120, 10};
        const PlaneCubic cubic = {PlaneVector{}, leave, end - arrive, end};
        const Chain chain = make_chain(pieces_of(cubic, {0.2, 0.5, 0.4}));
        CubicFitter fitter(chain, 0.01);
        const std::optional<PlaneCubic> fit = fitter.fit(0, 4);
        if (!fit) continue;
        ++found;
        // A hundredth of a unit at the samples says little about each control point.
        const Points want = pieces_of(cubic, {});
        const Points got = pieces_of(*fit, {});
        EXPECT_LE(sampled_hausdorff(want, got, 1000), 0.1) << i;
    }
    EXPECT_GE(found, 45);
}

TEST(CubicFit, EndsLieOnTheRunAlongItsTangents) {
    const Points bezier =
        pieces_of({PlaneVector{0, 0}, {10, 60}, {80, -40}, {100, 30}}, {0.3, 0.5});
    const Chain chain = make_chain(bezier);
    CubicFitter fitter(chain, 5);
    const std::optional<PlaneCubic> fit = fitter.fit(1, 3);
    ASSERT_TRUE(fit);
    EXPECT_EQ((*fit)[0], chain.pieces[1][0]);
    EXPECT_EQ((*fit)[3], chain.pieces[2][3]);
    EXPECT_NEAR(norm(tangent_at_start(*fit) - chain.leaving[1]), 0, 1e-12);
    EXPECT_NEAR(norm(tangent_at_end(*fit) - chain.arriving[2]), 0, 1e-12);
}

// A quarter of a circle is known to need an error of 2.7e-4 of the radius.
TEST(CubicFit, OfAQuarterCircleIsAsGoodAsTheKnownOne) {
    constexpr double kRadius = 100;
    constexpr int kPieces = 16;
    Points chain(3 * kPieces + 1, 2);
    const double step = std::numbers::pi / 2 / kPieces;
    const double tangent = 4.0 / 3 * std::tan(step / 4) * kRadius;
    for (int i = 0; i <= kPieces; ++i) {
        const double a = i * step;
        const PlaneVector on = kRadius * PlaneVector{std::cos(a), std::sin(a)};
        const PlaneVector along = tangent * PlaneVector{-std::sin(a), std::cos(a)};
        for (const int side : {-1, 0, 1}) {
            const int row = 3 * i + side;
            if (row < 0 || row > 3 * kPieces) continue;
            chain[std::size_t(row)][0] = (on + side * along).x;
            chain[std::size_t(row)][1] = (on + side * along).y;
        }
    }
    const Chain made = make_chain(chain);
    CubicFitter fitter(made, 0.03);
    const std::optional<PlaneCubic> fit = fitter.fit(0, kPieces);
    ASSERT_TRUE(fit);
    const PlanePolynomial polynomial(*fit);
    for (int i = 0; i <= 100; ++i) {
        EXPECT_NEAR(norm(polynomial.value(i / 100.0)), kRadius, 0.028) << i;
    }
}

TEST(CubicFit, SaysSoWhenSamplesAreHopelesslyFar) {
    const Points zigzag = pieces_of(
        {PlaneVector{0, 0}, {300, 300}, {-200, 300}, {100, 0}}, {0.25, 0.33, 0.5});
    Points folded = zigzag;
    for (std::size_t i = 0; i < folded.size(); ++i) folded[i][1] *= i % 6 < 3 ? 1 : -1;
    const Chain chain = make_chain(folded);
    CubicFitter fitter(chain, 0.5);
    EXPECT_FALSE(fitter.fit(0, 4));
}

TEST(CubicFit, OfARunWithoutLengthIsAPoint) {
    Points still(7, 2);
    for (double& number : still.numbers()) number = 4;
    const Chain chain = make_chain(still);
    CubicFitter fitter(chain, 0.5);
    const std::optional<PlaneCubic> fit = fitter.fit(0, 2);
    ASSERT_TRUE(fit);
    for (const PlaneVector p : *fit) EXPECT_EQ(p, (PlaneVector{4, 4}));
}

}  // namespace
}  // namespace haarmony::curve
