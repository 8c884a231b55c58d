#include "engine/image/haar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "engine/image/haar_kernel.h"

namespace haarmony::image {
namespace {

// Figure 4.1 divides by sqrt(h) first and by sqrt(2) in every step. Here the steps take
// means and half differences, whose halving is exact, and each coefficient is scaled once,
// at the end: in one dimension coefficient i of level k = floor(log2 i) by 2^(-k/2),
// whatever the length (the coarsest wavelet, i = 1, and the mean, i = 0, by 1).
constexpr int kLevels = 7;  // log2 kMaxSide

int level(int index) {
    return index < 2 ? 0 : std::bit_width(static_cast<unsigned>(index)) - 1;
}

// scale[k][j]: of the coefficients of row level k in column j.
using ScaleTable = std::array<std::array<float, kMaxSide>, kLevels>;

ScaleTable make_scale_table() {
    ScaleTable table{};
    for (int k = 0; k < kLevels; ++k) {
        for (int j = 0; j < kMaxSide; ++j) {
            table[k][j] = static_cast<float>(std::exp2(-0.5 * (k + level(j))));
        }
    }
    return table;
}

const ScaleTable& scale_table() {
    static const ScaleTable table = make_scale_table();
    return table;
}

// One row step and one column step are one step of 2 x 2 blocks
//   a b
//   c d
// whose corners are added crosswise first: the symmetries of the square exchange a + d with
// b + c, or a - d with b - c, and at most change a sign, so that they keep every bit.
// The scale of level `half` is 1 / half, a power of two.
void decompose_nonstandard(float* plane, int side) {
    std::array<float, std::size_t{kMaxSide} * kMaxSide> means;
    std::copy_n(plane, std::ptrdiff_t{side} * side, means.begin());
    for (int half = side / 2; half > 0; half /= 2) {
        const float scale = 0.25F / static_cast<float>(half);
        for (int i = 0; i < half; ++i) {
            const float* const upper = means.data() + std::ptrdiff_t{2} * i * 2 * half;
            const float* const lower = upper + std::ptrdiff_t{2} * half;
            float* const mean = means.data() + std::ptrdiff_t{i} * half;
            float* const across = plane + std::ptrdiff_t{i} * side + half;
            float* const down = plane + std::ptrdiff_t{half + i} * side;
            for (int j = 0; j < half; ++j) {
                const float falling_sum = upper[2 * j] + lower[2 * j + 1];
                const float rising_sum = upper[2 * j + 1] + lower[2 * j];
                const float falling_difference = upper[2 * j] - lower[2 * j + 1];
                const float rising_difference = upper[2 * j + 1] - lower[2 * j];
                across[j] = (falling_difference - rising_difference) * scale;
                down[j] = (falling_difference + rising_difference) * scale;
                down[half + j] = (falling_sum - rising_sum) * scale;
                mean[j] = (falling_sum + rising_sum) * 0.25F;
            }
        }
    }
    plane[0] = means[0];
}

}  // namespace

void decompose(std::span<float> plane, int side, Decomposition decomposition) {
    assert(side >= 1 && side <= kMaxSide && std::has_single_bit(unsigned(side)));
    assert(plane.size() == std::size_t(side) * side);
    if (decomposition == Decomposition::kStandard) {
        decompose_rows(plane, side);
        decompose_columns(plane, side, scale_table().front().data());
    } else {
        decompose_nonstandard(plane.data(), side);
    }
}

}  // namespace haarmony::image
