#include "engine/curve/run_bound.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/curve/bspline.h"
#include "engine/curve/cubic_fit.h"
#include "tests/engine/curve/drawn_strokes.h"

namespace haarmony::curve {
namespace {

Points run_of(const Points& bezier, std::size_t first, std::size_t last) {
    Points rows(3 * (last - first) + 1, bezier.dimension());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::ranges::copy(bezier[3 * first + i], rows[i].begin());
    }
    return four_rows_each(rows);
}

// A straight line along x in three pieces of uneven speed.
Points line() {
    Points rows(10, 2);
    const double x[] = {0, 1, 5, 6, 7, 20, 21, 30, 31, 60};
    for (std::size_t i = 0; i < 10; ++i) rows[i][0] = x[i];
    return rows;
}

TEST(RunBound, IsNeverBelowTheSampledDistance) {
    int proved = 0;
    for (std::uint32_t seed = 1; seed <= 6; ++seed) {
        const Points bezier = bezier_points(
            drawn_stroke({.level = 6, .noise = 0.8, .seed = seed}), Ends::kOpen);
        const Chain chain = make_chain(bezier);
        Cuts cuts;
        for (const double tolerance : {0.5, 2.0, 8.0}) {
            CubicFitter fitter(chain, tolerance);
            for (std::size_t first = 0; first < 60; first += 7) {
                const std::size_t last = std::min<std::size_t>(64, first + 2 + first % 9);
                const auto cubic = fitter.fit(first, last);
                if (!cubic) continue;
                const auto bound =
                    proved_bound(chain, first, last, *cubic, tolerance, cuts);
                if (!bound) continue;
                ++proved;
                const Points run = run_of(bezier, first, last);
                const Points fit = rows_of(*cubic);
                const std::size_t dense = 40 * (last - first);
                const double seen = std::max(sampled_one_sided(run, fit, dense),
                                             sampled_one_sided(fit, run, dense));
                EXPECT_LE(seen - std::max(widest_gap(run, dense), widest_gap(fit, dense)),
                          *bound)
                    << seed << ' ' << tolerance << ' ' << first;
                EXPECT_LE(*bound, tolerance);
            }
        }
    }
    EXPECT_GT(proved, 50);
}

TEST(RunBound, HoldsAtTheCutsItLeaves) {
    const Points bezier =
        bezier_points(drawn_stroke({.level = 6, .noise = 0.5}), Ends::kOpen);
    const Chain chain = make_chain(bezier);
    CubicFitter fitter(chain, 8);
    const auto cubic = fitter.fit(10, 16);
    ASSERT_TRUE(cubic);
    Cuts cuts;
    const auto bound = proved_bound(chain, 10, 16, *cubic, 8, cuts);
    ASSERT_TRUE(bound);
    ASSERT_EQ(cuts.size(), 7U);
    EXPECT_EQ(cuts.front(), 0);
    EXPECT_EQ(cuts.back(), 1);
    EXPECT_TRUE(std::ranges::is_sorted(cuts));
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_LE(norm(PlanePolynomial(*cubic).value(cuts[k]) - chain.pieces[10 + k][0]),
                  *bound);
    }
}

TEST(RunBound, DoesNotMindADifferentSpeed) {
    const Chain chain = make_chain(line());
    Cuts cuts;
    const PlaneCubic same = {PlaneVector{0, 0}, {20, 0}, {40, 0}, {60, 0}};
    const auto bound = proved_bound(chain, 0, 3, same, 0.01, cuts);
    ASSERT_TRUE(bound);
    EXPECT_LE(*bound, 0.01);
}

TEST(RunBound, IsTightForALineBesideALine) {
    const Chain chain = make_chain(line());
    Cuts cuts;
    // A hump of height 3: the middle control points at 4.
    const PlaneCubic hump = {PlaneVector{0, 0}, {20, 4}, {40, 4}, {60, 0}};
    EXPECT_FALSE(proved_bound(chain, 0, 3, hump, 2.99, cuts));
    const auto bound = proved_bound(chain, 0, 3, hump, 3.01, cuts);
    ASSERT_TRUE(bound);
    EXPECT_GE(*bound, 3);
}

// The cubic visits a place that the run does not, between two cuts that fit.
TEST(RunBound, SeesExcursionsOfTheCubic) {
    const Chain chain = make_chain(line());
    Cuts cuts;
    const PlaneCubic loop = {PlaneVector{0, 0}, {120, 0}, {-60, 0}, {60, 0}};
    const auto bound = proved_bound(chain, 0, 3, loop, 100, cuts);
    ASSERT_TRUE(bound);
    const PlaneCubic beyond = {PlaneVector{0, 0}, {400, 0}, {400, 0}, {60, 0}};
    EXPECT_FALSE(proved_bound(chain, 0, 3, beyond, 50, cuts));
}

TEST(RunBound, ProvesNothingBelowWhatRoundingDoes) {
    const Chain chain = make_chain(line());
    Cuts cuts;
    const PlaneCubic same = {PlaneVector{0, 0}, {20, 0}, {40, 0}, {60, 0}};
    EXPECT_FALSE(proved_bound(chain, 0, 3, same, 1e-15, cuts));
}

}  // namespace
}  // namespace haarmony::curve
