#include "engine/curve/parametric_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

// By `samples` points of each piece of the curve.
double sampled(const Points& curve, int level, const DrawnSegments& drawn, int samples) {
    double largest = 0;
    for (std::size_t i = 0; i < drawn.names.size(); ++i) {
        const SegmentName s = drawn.names[i];
        const std::size_t count = segment_count(level) / segment_count(s.level);
        for (std::size_t piece = 0; piece < count; ++piece) {
            for (int k = 0; k <= samples; ++k) {
                const double t = double(k) / samples;
                const auto p = bernstein_sum(curve, 3 * (s.index * count + piece), t);
                const auto q = bernstein_sum(
                    drawn.bezier, 4 * i, (double(piece) + t) / double(count));
                largest = std::max(largest, std::hypot(p[0] - q[0], p[1] - q[1]));
            }
        }
    }
    return largest;
}

TEST(ParametricError, IsTheLimitOfEverDenserSamples) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Points control = drawn_stroke({.level = 6, .noise = 3, .seed = seed});
        const auto levels = error_bounds(decompose(control, Ends::kOpen));
        for (const double tolerance : {3.0, 10.0, 40.0}) {
            const DrawnSegments drawn = draw_segments(levels, tolerance, {});
            const double exact = parametric_error(levels.back().bezier, 6, drawn);
            const double seen = sampled(levels.back().bezier, 6, drawn, 64);
            EXPECT_GE(exact, seen * (1 - 1e-12)) << seed << ' ' << tolerance;
            EXPECT_NEAR(exact, seen, 1e-3 * exact) << seed << ' ' << tolerance;
        }
    }
}

// x = 27/4 t^2 (1 - t) has its maximum 1 at t = 2/3, between all points that halving sees.
TEST(ParametricError, FindsAMaximumWithinAPiece) {
    Points curve(4, 2);
    DrawnSegments drawn{{{0, 0}}, Points(4, 2), 0};
    drawn.bezier[2][0] = 9.0 / 4;
    EXPECT_NEAR(parametric_error(curve, 0, drawn), 1, 1e-12);
}

TEST(ParametricError, OfTheCurveItselfIsExactlyZero) {
    const auto levels = error_bounds(decompose(drawn_stroke({.level = 5}), Ends::kOpen));
    EXPECT_EQ(parametric_error(levels.back().bezier, 5, draw_segments(levels, 1e-9, {})),
              0);
}

TEST(ParametricError, DoesNotLookBeyondXAndY) {
    Points curve(4, 3);
    DrawnSegments drawn{{{0, 0}}, Points(4, 3), 0};
    drawn.bezier[0][2] = 100;
    drawn.bezier[3][0] = 3;
    drawn.bezier[3][1] = 4;
    EXPECT_EQ(parametric_error(curve, 0, drawn), 5);
}

}  // namespace
}  // namespace haarmony::curve
