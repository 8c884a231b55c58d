#include "engine/image/haar_kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "engine/image/haar.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/image/haar_kernel.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace haarmony::image {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

const hn::ScalableTag<float> kD;
using V = hn::Vec<decltype(kD)>;

void decompose_row(float* HWY_RESTRICT row, int side) {
    const int lanes = static_cast<int>(hn::Lanes(kD));
    const V half_of = hn::Set(kD, 0.5F);
    HWY_ALIGN std::array<float, kMaxSide> means;
    std::copy_n(row, side, means.begin());
    for (int half = side / 2; half > 0; half /= 2) {
        // Means go where pairs have been read: never ahead of the reading.
        int i = 0;
        for (; i + lanes <= half; i += lanes) {
            V left, right;
            hn::LoadInterleaved2(kD, means.data() + 2 * i, left, right);
            hn::StoreU(hn::Mul(hn::Sub(left, right), half_of), kD, row + half + i);
            hn::StoreU(hn::Mul(hn::Add(left, right), half_of), kD, means.data() + i);
        }
        for (; i < half; ++i) {
            const float left = means[2 * i];
            const float right = means[2 * i + 1];
            row[half + i] = (left - right) * 0.5F;
            means[i] = (left + right) * 0.5F;
        }
    }
    row[0] = means[0];
}

void DecomposeRows(float* plane, int side) {
    for (int i = 0; i < side; ++i) decompose_row(plane + std::ptrdiff_t{i} * side, side);
}

// Neighbouring columns together, row by row: a strip of 16 columns (8 KiB) stays in the
// first-level cache.
constexpr int kStrip = 16;
using Strip = std::array<std::array<float, kStrip>, kMaxSide>;

// Row i of the next level from rows 2i and 2i + 1 of this one.
HWY_INLINE void step(Strip& means,
                     int i,
                     int width,
                     const float* HWY_RESTRICT scale,
                     float* HWY_RESTRICT out) {
    const int lanes = static_cast<int>(hn::Lanes(kD));
    const float* const upper = means[2 * i].data();
    const float* const lower = means[2 * i + 1].data();
    float* const mean = means[i].data();
    const V half_of = hn::Set(kD, 0.5F);
    int c = 0;
    for (; c + lanes <= width; c += lanes) {
        const V a = hn::LoadU(kD, upper + c);
        const V b = hn::LoadU(kD, lower + c);
        const V difference = hn::Mul(hn::Sub(a, b), half_of);
        hn::StoreU(hn::Mul(difference, hn::LoadU(kD, scale + c)), kD, out + c);
        hn::StoreU(hn::Mul(hn::Add(a, b), half_of), kD, mean + c);
    }
    for (; c < width; ++c) {
        const float a = upper[c];
        const float b = lower[c];
        out[c] = (a - b) * 0.5F * scale[c];
        mean[c] = (a + b) * 0.5F;
    }
}

void DecomposeColumns(float* plane, int side, const float* scales) {
    const int width = std::min(side, kStrip);
    HWY_ALIGN Strip means;
    for (int column = 0; column < side; column += width) {
        float* const strip = plane + column;
        for (int i = 0; i < side; ++i) {
            const float* const row = strip + std::ptrdiff_t{i} * side;
            // A length that the compiler knows: no call for each row.
            if (width == kStrip) {
                std::memcpy(means[i].data(), row, sizeof means[i]);
            } else {
                std::copy_n(row, width, means[i].begin());
            }
        }
        for (int half = side / 2; half > 0; half /= 2) {
            const int level = std::bit_width(static_cast<unsigned>(half)) - 1;
            const float* const scale = scales + level * kMaxSide + column;
            for (int i = 0; i < half; ++i) {
                step(means, i, width, scale, strip + std::ptrdiff_t{half + i} * side);
            }
        }
        for (int c = 0; c < width; ++c) strip[c] = means[0][c] * scales[column + c];
    }
}

int PlacesAbove(const float* values, int count, float threshold, std::uint8_t* places) {
    const int lanes = static_cast<int>(hn::Lanes(kD));
    const V limit = hn::Set(kD, threshold);
    int found = 0;
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto above = hn::Gt(hn::Abs(hn::LoadU(kD, values + i)), limit);
        if (hn::AllFalse(kD, above)) continue;
        std::array<std::uint8_t, 8> bytes{};
        hn::StoreMaskBits(kD, above, bytes.data());
        std::uint64_t bits = 0;
        for (std::size_t k = bytes.size(); k-- > 0;) bits = bits << 8 | bytes[k];
        for (; bits != 0; bits &= bits - 1) {
            places[found++] = static_cast<std::uint8_t>(i + std::countr_zero(bits));
        }
    }
    for (; i < count; ++i) {
        if (std::fabs(values[i]) > threshold) {
            places[found++] = static_cast<std::uint8_t>(i);
        }
    }
    return found;
}

}  // namespace HWY_NAMESPACE
}  // namespace haarmony::image
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace haarmony::image {
namespace {

HWY_EXPORT(DecomposeRows);
HWY_EXPORT(DecomposeColumns);
HWY_EXPORT(PlacesAbove);

[[maybe_unused]] bool is_square(std::span<const float> plane, int side) {
    return side >= 1 && side <= kMaxSide && std::has_single_bit(unsigned(side)) &&
           plane.size() == std::size_t(side) * side;
}

}  // namespace

void decompose_rows(std::span<float> plane, int side) {
    assert(is_square(plane, side));
    HWY_DYNAMIC_DISPATCH(DecomposeRows)(plane.data(), side);
}

void decompose_columns(std::span<float> plane, int side, const float* scales) {
    assert(is_square(plane, side));
    HWY_DYNAMIC_DISPATCH(DecomposeColumns)(plane.data(), side, scales);
}

int places_above(std::span<const float> values, float threshold, std::uint8_t* places) {
    assert(values.size() <= 256);
    return HWY_DYNAMIC_DISPATCH(PlacesAbove)(
        values.data(), static_cast<int>(values.size()), threshold, places);
}

}  // namespace haarmony::image
#endif  // HWY_ONCE
