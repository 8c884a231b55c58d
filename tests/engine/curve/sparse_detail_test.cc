#include "engine/curve/sparse_detail.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "engine/curve/bspline.h"
#include "engine/curve/bspline_filters.h"
#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

constexpr Ends kBothEnds[] = {Ends::kOpen, Ends::kClosed};
constexpr double kDelta[] = {3, -4};

// The curve at a finer level, by synthesis alone.
Points raised(Points control, Ends ends, int from, int to) {
    for (int level = from; level < to; ++level) control = synthesize(control, {}, ends);
    return control;
}

TEST(SparseCurve, AMovedControlPointIsMovedAndNothingElse) {
    for (const Ends ends : kBothEnds) {
        const Points control = dense::random_curve(4, ends, 2, 1);
        for (const int level : {4, 5, 7, 10, 12}) {
            const std::size_t count = control_count(level, ends);
            for (const std::size_t index : {std::size_t{0},
                                            std::size_t{1},
                                            count / 3,
                                            count / 2 + 1,
                                            count - 2,
                                            count - 1}) {
                SparseCurve sparse(control, ends);
                sparse.move_control(level, index, kDelta, 1e-16);
                Points expected = raised(control, ends, 4, level);
                for (std::size_t d = 0; d < 2; ++d) expected[index][d] += kDelta[d];
                const Points found =
                    raised(reconstruct(sparse.whole()), ends, sparse.level(), level);
                EXPECT_LT(dense::distance(found, expected), 1e-11)
                    << int(ends) << ": " << index << " of level " << level;
            }
        }
    }
}

TEST(SparseCurve, ItsDetailsAreThoseOfTheWholeDecomposition) {
    for (const Ends ends : kBothEnds) {
        SparseCurve sparse(dense::random_curve(3, ends, 2, 2), ends);
        sparse.move_control(11, 700, kDelta, 1e-16);
        Points whole = raised(reconstruct(sparse.whole()), ends, sparse.level(), 11);
        const MultiresCurve expected = decompose(whole, ends);
        for (int level = 3; level < 11; ++level) {
            for (std::size_t k = 0; k < segment_count(level); ++k) {
                const auto row = sparse.detail(level, k);
                for (std::size_t d = 0; d < 2; ++d)
                    EXPECT_NEAR(row.empty() ? 0 : row[d],
                                expected.details[std::size_t(level)][k][d],
                                1e-12)
                        << int(ends) << ": " << k << " of level " << level;
            }
        }
    }
}

// What an edit costs does not depend on how long the curve is: counted, not timed.
TEST(SparseCurve, AnEditLooksAtWhatItTouchesOnly) {
    for (const Ends ends : kBothEnds) {
        std::size_t last_nodes = 0;
        std::size_t last_visited = 0;
        for (const int level : {12, 14, 16, 18, 20}) {
            SparseCurve sparse(dense::random_curve(6, ends, 2, 3), ends);
            const std::size_t visited =
                sparse.move_control(level, segment_count(level) / 3, kDelta, 1e-9);
            if (last_nodes > 0) {
                EXPECT_LE(sparse.node_count() - last_nodes, 2 * 100U) << level;
                EXPECT_LE(visited - last_visited, 2 * 515U) << level;
            }
            last_nodes = sparse.node_count();
            last_visited = visited;
        }
        EXPECT_LT(last_nodes, 1500U);
    }
}

// An edit of the same curve at the same level costs the same wherever it is dense.
TEST(SparseCurve, CostsTheSameOverALongCurve) {
    SparseCurve over_short(dense::random_curve(10, Ends::kOpen, 2, 4), Ends::kOpen);
    SparseCurve over_long(dense::random_curve(14, Ends::kOpen, 2, 4), Ends::kOpen);
    const std::size_t deep = over_short.move_control(16, 30000, kDelta, 1e-9);
    const std::size_t shallow = over_long.move_control(16, 30000, kDelta, 1e-9);
    EXPECT_LT(shallow, deep);
    EXPECT_LT(over_long.node_count(), over_short.node_count());
}

TEST(SparseCurve, PointsAreThoseOfTheWholeCurve) {
    for (const Ends ends : kBothEnds) {
        SparseCurve sparse(dense::random_curve(4, ends, 2, 5), ends);
        sparse.move_control(9, 100, kDelta, 1e-16);
        sparse.move_control(7, 3, kDelta, 1e-16);
        const Points whole = reconstruct(sparse.whole());
        for (int i = 0; i <= 300; ++i) {
            const double u = i / 300.0;
            const auto found = sparse.point_at(u);
            const auto expected = point_at(whole, ends, u);
            for (std::size_t d = 0; d < 2; ++d)
                EXPECT_NEAR(found[d], expected[d], 1e-11) << int(ends) << ", " << u;
        }
    }
}

TEST(SparseCurve, LeavingOutByPrecisionStaysWithinIt) {
    for (const double precision : {1e-3, 1e-6, 1e-9, 1e-12}) {
        SparseCurve sparse(dense::random_curve(5, Ends::kOpen, 2, 6), Ends::kOpen);
        SparseCurve exact = sparse;
        sparse.move_control(11, 1000, kDelta, precision);
        exact.move_control(11, 1000, kDelta, 1e-16);
        EXPECT_LT(sparse.node_count(), exact.node_count()) << precision;
        double worst = 0;
        for (int i = 0; i <= 2000; ++i) {
            const double u = i / 2000.0;
            worst =
                std::max(worst, std::abs(sparse.point_at(u)[1] - exact.point_at(u)[1]));
        }
        // A few coefficients of each of six levels, each less than precision * |delta|.
        EXPECT_LT(worst, 30 * precision * 5) << precision;
    }
}

TEST(SparseCurve, ADetailIsOneWaveletAndThoseAboveIt) {
    SparseCurve sparse(Points(control_count(2, Ends::kOpen), 1), Ends::kOpen);
    EXPECT_EQ(sparse.level(), 2);
    EXPECT_TRUE(sparse.detail(6, 40).empty());
    const double one = 1;
    sparse.add_detail(6, 40, {&one, 1});
    EXPECT_EQ(sparse.level(), 7);
    EXPECT_EQ(sparse.node_count(), 5U);  // levels 2, 3, 4, 5, 6
    EXPECT_EQ(sparse.detail(6, 40)[0], 1);
    EXPECT_EQ(sparse.detail(5, 20)[0], 0);
    EXPECT_TRUE(sparse.detail(6, 41).empty());
    Points wavelet(control_count(7, Ends::kOpen), 1);
    const Filter filter = wavelet_column(7, Ends::kOpen, 40);
    for (std::size_t i = 0; i < 11; ++i) wavelet[filter.first + i][0] = filter.value[i];
    for (double u = 0; u <= 1; u += 1.0 / 128)
        EXPECT_NEAR(
            sparse.point_at(u)[0], dense::point(wavelet, Ends::kOpen, u)[0], 1e-12)
            << u;
    sparse.add_detail(6, 40, {&one, 1});
    EXPECT_EQ(sparse.node_count(), 5U);
    EXPECT_EQ(sparse.detail(6, 40)[0], 2);
}

TEST(SparseCurve, PruningMovesNoPointByMoreThanItsBound) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (const Ends ends : kBothEnds) {
        for (const double tolerance : {0.01, 1.0, 3.0, 10.0}) {
            SparseCurve sparse(dense::random_curve(3, ends, 2, 7), ends);
            for (int level = 3; level < 8; ++level) {
                for (std::size_t k = 0; k < segment_count(level); k += 2) {
                    const double detail[] = {std::ldexp(number(random), -level),
                                             std::ldexp(number(random), -level)};
                    sparse.add_detail(level, k, detail);
                }
            }
            SparseCurve pruned = sparse;
            const double bound = pruned.prune(tolerance);
            EXPECT_LE(bound, tolerance);
            double worst = 0;
            for (int i = 0; i <= 1000; ++i) {
                const auto a = sparse.point_at(i / 1000.0);
                const auto b = pruned.point_at(i / 1000.0);
                worst = std::max(worst, std::hypot(a[0] - b[0], a[1] - b[1]));
            }
            EXPECT_LE(worst, bound) << int(ends) << ", " << tolerance;
            if (tolerance >= 1) {
                EXPECT_LT(pruned.node_count(), sparse.node_count()) << tolerance;
                EXPECT_GT(worst, bound / 20) << int(ends) << ", " << tolerance;
            }
        }
    }
}

TEST(SparseCurve, PruningNothingTakesRowsOfZerosOnly) {
    SparseCurve sparse(Points(control_count(1, Ends::kOpen), 1), Ends::kOpen);
    const double one = 1;
    const double minus_one = -1;
    sparse.add_detail(4, 3, {&one, 1});
    sparse.add_detail(5, 30, {&one, 1});
    EXPECT_EQ(sparse.node_count(), 4U + 5U);
    EXPECT_EQ(sparse.prune(0), 0);
    EXPECT_EQ(sparse.node_count(), 4U + 5U);
    sparse.add_detail(5, 30, {&minus_one, 1});
    EXPECT_EQ(sparse.prune(0), 0);
    EXPECT_EQ(sparse.node_count(), 4U);
    EXPECT_EQ(sparse.level(), 5);
    EXPECT_EQ(sparse.detail(4, 3)[0], 1);
    EXPECT_TRUE(sparse.detail(5, 30).empty());
}

}  // namespace
}  // namespace haarmony::curve
