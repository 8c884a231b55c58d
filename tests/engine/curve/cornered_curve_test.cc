#include "engine/curve/cornered_curve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "engine/curve/bspline.h"
#include "engine/curve/multires_curve.h"
#include "engine/curve/path_samples.h"
#include "engine/curve/svg_path.h"

namespace haarmony::curve {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pointwise;

// Three waves that meet in two corners, x, y and thickness.
Points waves(std::size_t per_wave) {
    Points points(3 * per_wave + 1, 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double x = double(i) / double(per_wave);
        const double within = x - std::min(2.0, std::floor(x));
        points[i][0] = 100 * x;
        points[i][1] = 60 * std::sin(3.14159265 * within);
        points[i][2] = 2 + x;
    }
    return points;
}

CorneredFit fitted_waves() {
    const std::vector<std::size_t> corners = {200, 400};
    return fit_cornered(waves(200), corners, {.level = {}, .tolerance = 0.01}, {});
}

// A square with rounded sides, begun in the middle of one: 4 corners.
CorneredFit fitted_square() {
    Points points(400, 2);
    for (std::size_t i = 0; i < 400; ++i) {
        const std::size_t k = (i + 50) % 400;
        const double t = double(k % 100) / 100;
        const std::array<std::array<double, 2>, 5> corner = {
            {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}}};
        const auto& a = corner[k / 100];
        const auto& b = corner[k / 100 + 1];
        const double bulge = t * (1 - t);
        points[i][0] = a[0] + t * (b[0] - a[0]) + bulge * (b[1] - a[1]);
        points[i][1] = a[1] + t * (b[1] - a[1]) - bulge * (b[0] - a[0]);
    }
    const std::vector<std::size_t> corners = {50, 150, 250, 350};
    FitOptions options;
    options.ends = Ends::kClosed;
    return fit_cornered(points, corners, {.level = {}, .tolerance = 0.001}, options);
}

void expect_joined(const CorneredCurve& curve) {
    const std::size_t count = curve.pieces.size();
    for (std::size_t i = 0; i + (curve.ends == Ends::kOpen ? 1 : 0) < count; ++i) {
        const Points& piece = curve.pieces[i];
        const Points& next = curve.pieces[(i + 1) % count];
        EXPECT_TRUE(std::ranges::equal(piece[piece.size() - 1], next[0]))
            << "after " << i;
    }
}

TEST(CorneredCurve, FollowsTheStrokeAndKeepsItsCornersExactly) {
    const Points samples = waves(200);
    const CorneredFit found = fitted_waves();
    ASSERT_EQ(found.curve.pieces.size(), 3U);
    EXPECT_LE(found.max_error, 0.01);
    EXPECT_GT(found.rms_error, 0);
    EXPECT_LE(found.rms_error, found.max_error);
    expect_joined(found.curve);
    EXPECT_TRUE(std::ranges::equal(found.curve.pieces[1][0], samples[200]));
    EXPECT_TRUE(std::ranges::equal(found.curve.pieces[2][0], samples[400]));
    // As one curve the same takes more levels than a piece has.
    const CurveFit whole = fit_within(samples, 0.01, {});
    for (const Points& piece : found.curve.pieces)
        EXPECT_LT(4 * piece.size(), whole.control.size());
}

TEST(CorneredCurve, MayHaveAGivenLevel) {
    const std::vector<std::size_t> corners = {200};
    const CorneredFit found =
        fit_cornered(waves(200), corners, {.level = 3, .tolerance = 0}, {});
    for (const Points& piece : found.curve.pieces)
        EXPECT_EQ(piece.size(), control_count(3, Ends::kOpen));
}

TEST(CorneredCurve, WithoutCornersIsTheFitOfTheStroke) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        FitOptions options;
        options.ends = ends;
        const CorneredFit found =
            fit_cornered(waves(50), {}, {.level = 4, .tolerance = 0}, options);
        const CurveFit whole = fit(waves(50), 4, options);
        ASSERT_EQ(found.curve.pieces.size(), 1U);
        EXPECT_EQ(found.curve.pieces[0], whole.control);
        EXPECT_EQ(found.curve.piece_ends(), ends);
        EXPECT_NEAR(found.rms_error, whole.rms_error, 1e-12);
        EXPECT_EQ(point_at(found.curve, 0.3), point_at(whole.control, ends, 0.3));
        EXPECT_EQ(concatenate(found.curve).points, bezier_points(whole.control, ends));
    }
}

TEST(CorneredCurve, PiecesCoverTheirPartsOfU) {
    const CorneredCurve curve = fitted_waves().curve;
    EXPECT_EQ(range_of(curve, 0).from, 0);
    EXPECT_EQ(range_of(curve, 1).from, curve.corners[0]);
    EXPECT_EQ(range_of(curve, 1).to, curve.corners[1]);
    EXPECT_EQ(range_of(curve, 2).to, 1);
    EXPECT_EQ(piece_at(curve, curve.corners[0]).piece, 1U);
    EXPECT_EQ(piece_at(curve, curve.corners[0]).u, 0);
    EXPECT_EQ(piece_at(curve, 1).piece, 2U);
    EXPECT_EQ(piece_at(curve, 1).u, 1);

    const CorneredCurve square = fitted_square().curve;
    EXPECT_EQ(piece_at(square, 0).piece, 3U);
    EXPECT_NEAR(piece_at(square, 0).u, 0.5, 1e-3);
    EXPECT_NEAR(range_of(square, 3).to, square.corners[0] + 1, 1e-15);
}

TEST(CorneredCurve, OfAClosedStrokeIsClosed) {
    const CorneredFit square = fitted_square();
    ASSERT_EQ(square.curve.pieces.size(), 4U);
    expect_joined(square.curve);
    EXPECT_LE(square.max_error, 0.001);
    const std::vector<double> start = point_at(square.curve, 0);
    const std::vector<double> end = point_at(square.curve, 1);
    EXPECT_NEAR(start[0], end[0], 1e-9);
    EXPECT_NEAR(start[0], 5, 0.01);
    EXPECT_NEAR(start[1], -2.5, 0.01);
}

TEST(CorneredCurve, DeclaredCornersAreTheNearestSamples) {
    const std::vector<double> at = {0, 0.1, 0.2, 0.5, 0.9, 1};
    const auto found =
        [&](std::size_t count, Ends ends, const std::vector<double>& corners) {
            return samples_at_corners(std::span(at).first(count), ends, corners).value();
        };
    EXPECT_THAT(found(6, Ends::kOpen, {0.14, 0.36, 0.8}), ElementsAre(1, 3, 4));
    EXPECT_THAT(found(6, Ends::kClosed, {0, 0.8}), ElementsAre(0, 4));
    // Nearest to the start, which is at 1 as well, repeated or not.
    EXPECT_THAT(found(5, Ends::kClosed, {0.5, 0.97}), ElementsAre(0, 3));
    EXPECT_THAT(found(6, Ends::kClosed, {0.5, 0.97}), ElementsAre(0, 3));
}

TEST(CorneredCurve, CornersThatCannotBeAreRefusedByTheirValue) {
    const std::vector<double> at = {0, 0.1, 0.2, 0.5, 0.9, 1};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refusal = [&](Ends ends, const std::vector<double>& corners) {
        const auto result = samples_at_corners(at, ends, corners);
        EXPECT_FALSE(result.has_value());
        EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(result.error().param, "corners");
        return result.error().message;
    };
    EXPECT_THAT(refusal(Ends::kOpen, {0}), HasSubstr("corner 0 is not between 0 and 1"));
    EXPECT_THAT(refusal(Ends::kOpen, {0.5, 1}), HasSubstr("corner 1 is not between"));
    EXPECT_THAT(refusal(Ends::kOpen, {nan}), HasSubstr("nan is not between"));
    EXPECT_THAT(refusal(Ends::kClosed, {-0.5}),
                HasSubstr("corner -0.5 is not in [0, 1)"));
    EXPECT_THAT(refusal(Ends::kClosed, {1}), HasSubstr("corner 1 is not in"));
    EXPECT_THAT(refusal(Ends::kOpen, {0.5, 0.5}),
                HasSubstr("corner 0.5 is not greater than the one before"));
    EXPECT_THAT(refusal(Ends::kOpen, {0.5, 0.25}),
                HasSubstr("corner 0.25 is not greater"));
    EXPECT_THAT(refusal(Ends::kOpen, {0.03125}),
                HasSubstr("no sample between it and an end"));
    EXPECT_THAT(refusal(Ends::kOpen, {0.984375}), HasSubstr("between it and an end"));
    EXPECT_THAT(refusal(Ends::kOpen, {0.4375, 0.5625}),
                HasSubstr("corner 0.5625 has no sample between it and the one before"));
    EXPECT_THAT(refusal(Ends::kClosed, {0, 0.96875}),
                HasSubstr("corner 0.96875 has no sample between it and the first one"));
    const auto split = split_at_corners(
        Points(control_count(3, Ends::kOpen), 2), Ends::kOpen, std::vector<double>{2}, 1);
    ASSERT_FALSE(split.has_value());
    EXPECT_THAT(split.error().message, HasSubstr("corner 2 is not between 0 and 1"));
}

Points random_control(int level, Ends ends, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-10, 10);
    Points control(control_count(level, ends), 3);
    for (double& number : control.numbers()) number = unit(random);
    return control;
}

TEST(CorneredCurve, ASplitAtHalvesIsExact) {
    for (const Ends ends : {Ends::kOpen, Ends::kClosed}) {
        const Points control = random_control(5, ends, 1);
        const std::vector<double> corners = {0.25, 0.5};
        // Pieces of an open curve are quarters and a half; the second one of a closed curve
        // has three quarters and is no curve of a level.
        const double tolerance = ends == Ends::kOpen ? 1e-9 : 1e-3;
        const CorneredFit split =
            split_at_corners(control, ends, corners, tolerance).value();
        expect_joined(split.curve);
        EXPECT_LE(split.max_error, tolerance);
        if (ends == Ends::kOpen) {
            EXPECT_EQ(split.curve.pieces[0].size(), control_count(3, Ends::kOpen));
            EXPECT_EQ(split.curve.pieces[2].size(), control_count(4, Ends::kOpen));
        }
        for (double u = 0; u <= 1; u += 1.0 / 257) {
            EXPECT_THAT(point_at(split.curve, u),
                        Pointwise(DoubleNear(ends == Ends::kOpen ? 1e-9 : 5e-3),
                                  point_at(control, ends, u)))
                << u;
        }
    }
}

TEST(CorneredCurve, ASplitWithoutCornersIsTheCurve) {
    const Points control = random_control(3, Ends::kClosed, 2);
    const CorneredFit split = split_at_corners(control, Ends::kClosed, {}, 1).value();
    EXPECT_EQ(split.curve.pieces, std::vector<Points>{control});
    EXPECT_EQ(split.max_error, 0);
}

TEST(CorneredCurve, SmoothingKeepsItsCorners) {
    const CorneredCurve curve = fitted_waves().curve;
    for (const double level : {0.0, 1.0, 1.4}) {
        const CorneredCurve smoothed = smooth(curve, level);
        expect_joined(smoothed);
        for (std::size_t i = 0; i < 3; ++i) {
            const Points& piece = curve.pieces[i];
            const Points& after = smoothed.pieces[i];
            EXPECT_EQ(after.size(), control_count(int(std::ceil(level)), Ends::kOpen));
            EXPECT_TRUE(std::ranges::equal(after[0], piece[0]));
            EXPECT_TRUE(
                std::ranges::equal(after[after.size() - 1], piece[piece.size() - 1]));
        }
    }
    EXPECT_EQ(smooth(curve, 12).pieces, curve.pieces);
}

TEST(CorneredCurve, SmoothingIsThatOfThePiecesInside) {
    // Equation (3.1) written out; only the first and last control point differ.
    CorneredCurve curve;
    curve.corners = {0.5};
    curve.pieces = {random_control(5, Ends::kOpen, 3), random_control(4, Ends::kOpen, 4)};
    const CorneredCurve smoothed = smooth(curve, 2.25);
    const MultiresCurve multires = decompose(curve.pieces[0], Ends::kOpen);
    const Points low = synthesize(reconstruct(multires, 2), {}, Ends::kOpen);
    const Points high = reconstruct(multires, 3);
    for (std::size_t i = 1; i + 1 < low.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(smoothed.pieces[0][i][axis],
                        0.75 * low[i][axis] + 0.25 * high[i][axis],
                        1e-12);
        }
    }
    // Without corners a closed curve has no end to keep.
    CorneredCurve closed;
    closed.ends = Ends::kClosed;
    closed.pieces = {random_control(5, Ends::kClosed, 5)};
    EXPECT_EQ(smooth(closed, 3).pieces[0],
              reconstruct(decompose(closed.pieces[0], Ends::kClosed), 3));
}

TEST(CorneredCurve, AnEditOfAnEndMovesTheNeighbourAlong) {
    const CorneredCurve curve = fitted_waves().curve;
    const std::vector<double> delta = {3, -4, 0.5};
    const std::size_t last = control_count(1, Ends::kOpen) - 1;
    const CorneredCurve edited =
        edit_piece(curve, 0, {.level = 1, .index = last, .delta = delta}).value();
    expect_joined(edited);
    const Points& before = curve.pieces[1];
    const Points& after = edited.pieces[1];
    for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(after[0][axis] - before[0][axis], delta[axis], 1e-12);
    // As broadly as level 1 is: the neighbour's first control point of level 1 moved, alone.
    const MultiresCurve was = decompose(before, Ends::kOpen);
    const MultiresCurve is = decompose(after, Ends::kOpen);
    EXPECT_NEAR(reconstruct(is, 1)[0][1] - reconstruct(was, 1)[0][1], -4, 1e-9);
    for (std::size_t i = 1; i < 5; ++i)
        EXPECT_NEAR(reconstruct(is, 1)[i][1], reconstruct(was, 1)[i][1], 1e-9) << i;
    // What is beyond the neighbour stays.
    EXPECT_EQ(edited.pieces[2], curve.pieces[2]);
}

TEST(CorneredCurve, AnEditInsideMovesNoNeighbour) {
    const CorneredCurve curve = fitted_waves().curve;
    const std::vector<double> delta = {3, -4, 0.5};
    const CorneredCurve edited =
        edit_piece(curve, 1, {.level = 1, .index = 2, .delta = delta}).value();
    EXPECT_EQ(edited.pieces[0], curve.pieces[0]);
    EXPECT_EQ(edited.pieces[2], curve.pieces[2]);
    EXPECT_NE(edited.pieces[1], curve.pieces[1]);
}

TEST(CorneredCurve, TheEndsOfAnOpenCurveAreNotShared) {
    const CorneredCurve curve = fitted_waves().curve;
    const std::vector<double> delta = {1, 1, 1};
    const CorneredCurve edited =
        edit_piece(curve, 0, {.level = 0, .index = 0, .delta = delta}).value();
    EXPECT_EQ(edited.pieces[1], curve.pieces[1]);
    EXPECT_EQ(edited.pieces[2], curve.pieces[2]);
}

TEST(CorneredCurve, AroundAClosedCurveTheLastMeetsTheFirst) {
    const CorneredCurve curve = fitted_square().curve;
    const std::vector<double> delta = {1, 2};
    const CorneredCurve edited =
        edit_piece(curve, 0, {.level = 0, .index = 0, .delta = delta}).value();
    expect_joined(edited);
    EXPECT_EQ(edited.pieces[1], curve.pieces[1]);
    EXPECT_NE(edited.pieces[3], curve.pieces[3]);
}

TEST(CorneredCurve, OfOneCornerIsItsOwnNeighbour) {
    // A drop: closed, one corner.
    Points points(200, 2);
    for (std::size_t i = 0; i < 200; ++i) {
        const double a = 3.14159265358979 * double(i) / 200;
        points[i][0] = 10 * std::sin(a) * std::cos(a);
        points[i][1] = 10 * std::sin(a);
    }
    FitOptions options;
    options.ends = Ends::kClosed;
    const std::vector<std::size_t> corners = {0};
    const CorneredCurve curve =
        fit_cornered(points, corners, {.level = {}, .tolerance = 0.01}, options).curve;
    ASSERT_EQ(curve.pieces.size(), 1U);
    expect_joined(curve);
    const std::vector<double> delta = {1, 2};
    for (const std::size_t index : {std::size_t{0}, control_count(0, Ends::kOpen) - 1}) {
        const CorneredCurve edited =
            edit_piece(curve, 0, {.level = 0, .index = index, .delta = delta}).value();
        expect_joined(edited);
        EXPECT_NEAR(edited.pieces[0][0][0] - curve.pieces[0][0][0], 1, 1e-12);
        EXPECT_NEAR(edited.pieces[0][0][1] - curve.pieces[0][0][1], 2, 1e-12);
    }
}

TEST(CorneredCurve, AStartThatIsRepeatedIsOneCorner) {
    Points square(5, 2);
    const double corner[5][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
    for (std::size_t i = 0; i < 5; ++i) std::ranges::copy(corner[i], square[i].begin());
    FitOptions options;
    options.ends = Ends::kClosed;
    const PieceGoal goal{.level = {}, .tolerance = 1e-9};
    const std::vector<std::size_t> repeated = {0, 1, 2, 3, 4};
    const std::vector<std::size_t> once = {0, 1, 2, 3};
    const CorneredFit found = fit_cornered(square, repeated, goal, options);
    EXPECT_EQ(found.curve.corners, (std::vector<double>{0, 0.25, 0.5, 0.75}));
    Points four(4, 2);
    std::ranges::copy(square.numbers().first(8), four.numbers().begin());
    EXPECT_EQ(found.curve.pieces, fit_cornered(four, once, goal, options).curve.pieces);
    expect_joined(found.curve);
}

TEST(CorneredCurve, OfPathDataHasTheCornersOfThePath) {
    // A box with one round side.
    const SvgSubpath path =
        parse_svg_path("M0 0H80A30 30 0 0 1 80 60H0Z").value().front();
    const PathSamples samples = sample_path(path, 0.01).value();
    FitOptions options;
    options.ends = Ends::kClosed;
    const CorneredFit found = fit_cornered(
        samples.points, samples.corners, {.level = {}, .tolerance = 0.02}, options);
    // Where the arc begins and ends the direction goes straight on.
    ASSERT_EQ(found.curve.pieces.size(), 2U);
    EXPECT_TRUE(std::ranges::equal(found.curve.pieces[0][0], std::array{0.0, 0.0}));
    EXPECT_TRUE(std::ranges::equal(found.curve.pieces[1][0], std::array{0.0, 60.0}));
    EXPECT_EQ(found.curve.pieces[1].size(), control_count(0, Ends::kOpen));
    EXPECT_LE(found.max_error, 0.02);
    expect_joined(found.curve);
}

TEST(CorneredCurve, AnEditThatThePieceRefusesIsRefused) {
    const CorneredCurve curve = fitted_waves().curve;
    const std::vector<double> delta = {1, 1, 1};
    const auto result = edit_piece(curve, 0, {.level = 99, .index = 0, .delta = delta});
    ASSERT_FALSE(result.has_value());
    EXPECT_THAT(result.error().message, HasSubstr("99"));
}

TEST(CorneredCurve, ConcatenatedBeziersArePointsOfTheWhole) {
    for (const CorneredCurve& curve : {fitted_waves().curve, fitted_square().curve}) {
        const ConcatenatedBeziers all = concatenate(curve);
        ASSERT_EQ(all.points.size(), 3 * (all.parameters.size() - 1) + 1);
        EXPECT_TRUE(std::ranges::is_sorted(all.parameters));
        for (std::size_t i = 0; i < all.parameters.size(); ++i) {
            const double u = all.parameters[i];
            const std::vector<double> on = point_at(curve, u > 1 ? u - 1 : u);
            for (std::size_t axis = 0; axis < on.size(); ++axis)
                EXPECT_NEAR(all.points[3 * i][axis], on[axis], 1e-9) << i;
        }
    }
}

TEST(CorneredCurve, AsOneCurveItsCornersAreRoundedWithinTheTolerance) {
    for (const CorneredCurve& curve : {fitted_waves().curve, fitted_square().curve}) {
        const CurveFit one = without_corners(curve, 0.3);
        EXPECT_LE(one.max_error, 0.3);
        for (double u = 0; u <= 1; u += 1.0 / 97) {
            const std::vector<double> a = point_at(curve, u);
            const std::vector<double> b = point_at(one.control, curve.ends, u);
            EXPECT_LE(std::hypot(a[0] - b[0], a[1] - b[1]), 0.6) << u;
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
