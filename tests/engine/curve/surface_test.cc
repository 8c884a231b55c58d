#include "engine/curve/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/engine/curve/dense_spline.h"

namespace haarmony::curve {
namespace {

Grid random_grid(int level_u, int level_v, int dimension, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-100, 100);
    Grid grid(control_count(level_u, Ends::kOpen),
              control_count(level_v, Ends::kOpen),
              dimension);
    for (double& x : grid.points.numbers()) x = number(random);
    return grid;
}

// The dense matrix that takes control points of one level to another: its columns.
std::vector<Points> columns_of(int from, int to) {
    std::vector<Points> columns;
    for (std::size_t i = 0; i < control_count(from, Ends::kOpen); ++i) {
        Points unit(control_count(from, Ends::kOpen), 1);
        unit[i][0] = 1;
        columns.push_back(from < to   ? dense::refine(unit, Ends::kOpen, to)
                          : from > to ? dense::project(unit, Ends::kOpen, to)
                                      : unit);
    }
    return columns;
}

// One in u, one in v, applied to every number of the grid by the definition.
Grid transformed(const Grid& grid, int from_u, int to_u, int from_v, int to_v) {
    const std::vector<Points> in_u = columns_of(from_u, to_u);
    const std::vector<Points> in_v = columns_of(from_v, to_v);
    Grid result(control_count(to_u, Ends::kOpen),
                control_count(to_v, Ends::kOpen),
                grid.points.dimension());
    for (std::size_t a = 0; a < grid.along_u; ++a)
        for (std::size_t b = 0; b < grid.along_v; ++b)
            for (std::size_t i = 0; i < result.along_u; ++i)
                for (std::size_t k = 0; k < result.along_v; ++k)
                    for (std::size_t d = 0; d < result.at(i, k).size(); ++d)
                        result.at(i, k)[d] +=
                            in_u[a][i][0] * in_v[b][k][0] * grid.at(a, b)[d];
    return result;
}

TEST(Surface, CoarserLevelsAreProjectionsInBothDirections) {
    const Grid grid = random_grid(3, 2, 2, 1);
    const MultiresSurface surface = decompose(grid);
    ASSERT_EQ(surface.details.size(), 2U);
    for (int step = 0; step <= 2; ++step) {
        const Grid found = reconstruct(surface, std::size_t(step));
        const Grid expected = transformed(grid, 3, 1 + step, 2, step);
        EXPECT_LT(dense::distance(found.points, expected.points), 1e-10) << step;
    }
}

TEST(Surface, DetailGridsAreSizedByTheirDirection) {
    const MultiresSurface surface = decompose(random_grid(4, 2, 3, 2));
    ASSERT_EQ(surface.details.size(), 2U);
    const DetailGrids& fine = surface.details[1];
    EXPECT_EQ(fine.cd.along_u, 11U);
    EXPECT_EQ(fine.cd.along_v, 2U);
    EXPECT_EQ(fine.dc.along_u, 8U);
    EXPECT_EQ(fine.dc.along_v, 5U);
    EXPECT_EQ(fine.dd.along_u, 8U);
    EXPECT_EQ(fine.dd.along_v, 2U);
    EXPECT_EQ(surface.coarse.along_u, 7U);
    EXPECT_EQ(surface.coarse.along_v, 4U);
}

TEST(Surface, WhatVariesInOneDirectionHasDetailsInThatOne) {
    Grid grid(7, 7, 1);
    for (std::size_t a = 0; a < 7; ++a)
        for (std::size_t b = 0; b < 7; ++b) grid.at(a, b)[0] = double(b % 2);
    const MultiresSurface surface = decompose(grid);
    for (const DetailGrids& details : surface.details) {
        double in_v = 0;
        for (const double number : details.cd.points.numbers()) in_v += std::abs(number);
        EXPECT_GT(in_v, 1e-2);
        for (const Grid* none : {&details.dc, &details.dd})
            for (const double number : none->points.numbers())
                EXPECT_NEAR(number, 0, 1e-14);
    }
}

TEST(Surface, ReconstructsWhatItDecomposed) {
    for (const auto& [u, v] : {std::pair(0, 3), std::pair(5, 5), std::pair(2, 6)}) {
        const Grid grid = random_grid(u, v, 3, unsigned(u + v));
        const MultiresSurface surface = decompose(grid);
        const Grid again = reconstruct(surface, surface.details.size());
        EXPECT_EQ(again.along_u, grid.along_u);
        EXPECT_LT(dense::distance(again.points, grid.points), 1e-11) << u << ", " << v;
    }
}

TEST(Surface, SmoothedInOneDirectionThenTheOther) {
    const Grid grid = random_grid(3, 3, 1, 5);
    EXPECT_LT(
        dense::distance(smooth(grid, 1, 2).points, transformed(grid, 3, 1, 3, 2).points),
        1e-10);
    // Equation (3.1) in u: a mixture of levels 1 and 2.
    const Grid mixed = smooth(grid, 1.25, 3);
    const Grid low = transformed(grid, 3, 1, 3, 3);
    const Grid high = transformed(grid, 3, 2, 3, 3);
    const Grid low_as_high = transformed(low, 1, 2, 3, 3);
    for (std::size_t i = 0; i < mixed.points.size(); ++i)
        EXPECT_NEAR(mixed.points[i][0],
                    0.75 * low_as_high.points[i][0] + 0.25 * high.points[i][0],
                    1e-10);
}

TEST(Surface, AnEditAtIntegerLevelsAddsTheCoarseBasisFunction) {
    const Grid grid = random_grid(4, 3, 3, 6);
    const double delta[] = {1, -2, 25};
    for (const auto& [u, v] : {std::pair(4, 3), std::pair(2, 1), std::pair(0, 3)}) {
        Grid change(control_count(u, Ends::kOpen), control_count(v, Ends::kOpen), 3);
        std::copy_n(delta, 3, change.at(1, 2).begin());
        const Grid added = transformed(change, u, 4, v, 3);
        const Result<EditedSurface> edited =
            edit_surface(grid, {double(u), double(v), 1, 2, delta});
        ASSERT_TRUE(edited);
        EXPECT_LT(dense::distance(edited->control.points,
                                  dense::sum(grid.points, 1, added.points)),
                  1e-11)
            << u << ", " << v;
        std::size_t changed = 0;
        for (std::size_t i = 0; i < grid.points.size(); ++i)
            changed += std::abs(added.points[i][2]) > 1e-9 ? 1 : 0;
        EXPECT_EQ(edited->changed, changed) << u << ", " << v;
    }
}

// g(t) makes the breadth of a fractional edit lie between; the smoothed control point moves
// by delta whatever the fraction.
TEST(Surface, AFractionalEditMovesTheSmoothedPointByDelta) {
    const Grid grid = random_grid(4, 4, 2, 7);
    const double delta[] = {3, 5};
    for (const double u : {0.5, 1.3, 2.0, 3.9}) {
        for (const double v : {0.7, 3.2}) {
            const Result<EditedSurface> edited = edit_surface(grid, {u, v, 2, 3, delta});
            ASSERT_TRUE(edited);
            const Grid before = smooth(grid, u, v);
            const Grid after = smooth(edited->control, u, v);
            for (std::size_t d = 0; d < 2; ++d)
                EXPECT_NEAR(after.at(2, 3)[d] - before.at(2, 3)[d], delta[d], 1e-10)
                    << u << v;
        }
    }
}

TEST(Surface, WhatTheGridDoesNotHaveIsNamed) {
    const Grid grid = random_grid(2, 1, 2, 8);
    const double delta[] = {1, 1};
    const double infinite[] = {1, std::numeric_limits<double>::infinity()};
    const auto error = [&](const SurfaceEdit& edit) {
        const Result<EditedSurface> edited = edit_surface(grid, edit);
        EXPECT_FALSE(edited);
        return edited ? Error() : edited.error();
    };
    EXPECT_EQ(error({2.5, 0, 0, 0, delta}).param, "level_u");
    EXPECT_NE(error({2.5, 0, 0, 0, delta}).message.find("2.5"), std::string::npos);
    EXPECT_EQ(error({0, -1, 0, 0, delta}).param, "level_v");
    EXPECT_EQ(error({0, std::nan(""), 0, 0, delta}).param, "level_v");
    EXPECT_EQ(error({0, 0, 4, 0, delta}).param, "index_u");
    EXPECT_EQ(error({0, 0.5, 0, 5, delta}).param, "index_v");
    EXPECT_NE(error({0, 0.5, 0, 5, delta}).message.find("5"), std::string::npos);
    EXPECT_EQ(error({0, 0, 0, 0, std::span(delta, 1)}).param, "delta");
    EXPECT_EQ(error({0, 0, 0, 0, infinite}).param, "delta");
    EXPECT_NE(error({0, 0, 0, 0, infinite}).message.find("inf"), std::string::npos);
}

TEST(Surface, AnEditThatOverflowsIsRefused) {
    Grid grid(4, 4, 1);
    for (double& number : grid.points.numbers()) number = 1.7e308;
    const double delta = 1e308;
    const Result<EditedSurface> edited = edit_surface(grid, {0, 0, 1, 1, {&delta, 1}});
    ASSERT_FALSE(edited);
    EXPECT_EQ(edited.error().param, "delta");
}

TEST(Surface, PointsAreProductsOfBasisFunctions) {
    const Grid grid = random_grid(2, 3, 3, 9);
    for (const double u : {0.0, 0.3, 1.0}) {
        for (const double v : {0.0, 0.61, 1.0}) {
            const auto found = point_at(grid, u, v);
            for (std::size_t d = 0; d < 3; ++d) {
                double sum = 0;
                for (std::size_t a = 0; a < grid.along_u; ++a)
                    for (std::size_t b = 0; b < grid.along_v; ++b)
                        sum += dense::basis(2, Ends::kOpen, a, u) *
                               dense::basis(3, Ends::kOpen, b, v) * grid.at(a, b)[d];
                EXPECT_NEAR(found[d], sum, 1e-12) << u << ", " << v;
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
