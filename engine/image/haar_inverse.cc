#include "engine/image/haar_inverse.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace haarmony::image {
namespace {

// One row or column, `stride` apart. A difference of level `half` is the coefficient times
// its square root, as decompose() divided it.
void recompose_line(float* line, std::ptrdiff_t stride, int side) {
    std::array<float, kMaxSide> values;
    std::array<float, kMaxSide> finer;
    values[0] = line[0];
    for (int half = 1; half < side; half *= 2) {
        const float root = std::sqrt(static_cast<float>(half));
        for (int i = 0; i < half; ++i) {
            const float difference = line[(half + i) * stride] * root;
            finer[2 * i] = values[i] + difference;
            finer[2 * i + 1] = values[i] - difference;
        }
        std::copy_n(finer.begin(), 2 * half, values.begin());
    }
    for (int i = 0; i < side; ++i) line[i * stride] = values[i];
}

void recompose_standard(float* plane, int side) {
    for (int j = 0; j < side; ++j) recompose_line(plane + j, side, side);
    for (int i = 0; i < side; ++i) {
        recompose_line(plane + std::ptrdiff_t{i} * side, 1, side);
    }
}

// The means of one level grow in place into those of the next, over what were coefficients.
void recompose_nonstandard(float* plane, int side) {
    std::array<float, std::size_t{kMaxSide} * kMaxSide> coefficients;
    std::copy_n(plane, std::ptrdiff_t{side} * side, coefficients.begin());
    for (int half = 1; half < side; half *= 2) {
        const auto scale = static_cast<float>(half);
        // From the last block on: what is written lies behind every mean not yet read.
        for (int i = half - 1; i >= 0; --i) {
            const float* const across = coefficients.data() + i * side + half;
            const float* const down = coefficients.data() + (half + i) * side;
            for (int j = half - 1; j >= 0; --j) {
                const float mean = plane[i * side + j];
                const float x = across[j] * scale;
                const float y = down[j] * scale;
                const float xy = down[half + j] * scale;
                float* const upper = plane + 2 * i * side + 2 * j;
                float* const lower = upper + side;
                upper[0] = mean + x + y + xy;
                upper[1] = mean - x + y - xy;
                lower[0] = mean + x - y - xy;
                lower[1] = mean - x - y + xy;
            }
        }
    }
}

}  // namespace

void recompose(std::span<float> plane, int side, Decomposition decomposition) {
    assert(side >= 1 && side <= kMaxSide && std::has_single_bit(unsigned(side)));
    assert(plane.size() == std::size_t(side) * side);
    if (decomposition == Decomposition::kStandard) {
        recompose_standard(plane.data(), side);
    } else {
        recompose_nonstandard(plane.data(), side);
    }
}

}  // namespace haarmony::image
