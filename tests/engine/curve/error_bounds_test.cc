#include "engine/curve/error_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/curve/bspline.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

using Vector = std::array<double, 2>;

Vector difference(const Points& a, const Points& b, Ends ends, double u) {
    const std::vector<double> p = point_at(a, ends, u);
    const std::vector<double> q = point_at(b, ends, u);
    return {p[0] - q[0], p[1] - q[1]};
}

// (3.9) by the definition of Bezier points: the cubic that f^j - f^(j-1) is on segment i,
// interpolated at four parameters.
double delta_by_interpolation(const MultiresCurve& curve, int level, std::size_t i) {
    const Points fine = reconstruct(curve, level);
    const Points coarse = reconstruct(curve, level - 1);
    std::array<Vector, 4> at{};
    for (std::size_t k = 0; k < 4; ++k) {
        const double u = (double(i) + double(k) / 3) / double(segment_count(level));
        at[k] = difference(fine, coarse, curve.ends, std::min(u, 1.0));
    }
    double longest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        Vector p{};
        for (std::size_t d = 0; d < 2; ++d) {
            const double all[4] = {
                at[0][d],
                (-5 * at[0][d] + 18 * at[1][d] - 9 * at[2][d] + 2 * at[3][d]) / 6,
                (2 * at[0][d] - 9 * at[1][d] + 18 * at[2][d] - 5 * at[3][d]) / 6,
                at[3][d]};
            p[d] = all[k];
        }
        longest = std::max(longest, std::hypot(p[0], p[1]));
    }
    return longest;
}

// Figure 3.12, without remembering anything.
double err_bound(const MultiresCurve& curve, int level, std::size_t i) {
    if (level == curve.level()) return 0;
    double largest = 0;
    for (const std::size_t child : {2 * i, 2 * i + 1}) {
        largest = std::max(largest,
                           err_bound(curve, level + 1, child) +
                               delta_by_interpolation(curve, level + 1, child));
    }
    return largest;
}

class ErrorBounds : public testing::TestWithParam<Ends> {};

TEST_P(ErrorBounds, AreThoseOfTheRecursion) {
    for (int level = 1; level <= 5; ++level) {
        const MultiresCurve curve = decompose(
            drawn_stroke({.level = level, .ends = GetParam(), .noise = 20}), GetParam());
        const std::vector<SegmentLevel> levels = error_bounds(curve);
        ASSERT_EQ(levels.size(), std::size_t(level) + 1);
        for (int j = 0; j <= level; ++j) {
            for (std::size_t i = 0; i < segment_count(j); ++i) {
                EXPECT_NEAR(levels[std::size_t(j)].bound[i], err_bound(curve, j, i), 1e-8)
                    << level << ' ' << j << ' ' << i;
                if (j == 0) continue;
                EXPECT_NEAR(levels[std::size_t(j)].delta[i],
                            delta_by_interpolation(curve, j, i),
                            1e-8)
                    << level << ' ' << j << ' ' << i;
            }
        }
    }
}

TEST_P(ErrorBounds, AreNeverBelowTheDistanceAtEqualParameters) {
    const MultiresCurve curve = decompose(
        drawn_stroke({.level = 6, .ends = GetParam(), .noise = 10}), GetParam());
    const std::vector<SegmentLevel> levels = error_bounds(curve);
    const Points full = reconstruct(curve);
    for (int j = 0; j < curve.level(); ++j) {
        const Points coarse = reconstruct(curve, j);
        for (int k = 0; k <= 1000; ++k) {
            const double u = k / 1000.0;
            const auto i =
                std::min(std::size_t(u * double(segment_count(j))), segment_count(j) - 1);
            const Vector d = difference(full, coarse, curve.ends, u);
            EXPECT_LE(std::hypot(d[0], d[1]), levels[std::size_t(j)].bound[i] + 1e-9)
                << j << ' ' << u;
        }
    }
}

TEST_P(ErrorBounds, DoNotLookBeyondXAndY) {
    const Points flat = drawn_stroke({.level = 5, .ends = GetParam(), .dimension = 2});
    const Points thick = drawn_stroke({.level = 5, .ends = GetParam(), .dimension = 5});
    const auto a = error_bounds(decompose(flat, GetParam()));
    const auto b = error_bounds(decompose(thick, GetParam()));
    for (std::size_t j = 0; j < a.size(); ++j) {
        for (std::size_t i = 0; i < a[j].bound.size(); ++i) {
            EXPECT_NEAR(a[j].bound[i], b[j].bound[i], 1e-9) << j << ' ' << i;
        }
    }
}

TEST_P(ErrorBounds, OfTheFinestLevelAreZero) {
    const auto levels = error_bounds(
        decompose(drawn_stroke({.level = 4, .ends = GetParam()}), GetParam()));
    EXPECT_EQ(levels.back().bound, std::vector<double>(16, 0.0));
    EXPECT_EQ(levels.front().delta, std::vector<double>(1, 0.0));
}

INSTANTIATE_TEST_SUITE_P(Both,
                         ErrorBounds,
                         testing::Values(Ends::kOpen, Ends::kClosed),
                         [](const auto& ends) {
                             return ends.param == Ends::kOpen ? "Open" : "Closed";
                         });

}  // namespace
}  // namespace haarmony::curve
