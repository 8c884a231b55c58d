#include "engine/image/haar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/engine/image/all_kinds.h"

namespace haarmony::image {
namespace {

std::vector<float> random_plane(int side, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> plane(std::size_t(side) * side);
    for (float& value : plane) value = static_cast<float>(random() >> 8) / (1 << 24);
    return plane;
}

std::vector<float> decomposed(std::vector<float> plane,
                              int side,
                              Decomposition decomposition = Decomposition::kStandard) {
    decompose(plane, side, decomposition);
    return plane;
}

// Basis function k of an orthonormal Haar basis of `side` samples, from its formula.
double basis(int k, int x, int side) {
    if (k == 0) return 1 / std::sqrt(side);
    int level = 0;
    while (2 << level <= k) ++level;
    const int support = side >> level;
    const int begin = (k - (1 << level)) * support;
    if (x < begin || x >= begin + support) return 0;
    return (x < begin + support / 2 ? 1 : -1) / std::sqrt(support);
}

std::vector<double> basis_matrix(int side) {
    std::vector<double> matrix;
    for (int k = 0; k < side; ++k) {
        for (int x = 0; x < side; ++x) matrix.push_back(basis(k, x, side));
    }
    return matrix;
}

// matrix * plane * transposed matrix / side, in double precision.
std::vector<double> by_inner_products(const std::vector<float>& plane, int side) {
    const std::vector<double> matrix = basis_matrix(side);
    std::vector<double> rows(plane.size());
    std::vector<double> result(plane.size());
    for (int y = 0; y < side; ++y) {
        for (int k = 0; k < side; ++k) {
            for (int x = 0; x < side; ++x) {
                rows[y * side + k] += matrix[k * side + x] * plane[y * side + x];
            }
        }
    }
    for (int k = 0; k < side; ++k) {
        for (int y = 0; y < side; ++y) {
            for (int j = 0; j < side; ++j) {
                result[k * side + j] += matrix[k * side + y] * rows[y * side + j] / side;
            }
        }
    }
    return result;
}

// Position and size of the square that non-standard basis function (row, column) lives on,
// and whether its sign changes along x and along y.
struct Square {
    int x, y, size;
    bool changes_along_x, changes_along_y;
};
Square square_of(int row, int column, int side) {
    if (row == 0 && column == 0) return {0, 0, side, false, false};
    int count = 1;  // squares side by side
    while (2 * count <= std::max(row, column)) count *= 2;
    const int size = side / count;
    return {
        column % count * size, row % count * size, size, column >= count, row >= count};
}

// The inner product with every non-standard basis function, divided by side: of height
// 1 / size, so that each has length 1.
std::vector<double> by_squares(const std::vector<float>& plane, int side) {
    std::vector<double> result;
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const Square square = square_of(row, column, side);
            double sum = 0;
            for (int y = 0; y < square.size; ++y) {
                for (int x = 0; x < square.size; ++x) {
                    const bool left = 2 * x < square.size;
                    const bool upper = 2 * y < square.size;
                    const bool negative = (square.changes_along_x && !left) !=
                                          (square.changes_along_y && !upper);
                    const double value = plane[(square.y + y) * side + square.x + x];
                    sum += negative ? -value : value;
                }
            }
            result.push_back(sum / square.size / side);
        }
    }
    return result;
}

// DecomposeArray of Figure 4.1, line by line.
void decompose_array(std::vector<double>& a) {
    std::size_t h = a.size();
    for (double& value : a) value /= std::sqrt(h);
    while (h > 1) {
        h /= 2;
        std::vector<double> next = a;
        for (std::size_t i = 0; i < h; ++i) {
            next[i] = (a[2 * i] + a[2 * i + 1]) / std::sqrt(2);
            next[h + i] = (a[2 * i] - a[2 * i + 1]) / std::sqrt(2);
        }
        a = next;
    }
}

TEST(Haar, IsTheInnerProductWithTheBasisFunctions) {
    for (int side = 1; side <= kMaxSide; side *= 2) {
        const std::vector<float> plane = random_plane(side, 21);
        const std::vector<float> coefficients = decomposed(plane, side);
        const std::vector<double> expected = by_inner_products(plane, side);
        for (std::size_t i = 0; i < plane.size(); ++i) {
            // 14 roundings of numbers below 1.
            ASSERT_NEAR(coefficients[i], expected[i], 1e-6)
                << "side " << side << " at " << i;
        }
    }
}

TEST(Haar, NonstandardIsTheInnerProductWithTheSquareBasisFunctions) {
    for (int side = 1; side <= kMaxSide; side *= 2) {
        const std::vector<float> plane = random_plane(side, 25);
        const std::vector<float> coefficients =
            decomposed(plane, side, Decomposition::kNonstandard);
        const std::vector<double> expected = by_squares(plane, side);
        for (std::size_t i = 0; i < plane.size(); ++i) {
            // 14 roundings of numbers below 1.
            ASSERT_NEAR(coefficients[i], expected[i], 1e-6)
                << "side " << side << " at " << i;
        }
    }
}

TEST(Haar, OfOneRowIsDecomposeArrayOfFigure4_1) {
    constexpr int kLength = 128;
    const std::vector<float> plane = random_plane(kLength, 22);
    std::vector<float> equal_rows;
    for (int y = 0; y < kLength; ++y) {
        equal_rows.insert(equal_rows.end(), plane.begin(), plane.begin() + kLength);
    }
    std::vector<double> expected(plane.begin(), plane.begin() + kLength);
    decompose_array(expected);
    decompose(equal_rows, kLength, Decomposition::kStandard);
    for (int j = 0; j < kLength; ++j) ASSERT_NEAR(equal_rows[j], expected[j], 1e-6) << j;
}

TEST(Haar, OfTwoByTwoByHand) {
    const std::vector<float> coefficients = decomposed({0.5F, 0.25F, 1.0F, 0.75F}, 2);
    EXPECT_EQ(coefficients, (std::vector<float>{0.625F, 0.125F, -0.25F, 0.0F}));
}

// Rows 8 8 0 0 | 8 8 0 0 | 4 0 0 0 | 4 0 0 0. Of the columns' halves: means 8 8 0 0 and
// 4 0 0 0, no difference within a half.
TEST(Haar, OfFourByFourByHand) {
    const std::vector<float> coefficients =
        decomposed({8, 8, 0, 0, 8, 8, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0}, 4);
    const float half_root = std::sqrt(0.5F);
    const std::vector<float> expected = {
        2.5F,
        2.5F,
        half_root,
        0,  // mean, left - right, detail of the left half
        1.5F,
        1.5F,
        -half_root,
        0,  // upper - lower half of the same
        0,
        0,
        0,
        0,  //
        0,
        0,
        0,
        0};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_FLOAT_EQ(coefficients[i], expected[i]) << i;
    }
}

// The same rows as above: the quarters' means are 8, 0, 2 and 0; only the lower left one has
// a detail, from left to right.
TEST(Haar, NonstandardOfFourByFourByHand) {
    const std::vector<float> coefficients = decomposed(
        {8, 8, 0, 0, 8, 8, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0}, 4, Decomposition::kNonstandard);
    const std::vector<float> expected = {
        2.5F, 2.5F, 0, 0, 1.5F, 1.5F, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_EQ(coefficients, expected);
}

TEST(Haar, FlatImageHasNoCoefficients) {
    for (const Decomposition decomposition : kAllDecompositions) {
        for (const float value : {0.0F, 0.1F, 1.0F, -0.3F, 1.0F / 3.0F}) {
            std::vector<float> plane(128 * 128, value);
            decompose(plane, 128, decomposition);
            EXPECT_EQ(plane[0], value);
            EXPECT_TRUE(std::all_of(
                plane.begin() + 1, plane.end(), [](float c) { return c == 0.0F; }));
        }
    }
}

TEST(Haar, KeepsTheMeanSquare) {
    const std::vector<float> plane = random_plane(128, 23);
    double before = 0;
    for (const float value : plane)
        before += double(value) * value / double(plane.size());
    for (const Decomposition decomposition : kAllDecompositions) {
        double after = 0;
        for (const float value : decomposed(plane, 128, decomposition))
            after += double(value) * value;
        EXPECT_NEAR(after, before, 1e-6) << decomposition_name(decomposition);
    }
}

// The coefficients of the mirror image are the same numbers at mirrored places, with the
// sign of each wavelet's antisymmetry: exactly, because sums and differences commute.
TEST(Haar, OfTheMirrorImageIsExactlyThePermutedOriginal) {
    constexpr int kLength = 128;
    const std::vector<float> plane = random_plane(kLength, 24);
    std::vector<float> mirrored = plane;
    for (int y = 0; y < kLength; ++y) {
        std::reverse(mirrored.begin() + y * kLength,
                     mirrored.begin() + (y + 1) * kLength);
    }
    const std::vector<float> original = decomposed(plane, kLength);
    decompose(mirrored, kLength, Decomposition::kStandard);
    for (int i = 0; i < kLength; ++i) {
        EXPECT_EQ(mirrored[i * kLength], original[i * kLength]);
        for (int level = 1; level < kLength; level *= 2) {
            for (int k = 0; k < level; ++k) {
                ASSERT_EQ(mirrored[i * kLength + level + k],
                          -original[i * kLength + 2 * level - 1 - k]);
            }
        }
    }
}

// Turned pixels have the same non-standard coefficients, bit for bit, at turned places: the
// basis functions of one square are those of the turned square, up to sign and to exchanging
// across and down.
TEST(Haar, NonstandardOfTheTransposedImageIsExactlyTheTransposedOriginal) {
    constexpr int kLength = 128;
    const std::vector<float> plane = random_plane(kLength, 26);
    std::vector<float> transposed(plane.size());
    for (int y = 0; y < kLength; ++y) {
        for (int x = 0; x < kLength; ++x) {
            transposed[x * kLength + y] = plane[y * kLength + x];
        }
    }
    const std::vector<float> original =
        decomposed(plane, kLength, Decomposition::kNonstandard);
    decompose(transposed, kLength, Decomposition::kNonstandard);
    for (int row = 0; row < kLength; ++row) {
        for (int column = 0; column < kLength; ++column) {
            ASSERT_EQ(transposed[column * kLength + row],
                      original[row * kLength + column])
                << row << ", " << column;
        }
    }
}

TEST(Haar, NonstandardOfTheMirrorImageIsExactlyThePermutedOriginal) {
    constexpr int kLength = 128;
    const std::vector<float> plane = random_plane(kLength, 27);
    std::vector<float> mirrored = plane;
    for (int y = 0; y < kLength; ++y) {
        std::reverse(mirrored.begin() + y * kLength,
                     mirrored.begin() + (y + 1) * kLength);
    }
    const std::vector<float> original =
        decomposed(plane, kLength, Decomposition::kNonstandard);
    decompose(mirrored, kLength, Decomposition::kNonstandard);
    for (int row = 0; row < kLength; ++row) {
        for (int column = 0; column < kLength; ++column) {
            const Square square = square_of(row, column, kLength);
            const int count = kLength / square.size;
            const int first = square.changes_along_x ? count : 0;
            const int opposite = first + (count - 1 - (column - first));
            const float value = original[row * kLength + opposite];
            ASSERT_EQ(mirrored[row * kLength + column],
                      square.changes_along_x ? -value : value)
                << row << ", " << column;
        }
    }
}

}  // namespace
}  // namespace haarmony::image
