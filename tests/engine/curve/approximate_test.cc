#include "engine/curve/approximate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/curve/bspline.h"
#include "engine/curve/plane_cubic.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

constexpr std::array kAll = {Joining::kDyadic, Joining::kC0, Joining::kG1};

Approximation approximated(const Points& control,
                           Ends ends,
                           double tolerance,
                           Joining joining,
                           std::span<const double> corners) {
    auto result = approximate(control, ends, tolerance, joining, corners);
    EXPECT_TRUE(result) << result.error().message;
    return std::move(result).value();
}

double turn(const Points& bezier, std::size_t i, std::size_t next) {
    const PlaneVector in = tangent_at_end(cubic_at(bezier, 4 * i));
    const PlaneVector out = tangent_at_start(cubic_at(bezier, 4 * next));
    return std::acos(std::clamp(dot(in, out), -1.0, 1.0)) * 180 / std::numbers::pi;
}

class Approximate : public testing::TestWithParam<Ends> {};

TEST_P(Approximate, ErrorIsWithinTheBoundAndTheBoundWithinTheTolerance) {
    for (std::uint32_t seed = 1; seed <= 2; ++seed) {
        for (const double noise : {0.0, 0.3, 3.0, 40.0}) {
            const Points control = drawn_stroke(
                {.level = 7, .ends = GetParam(), .noise = noise, .seed = seed});
            const Points original = four_rows_each(bezier_points(control, GetParam()));
            for (const Joining joining : kAll) {
                for (const double tolerance : {1e-10, 0.1, 1.0, 20.0, 1e4}) {
                    const Approximation a =
                        approximated(control, GetParam(), tolerance, joining, {});
                    EXPECT_LE(a.max_error, a.bound) << seed << ' ' << noise;
                    EXPECT_LE(a.bound, tolerance) << seed << ' ' << noise;
                    EXPECT_EQ(a.tolerance, tolerance);
                    EXPECT_EQ(a.possible, 128U);
                    EXPECT_LE(a.count(), 128U);
                    // At equal u or not: no point is farther from the other curve.
                    const double seen = sampled_hausdorff(original, a.bezier, 6);
                    const double gap =
                        std::max(widest_gap(original, 6), widest_gap(a.bezier, 6));
                    EXPECT_LE(seen, a.max_error + gap)
                        << seed << ' ' << noise << ' ' << tolerance << ' '
                        << int(joining);
                }
            }
        }
    }
}

TEST_P(Approximate, SegmentsThatMeetAreMoreAndMergedOnesFewer) {
    const Points control = drawn_stroke({.level = 8, .ends = GetParam(), .noise = 0.5});
    for (const double tolerance : {0.5, 2.0, 5.0}) {
        const auto count = [&](Joining joining) {
            return approximated(control, GetParam(), tolerance, joining, {}).count();
        };
        EXPECT_LE(count(Joining::kDyadic), count(Joining::kC0)) << tolerance;
        EXPECT_LT(count(Joining::kG1), count(Joining::kDyadic)) << tolerance;
    }
}

TEST_P(Approximate, SmoothJointsTurnByLessThanADegree) {
    const Points control = drawn_stroke({.level = 7, .ends = GetParam(), .noise = 2});
    const Approximation a = approximated(control, GetParam(), 1, Joining::kG1, {});
    const std::size_t joints = GetParam() == Ends::kClosed ? a.count() : a.count() - 1;
    for (std::size_t i = 0; i < joints; ++i) {
        EXPECT_LT(turn(a.bezier, i, (i + 1) % a.count()), 1) << i;
    }
}

TEST_P(Approximate, CornersAreJoints) {
    const Points control = drawn_stroke({.level = 6, .ends = GetParam()});
    const std::array corners = {0.5, 0.203};
    for (const Joining joining : kAll) {
        const Approximation a = approximated(control, GetParam(), 3, joining, corners);
        EXPECT_LE(a.max_error, a.bound);
        EXPECT_LE(a.bound, 3);
        EXPECT_EQ(a.possible, 64U);
        EXPECT_LT(a.count(), 64U);
        for (const double u : corners) {
            const std::vector<double> point = point_at(control, GetParam(), u);
            double nearest = INFINITY;
            for (std::size_t i = 0; i < a.count(); ++i) {
                nearest = std::min(
                    nearest,
                    norm(in_plane(a.bezier[4 * i]) - in_plane(std::span(point))));
            }
            // A segment with a corner within is the curve's own; at a knot Figure 3.12 is
            // within the tolerance.
            EXPECT_LT(nearest, joining == Joining::kDyadic && u == 0.5 ? 3 : 1e-9)
                << u << ' ' << int(joining);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Both,
                         Approximate,
                         testing::Values(Ends::kOpen, Ends::kClosed),
                         [](const auto& ends) {
                             return ends.param == Ends::kOpen ? "Open" : "Closed";
                         });

// Three control points in one place make a corner that no rounding error may hide.
TEST(ApproximateSmoothly, TurnsOnlyWhereTheCurveItselfDoes) {
    Points control = drawn_stroke({.level = 5, .noise = 0});
    for (std::size_t i = 16; i < 19; ++i) {
        control[i][0] = 301.1;
        control[i][1] = 77.7;
    }
    const Approximation a = approximated(control, Ends::kOpen, 0.2, Joining::kG1, {});
    for (std::size_t i = 0; i + 1 < a.count(); ++i) {
        const PlaneVector joint = in_plane(a.bezier[4 * i + 3]);
        if (norm(joint - PlaneVector{301.1, 77.7}) < 1e-6) continue;
        EXPECT_LT(turn(a.bezier, i, i + 1), 1) << i;
    }
}

TEST(ApproximateChain, TakesAnyChainAndKeepsItsCorners) {
    Points chain(3 * 6 + 1, 2);
    for (std::size_t i = 0; i < chain.size(); ++i) {
        chain[i][0] = i <= 9 ? double(i) : 9;
        chain[i][1] = i <= 9 ? 0 : double(i) - 9;
    }
    const auto a = approximate_chain(chain, Ends::kOpen, 0.1, std::array{0.5});
    ASSERT_TRUE(a);
    EXPECT_EQ(a->count(), 2U);
    EXPECT_EQ(a->possible, 6U);
    EXPECT_EQ(in_plane(a->bezier[3]), (PlaneVector{9, 0}));
}

// Two pieces with a tip between them, or around twice to where they began.
CorneredCurve with_a_tip(Ends ends) {
    CorneredCurve curve{ends, {0.5}, {}};
    if (ends == Ends::kClosed) curve.corners = {0.25, 0.5};
    for (const std::uint32_t seed : {1U, 2U})
        curve.pieces.push_back(drawn_stroke({.level = 6, .noise = 1, .seed = seed}));
    Points& second = curve.pieces[1];
    std::ranges::copy(curve.pieces[0][66], second[0].begin());
    if (ends == Ends::kClosed) std::ranges::copy(curve.pieces[0][0], second[66].begin());
    return curve;
}

TEST(ApproximatePieces, KeepTheirEndsAndMeetThere) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        const CorneredCurve curve = with_a_tip(ends);
        for (const Joining joining : kAll) {
            const auto a = approximate_pieces(curve, 2, joining);
            ASSERT_TRUE(a) << a.error().message;
            EXPECT_EQ(a->closed, ends == Ends::kClosed);
            EXPECT_EQ(a->possible, 128U);
            EXPECT_EQ(a->tolerance, 2);
            EXPECT_LT(a->count(), 128U);
            EXPECT_LE(a->max_error, a->bound);
            EXPECT_LE(a->bound, 2);
            EXPECT_GT(a->max_error, 0);
            const Points original = four_rows_each(concatenate(curve).points);
            const double gap =
                std::max(widest_gap(original, 6), widest_gap(a->bezier, 6));
            EXPECT_LE(sampled_hausdorff(original, a->bezier, 6), a->max_error + gap);
            if (joining == Joining::kDyadic) continue;
            int tips = 0;
            for (std::size_t i = 0; i < a->count(); ++i) {
                const std::size_t next = (i + 1) % a->count();
                if (next == 0 && ends == Ends::kOpen) continue;
                EXPECT_TRUE(std::ranges::equal(a->bezier[4 * i + 3], a->bezier[4 * next]))
                    << i << ' ' << int(joining);
                if (std::ranges::equal(a->bezier[4 * next], curve.pieces[1][0])) ++tips;
            }
            EXPECT_EQ(tips, 1) << int(joining);
        }
    }
}

TEST(ApproximatePieces, OnePieceWithoutCornersIsTheCurve) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        const Points control = drawn_stroke({.level = 6, .ends = ends, .noise = 1});
        for (const Joining joining : kAll) {
            const auto pieces = approximate_pieces({ends, {}, {control}}, 2, joining);
            ASSERT_TRUE(pieces);
            const Approximation whole = approximated(control, ends, 2, joining, {});
            EXPECT_EQ(pieces->bezier, whole.bezier);
            EXPECT_EQ(pieces->bound, whole.bound);
            EXPECT_EQ(pieces->closed, whole.closed);
        }
    }
}

TEST(ApproximateErrors, OfPiecesAreThoseOfAny) {
    CorneredCurve curve = with_a_tip(Ends::kOpen);
    curve.pieces[1][3][0] = 1e200;
    for (const Joining joining : kAll) {
        const auto a = approximate_pieces(curve, 2, joining);
        ASSERT_FALSE(a);
        EXPECT_EQ(a.error().param, "points");
    }
}

TEST(ApproximateErrors, NameTheBadValue) {
    Points control = drawn_stroke({.level = 3});
    const auto error = [&control](double tolerance, double corner) {
        const std::array corners = {corner};
        const auto result =
            approximate(control, Ends::kOpen, tolerance, Joining::kG1, corners);
        return result ? Error{} : result.error();
    };
    for (const double bad :
         {0.0, -2.5, std::numeric_limits<double>::infinity(), std::nan("")}) {
        EXPECT_EQ(error(bad, 0.5).code, ErrorCode::kInvalidArgument) << bad;
        EXPECT_EQ(error(bad, 0.5).param, "tolerance") << bad;
    }
    EXPECT_NE(error(-2.5, 0.5).message.find("-2.5"), std::string::npos);
    for (const double bad : {-0.25, 1.5, std::nan("")}) {
        EXPECT_EQ(error(1, bad).param, "corners") << bad;
    }
    EXPECT_NE(error(1, 1.5).message.find("1.5"), std::string::npos);
    control[4][1] = 1e200;
    EXPECT_EQ(error(1, 0.5).param, "points");
    EXPECT_NE(error(1, 0.5).message.find("1e+200"), std::string::npos);
    control[4][1] = std::nan("");
    EXPECT_EQ(error(1, 0.5).code, ErrorCode::kInvalidArgument);
    const auto chain =
        approximate_chain(bezier_points(control, Ends::kOpen), Ends::kOpen, 1, {});
    ASSERT_FALSE(chain);
    EXPECT_EQ(chain.error().param, "points");
}

TEST(ApproximateErrors, ATinyToleranceIsNone) {
    const Points control = drawn_stroke({.level = 4});
    for (const Joining joining : kAll) {
        const auto a = approximate(
            control, Ends::kOpen, std::numeric_limits<double>::min(), joining, {});
        ASSERT_TRUE(a);
        EXPECT_EQ(a->max_error, 0);
        EXPECT_EQ(a->bound, 0);
        EXPECT_EQ(a->count(), 16U);
    }
}

}  // namespace
}  // namespace haarmony::curve
