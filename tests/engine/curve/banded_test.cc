#include "engine/curve/banded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace haarmony::curve {
namespace {

using Matrix = std::vector<std::vector<double>>;

// Gaussian elimination with pivots.
std::vector<double> solve_dense(Matrix a, std::vector<double> b) {
    const std::size_t n = a.size();
    for (std::size_t c = 0; c < n; ++c) {
        std::size_t pivot = c;
        for (std::size_t r = c + 1; r < n; ++r)
            if (std::abs(a[r][c]) > std::abs(a[pivot][c])) pivot = r;
        std::swap(a[c], a[pivot]);
        std::swap(b[c], b[pivot]);
        for (std::size_t r = c + 1; r < n; ++r) {
            const double factor = a[r][c] / a[c][c];
            if (factor == 0) continue;
            for (std::size_t k = c; k < n; ++k) a[r][k] -= factor * a[c][k];
            b[r] -= factor * b[c];
        }
    }
    for (std::size_t r = n; r-- > 0;) {
        for (std::size_t k = r + 1; k < n; ++k) b[r] -= a[r][k] * b[k];
        b[r] /= a[r][r];
    }
    return b;
}

std::vector<double> random_numbers(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    std::vector<double> numbers(count);
    for (double& x : numbers) x = number(random);
    return numbers;
}

// Rows of the B-spline of degree 7 at its knots: ill-conditioned enough to matter. The ones
// at the ends are others.
Banded<3>::Row spline_row(std::size_t row, std::size_t rows) {
    Banded<3>::Row numbers = {1, 120, 1191, 2416, 1191, 120, 1};
    if (row < 2) numbers[3] += 500 * double(row + 1);
    if (rows - row < 3) numbers[2] -= 300;
    return numbers;
}

Matrix written_out(std::size_t count) {
    Matrix matrix(count, std::vector<double>(count));
    for (std::size_t row = 0; row < count; ++row) {
        const auto numbers = spline_row(row, count);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const std::size_t column = row + k - 3;
            if (column < count) matrix[row][column] = numbers[k];
        }
    }
    return matrix;
}

TEST(Banded, SolvesWhatEliminationWithPivotsSolves) {
    for (const std::size_t rows : {1U, 2U, 3U, 4U, 7U, 16U, 127U}) {
        const Banded<3> banded(rows,
                               [&](std::size_t row) { return spline_row(row, rows); });
        const auto b = random_numbers(rows, unsigned(rows));
        const auto expected = solve_dense(written_out(rows), b);
        auto x = b;
        banded.solve(x, 1);
        for (std::size_t i = 0; i < rows; ++i)
            EXPECT_NEAR(x[i], expected[i], 1e-15) << rows << ", " << i;
    }
}

TEST(Banded, ALongerMatrixRepeatsTheMiddle) {
    const std::size_t rows = Banded<3>::kSettled;
    const Banded<3> banded(rows, [&](std::size_t row) { return spline_row(row, rows); });
    for (const std::size_t count : {rows + 1, rows + 64, 3 * rows + 5}) {
        const auto b = random_numbers(count, unsigned(count));
        const auto expected = solve_dense(written_out(count), b);
        auto x = b;
        banded.solve(x, 1);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_NEAR(x[i], expected[i], 1e-15) << count << ", " << i;
    }
}

TEST(Banded, EveryDimensionIsSolvedAsIfItWereAlone) {
    constexpr std::size_t kRows = 40;
    const Banded<3> banded(kRows,
                           [&](std::size_t row) { return spline_row(row, kRows); });
    for (int dimension = 2; dimension <= 8; ++dimension) {
        const auto n = std::size_t(dimension);
        auto together = random_numbers(kRows * n, unsigned(dimension));
        std::vector<double> alone = together;
        banded.solve(together, dimension);
        for (std::size_t d = 0; d < n; ++d) {
            std::vector<double> one(kRows);
            for (std::size_t i = 0; i < kRows; ++i) one[i] = alone[i * n + d];
            banded.solve(one, 1);
            for (std::size_t i = 0; i < kRows; ++i)
                EXPECT_EQ(together[i * n + d], one[i]) << dimension << ", " << i;
        }
    }
}

TEST(Banded, AroundACircleOfAnyLength) {
    const std::size_t rows = Banded<3>::kSettled;
    const Banded<3> wide(rows, [&](std::size_t row) { return spline_row(row, rows); });
    const Banded<1> narrow(rows, [](std::size_t) { return Banded<1>::Row{2, 12, 2}; });
    for (std::size_t count = 1; count <= 140;
         count = count < 12 ? count + 1 : 2 * count) {
        Matrix seven(count, std::vector<double>(count));
        Matrix three = seven;
        const auto middle = spline_row(rows / 2, rows);
        for (std::size_t row = 0; row < count; ++row) {
            for (std::size_t k = 0; k < 7; ++k)
                seven[row][(row + 7 * count + k - 3) % count] += middle[k];
            for (std::size_t k = 0; k < 3; ++k)
                three[row][(row + count + k - 1) % count] += k == 1 ? 12 : 2;
        }
        const auto b = random_numbers(count, unsigned(count));
        auto x = b;
        wide.solve_around(x, 1);
        const auto of_seven = solve_dense(seven, b);
        auto y = b;
        narrow.solve_around(y, 1);
        const auto of_three = solve_dense(three, b);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_NEAR(x[i], of_seven[i], 1e-15) << count << ", " << i;
            EXPECT_NEAR(y[i], of_three[i], 1e-15) << count << ", " << i;
        }
    }
}

}  // namespace
}  // namespace haarmony::curve
