#include "engine/curve/sweep_edit.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr std::array kFrames = {Frame::kFixed, Frame::kNormalized, Frame::kUnnormalized};
constexpr std::array kEnds = {Ends::kOpen, Ends::kClosed};
constexpr std::array<double, 2> kDelta = {60, -25};

Points unit(int level, Ends ends, std::size_t index, std::span<const double> delta) {
    Points points(dense::points_of(level, ends), int(delta.size()));
    std::ranges::copy(delta, points[index].begin());
    return points;
}

// Equation (3.4), with the projection instead of A, and the remainder instead of Q B.
struct DenseChange {
    Points coarse;     // delta C^j
    Points remainder;  // Q delta D^j, of level j + 1
};

DenseChange dense_change(double level, Ends ends, std::size_t index) {
    const int j = int(std::floor(level));
    const double t = level - j;
    if (t == 0) return {unit(j, ends, index, kDelta), {}};
    const Points narrow = unit(j + 1, ends, index, kDelta);
    // The row of P by refining every coarse point alone.
    std::vector<double> row;
    for (std::size_t k = 0; k < dense::points_of(j, ends); ++k) {
        const std::array<double, 1> one = {1};
        row.push_back(dense::refine(unit(j, ends, k, one), ends, j + 1)[index][0]);
    }
    const double most = *std::ranges::max_element(row);
    Points broad(row.size(), 2);
    double sharers = 0;
    for (const double weight : row) sharers += std::abs(weight - most) < 1e-9 ? 1 : 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
        if (std::abs(row[k] - most) > 1e-9) continue;
        broad[k][0] = kDelta[0] / (sharers * most);
        broad[k][1] = kDelta[1] / (sharers * most);
    }
    const double g = t * t;
    const Points projected = dense::project(narrow, ends, j);
    const Points zero(broad.size(), 2);
    const Points none(narrow.size(), 2);
    return {
        dense::sum(dense::sum(zero, 1 - g, broad), g, projected),
        dense::sum(
            none, g / t, dense::sum(narrow, -1, dense::refine(projected, ends, j + 1)))};
}

// Control points of f^level.
Points dense_smooth(const Points& control, Ends ends, double level) {
    const int j = int(std::floor(level));
    const double t = level - j;
    const Points coarse = dense::project(control, ends, j);
    if (t == 0) return coarse;
    const Points broad = dense::refine(coarse, ends, j + 1);
    const Points narrow = dense::project(control, ends, j + 1);
    return dense::sum(broad, t, dense::sum(narrow, -1, broad));
}

TEST(SweepEdit, InThePagesAxesAgreesWithFullMatrices) {
    constexpr int kLevel = 3;
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(kLevel, ends, 2, 1);
        const MultiresCurve curve = decompose(control, ends);
        for (const double level : {0.0, 0.3, 1.0, 1.5, 2.0, 2.25, 2.9, 3.0}) {
            const int fine = int(std::ceil(level));
            for (std::size_t i = 0; i < control_count(fine, ends); ++i) {
                const DenseChange change = dense_change(level, ends, i);
                Points added = dense::refine(change.coarse, ends, kLevel);
                if (!change.remainder.empty()) {
                    added = dense::sum(
                        added, 1, dense::refine(change.remainder, ends, kLevel));
                }
                const auto edited = edit_sweep(curve, {level, i, kDelta, Frame::kFixed});
                ASSERT_TRUE(edited) << edited.error().message;
                EXPECT_LT(dense::distance(edited->control, dense::sum(control, 1, added)),
                          1e-8)
                    << int(ends) << " level " << level << " index " << i;
            }
        }
    }
}

// The definition of section 3.4.3, wavelet by wavelet.
Points dense_turning_edit(const Points& control,
                          double level,
                          std::size_t index,
                          Frame f) {
    int n = 0;
    while (dense::points_of(n, Ends::kOpen) != control.size()) ++n;
    const int j = int(std::floor(level));
    const DenseChange change = dense_change(level, Ends::kOpen, index);
    Points after = dense::sum(dense::project(control, Ends::kOpen, j), 1, change.coarse);
    for (int k = j; k < n; ++k) {
        const Points before = dense::project(control, Ends::kOpen, k);
        const Points finer = dense::project(control, Ends::kOpen, k + 1);
        Points next = dense::refine(after, Ends::kOpen, k + 1);
        if (k == j && !change.remainder.empty()) {
            next = dense::sum(next, 1, change.remainder);
        }
        const Points remainder =
            dense::sum(finer, -1, dense::refine(before, Ends::kOpen, k + 1));
        // The detail of each wavelet: inner products do not separate them, solving does.
        const std::size_t rows = std::size_t{1} << k;
        std::vector<Points> wavelets;
        for (std::size_t row = 0; row < rows; ++row) {
            wavelets.push_back(dense::wavelet(k, row));
        }
        const Points details = dense::combination(remainder, wavelets);
        for (std::size_t row = 0; row < rows; ++row) {
            const double u = k == 0 ? 0.5 : dense::peak(wavelets[row], Ends::kOpen);
            const std::vector<double> from = dense::slope(before, Ends::kOpen, u);
            const std::vector<double> to = dense::slope(after, Ends::kOpen, u);
            // Complex numbers turn and scale: d * to / from.
            std::complex<double> turn(to[0], to[1]);
            turn /= std::complex<double>(from[0], from[1]);
            if (f == Frame::kNormalized) turn /= std::abs(turn);
            const std::complex<double> detail =
                turn * std::complex<double>(details[row][0], details[row][1]);
            for (std::size_t i = 0; i < next.size(); ++i) {
                next[i][0] += detail.real() * wavelets[row][i][0];
                next[i][1] += detail.imag() * wavelets[row][i][0];
            }
        }
        after = next;
    }
    return after;
}

TEST(SweepEdit, WithTurningDetailsAgreesWithTheDefinition) {
    const Points control = dense::random_curve(3, Ends::kOpen, 2, 2);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const Frame frame : {Frame::kNormalized, Frame::kUnnormalized}) {
        for (const auto& [level, index] :
             {std::pair(0.0, 1), {0.5, 2}, {1.0, 4}, {1.6, 3}}) {
            const auto edited =
                edit_sweep(curve, {level, std::size_t(index), kDelta, frame});
            ASSERT_TRUE(edited);
            // Peaks and wavelets of the slow method are good to 1e-6.
            EXPECT_LT(dense::distance(
                          edited->control,
                          dense_turning_edit(control, level, std::size_t(index), frame)),
                      2e-3)
                << int(frame) << " level " << level;
        }
    }
}

TEST(SweepEdit, MovesTheControlPointOfTheSmoothedCurve) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(4, ends, 2, 3);
        const MultiresCurve curve = decompose(control, ends);
        for (const Frame frame : kFrames) {
            for (const double level : {1.0, 1.4, 2.0, 2.7, 3.5, 4.0}) {
                const std::size_t index = 1;
                const auto edited = edit_sweep(curve, {level, index, kDelta, frame});
                ASSERT_TRUE(edited);
                const Points before = dense_smooth(control, ends, level);
                const Points after = dense_smooth(edited->control, ends, level);
                for (std::size_t d = 0; d < 2; ++d) {
                    EXPECT_NEAR(
                        edited->moved[d], after[index][d] - before[index][d], 1e-8)
                        << int(ends) << int(frame) << " level " << level;
                    if (frame == Frame::kFixed) {
                        EXPECT_NEAR(edited->moved[d], kDelta[d], 1e-12);
                    }
                }
            }
        }
    }
}

// In the page's axes: elsewhere D^j turns with f^j below level j + 1, and not at it.
TEST(SweepEdit, NarrowsContinuouslyFromLevelToLevel) {
    const Points control = dense::random_curve(4, Ends::kOpen, 2, 4);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    constexpr double kStep = 1e-7;
    for (const int level : {1, 2, 3}) {
        // From below the point keeps its index and only the breadth changes.
        const auto below = edit_sweep(curve, {level - kStep, 3, kDelta, Frame::kFixed});
        const auto at = edit_sweep(curve, {double(level), 3, kDelta, Frame::kFixed});
        ASSERT_TRUE(below && at);
        EXPECT_LT(dense::distance(below->control, at->control), 1e-3) << level;
    }
    // From above, point 5 of level 3 goes with point 3 of level 2, 12/16 of whose way it goes.
    const std::array<double, 2> longer = {kDelta[0] * 16 / 12, kDelta[1] * 16 / 12};
    const auto above = edit_sweep(curve, {2 + kStep, 5, kDelta, Frame::kFixed});
    const auto at = edit_sweep(curve, {2, 3, longer, Frame::kFixed});
    ASSERT_TRUE(above && at);
    EXPECT_LT(dense::distance(above->control, at->control), 1e-3);
}

TEST(SweepEdit, AtTheFinestLevelMovesOnePointAlone) {
    for (const Ends ends : kEnds) {
        const Points control = dense::random_curve(5, ends, 2, 5);
        const MultiresCurve curve = decompose(control, ends);
        for (const Frame frame : kFrames) {
            const auto edited = edit_sweep(curve, {5, 7, kDelta, frame});
            ASSERT_TRUE(edited);
            EXPECT_LT(dense::distance(edited->control,
                                      dense::sum(control, 1, unit(5, ends, 7, kDelta))),
                      1e-9);
        }
    }
}

TEST(SweepEdit, CarriesOtherDimensionsAlong) {
    const Points control = dense::random_curve(4, Ends::kOpen, 5, 6);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    const std::array<double, 5> thicker = {0, 0, 8, 0, -2};
    for (const Frame frame : kFrames) {
        const auto edited = edit_sweep(curve, {1.5, 2, thicker, frame});
        ASSERT_TRUE(edited);
        double third = 0;
        for (std::size_t i = 0; i < control.size(); ++i) {
            EXPECT_NEAR(edited->control[i][0], control[i][0], 1e-9);
            EXPECT_NEAR(edited->control[i][1], control[i][1], 1e-9);
            EXPECT_NEAR(edited->control[i][3], control[i][3], 1e-9);
            third = std::max(third, edited->control[i][2] - control[i][2]);
        }
        EXPECT_GT(third, 4);
        EXPECT_LT(edited->affected.from, edited->affected.to);
    }
}

// What moves by more than 1e-9 of the coordinates, by looking at every knot interval.
TEST(SweepEdit, AffectedIsTheSmallestIntervalThatMoves) {
    constexpr int kLevel = 5;
    const Points control = dense::random_curve(kLevel, Ends::kOpen, 2, 7);
    const MultiresCurve curve = decompose(control, Ends::kOpen);
    for (const Frame frame : kFrames) {
        for (const double level : {2.0, 3.0, 3.5, 4.0, 4.8, 5.0}) {
            const auto edited = edit_sweep(curve, {level, 5, kDelta, frame});
            ASSERT_TRUE(edited);
            const Points change = dense::sum(edited->control, -1, reconstruct(curve));
            const double limit = 1e-9 * std::max(coordinate_size(control),
                                                 coordinate_size(edited->control));
            const double segments = std::ldexp(1, int(std::ceil(level)));
            Interval expected;
            for (int segment = 0; segment < segments; ++segment) {
                double most = 0;
                for (int i = 0; i <= 64; ++i) {
                    const std::vector<double> move = dense::point(
                        change, Ends::kOpen, (segment + i / 64.0) / segments);
                    most = std::max(most, std::hypot(move[0], move[1]));
                }
                if (most <= limit) continue;
                if (expected == Interval{}) expected.from = segment / segments;
                expected.to = (segment + 1) / segments;
            }
            EXPECT_EQ(edited->affected, expected)
                << int(frame) << " level " << level << ": " << edited->affected.from
                << ".." << edited->affected.to;
        }
    }
}

TEST(SweepEdit, ByNothingAffectsNothing) {
    const MultiresCurve curve =
        decompose(dense::random_curve(4, Ends::kOpen, 2, 8), Ends::kOpen);
    const std::array<double, 2> still = {0, 0};
    for (const Frame frame : kFrames) {
        const auto edited = edit_sweep(curve, {1.5, 2, still, frame});
        ASSERT_TRUE(edited);
        EXPECT_EQ(edited->affected, Interval{});
    }
}

TEST(SweepEdit, ErrorsNameWhatIsWrong) {
    const MultiresCurve curve =
        decompose(dense::random_curve(3, Ends::kOpen, 2, 9), Ends::kOpen);
    const auto failure = [&](const ControlEdit& edit) {
        const auto edited = edit_sweep(curve, edit);
        EXPECT_FALSE(edited);
        EXPECT_EQ(edited.error().code, ErrorCode::kInvalidArgument);
        return edited.error();
    };
    for (const double level : {3.25, -0.5}) {
        const Error error = failure({level, 0, kDelta, Frame::kFixed});
        EXPECT_EQ(error.param, "level");
        EXPECT_EQ(error.message, "level " + std::to_string(level) + " is outside 0..3");
    }
    EXPECT_EQ(failure({std::nan(""), 0, kDelta, Frame::kFixed}).param, "level");
    EXPECT_EQ(failure({1, 5, kDelta, Frame::kFixed}).message,
              "index 5 of 5 control points");
    // Of a fractional level the index is one of the next level's.
    EXPECT_TRUE(edit_sweep(curve, {1.5, 6, kDelta, Frame::kFixed}));
    EXPECT_EQ(failure({1.5, 7, kDelta, Frame::kFixed}).param, "index");
    const std::array<double, 3> long_delta = {1, 2, 3};
    EXPECT_EQ(failure({1, 0, long_delta, Frame::kFixed}).message,
              "delta of 3 numbers for a curve of 2");
    const std::array<double, 2> endless = {1, std::numeric_limits<double>::infinity()};
    EXPECT_EQ(failure({1, 0, endless, Frame::kFixed}).message, "delta inf is not finite");
    EXPECT_EQ(failure({1, 0, endless, Frame::kFixed}).param, "delta");
    const std::array<double, 2> huge = {1e308, -1.7e308};
    EXPECT_EQ(failure({1.5, 3, huge, Frame::kFixed}).message,
              "delta -1.7e+308 takes the curve beyond the largest number");
}

}  // namespace
}  // namespace haarmony::curve
