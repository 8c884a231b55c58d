#include "engine/curve/hausdorff.h"

#include <gtest/gtest.h>

#include "engine/curve/bspline.h"
#include "engine/curve/merge.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

double measured(const Points& a, const Points& b, double usual) {
    return hausdorff(cubics_of(a), cubics_of(b), usual);
}

Points line(PlaneVector from, PlaneVector to) {
    Points rows(4, 2);
    for (std::size_t i = 0; i < 4; ++i) {
        const PlaneVector p = between(from, to, double(i) / 3);
        rows[i][0] = p.x;
        rows[i][1] = p.y;
    }
    return rows;
}

TEST(Hausdorff, OfParallelLinesIsTheirDistance) {
    EXPECT_NEAR(measured(line({0, 0}, {10, 0}), line({0, 3}, {10, 3}), 1), 3, 1e-12);
}

TEST(Hausdorff, CountsWhatOnlyOneOfThemHas) {
    const Points shorter = line({0, 0}, {10, 0});
    const Points longer = line({0, 0}, {17, 0});
    EXPECT_NEAR(measured(shorter, longer, 1), 7, 1e-12);
    EXPECT_NEAR(measured(longer, shorter, 1), 7, 1e-12);
}

// The peak of a hump whose middle control points are at 4 is at 3, between samples.
TEST(Hausdorff, FindsThePeakBetweenSamples) {
    Points hump = line({0, 0}, {61, 0});
    hump[1][1] = 4.1;
    hump[2][1] = 3.7;
    double peak = 0;
    for (int k = 0; k <= 100000; ++k) {
        peak = std::max(peak, bernstein_sum(hump, 0, k / 100000.0)[1]);
    }
    EXPECT_NEAR(measured(hump, line({0, 0}, {61, 0}), 1), peak, 1e-9);
}

TEST(Hausdorff, IsThatOfDenseSamples) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const Points bezier = bezier_points(
            drawn_stroke({.level = 5, .noise = 1.5, .seed = seed}), Ends::kOpen);
        const Points original = four_rows_each(bezier);
        for (const double tolerance : {1.0, 10.0}) {
            const Points fewer = merge(bezier, tolerance, {}).bezier;
            const double got = measured(original, fewer, tolerance);
            const std::size_t dense = 120;
            const double seen = sampled_hausdorff(original, fewer, dense);
            const double gap =
                std::max(widest_gap(original, dense), widest_gap(fewer, dense));
            EXPECT_NEAR(got, seen, gap) << seed << ' ' << tolerance;
        }
    }
}

TEST(Hausdorff, DoesNotDependOnWhatIsUsual) {
    const Points a =
        four_rows_each(bezier_points(drawn_stroke({.level = 5, .seed = 1}), Ends::kOpen));
    const Points b =
        four_rows_each(bezier_points(drawn_stroke({.level = 4, .seed = 2}), Ends::kOpen));
    const double want = measured(a, b, 0);
    EXPECT_NEAR(measured(a, b, 1), want, 1e-9);
    EXPECT_NEAR(measured(a, b, 1e9), want, 1e-9);
    EXPECT_NEAR(measured(b, a, 1), want, 1e-9);
}

TEST(Hausdorff, OfACurveAndItselfIsZero) {
    const Points a = four_rows_each(
        bezier_points(drawn_stroke({.level = 5, .noise = 5}), Ends::kOpen));
    EXPECT_EQ(measured(a, a, 1e-9), 0);
}

TEST(Hausdorff, OfPointsIsTheirDistance) {
    EXPECT_EQ(measured(line({0, 0}, {0, 0}), line({3, 4}, {3, 4}), 1), 5);
}

}  // namespace
}  // namespace haarmony::curve
