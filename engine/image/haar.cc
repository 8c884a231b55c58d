#include "engine/image/haar.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

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

void decompose_row(float* row, int side) {
    std::array<float, kMaxSide> values;
    std::array<float, kMaxSide / 2> means;
    std::copy_n(row, side, values.begin());
    for (int half = side / 2; half > 0; half /= 2) {
        for (int i = 0; i < half; ++i) {
            means[i] = (values[2 * i] + values[2 * i + 1]) * 0.5F;
            row[half + i] = (values[2 * i] - values[2 * i + 1]) * 0.5F;
        }
        std::copy_n(means.begin(), half, values.begin());
    }
    row[0] = values[0];
}

// kWidth neighbouring columns together, row by row: reads and writes run along the rows,
// and a strip of 16 columns (8 KiB) stays in the first-level cache.
template <int kWidth>
void decompose_columns(float* plane, int side, int column) {
    const ScaleTable& scales = scale_table();
    std::array<std::array<float, kWidth>, kMaxSide> values;
    for (int i = 0; i < side; ++i) {
        std::copy_n(plane + std::ptrdiff_t{i} * side + column, kWidth, values[i].begin());
    }
    for (int half = side / 2; half > 0; half /= 2) {
        const float* const scale = scales[level(half)].data() + column;
        for (int i = 0; i < half; ++i) {
            float* const out = plane + std::ptrdiff_t{half + i} * side + column;
            for (int c = 0; c < kWidth; ++c) {
                const float a = values[2 * i][c];
                const float b = values[2 * i + 1][c];
                out[c] = (a - b) * 0.5F * scale[c];
                values[i][c] = (a + b) * 0.5F;
            }
        }
    }
    const float* const scale = scales[0].data() + column;
    for (int c = 0; c < kWidth; ++c) plane[column + c] = values[0][c] * scale[c];
}

}  // namespace

void decompose(std::span<float> plane, int side) {
    assert(side >= 1 && side <= kMaxSide && std::has_single_bit(unsigned(side)));
    assert(plane.size() == std::size_t(side) * side);
    for (int i = 0; i < side; ++i) {
        decompose_row(plane.data() + std::ptrdiff_t{i} * side, side);
    }
    constexpr int kStrip = 16;
    if (side >= kStrip) {
        for (int j = 0; j < side; j += kStrip) {
            decompose_columns<kStrip>(plane.data(), side, j);
        }
    } else {
        for (int j = 0; j < side; ++j) decompose_columns<1>(plane.data(), side, j);
    }
}

}  // namespace haarmony::image
