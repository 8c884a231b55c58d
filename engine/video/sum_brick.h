// The sums of the 64 pixels of a brick over many frames, as narrow as they may be.
//   brick.h -> [sum_brick.h] -> sum_kernel.h, sum_tree.h
//
// Shape   planes r, g, b and a of 64 sums, row-major 8 x 8.
// Units   narrow and wide: sums of colour times alpha, and of alpha (PixelSum). Short: all
//         pixels were opaque; sums of colour alone, and no plane a.
// Errors  none; a wrong argument is a caller's bug and asserts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/video/brick.h"
#include "engine/video/pixel.h"

namespace haarmony::video {

template <typename Sum>
using SumPlane = std::array<Sum, kBrickPixels>;

using ShortSums = std::array<SumPlane<std::uint16_t>, 3>;
using NarrowSums = std::array<SumPlane<std::uint32_t>, 4>;
using WideSums = std::array<SumPlane<std::uint64_t>, 4>;

enum class SumWidth : std::uint8_t { kShort, kNarrow, kWide };

// How many frames have sums so short: 255 * 257 < 2^16, 255 * 255 * 2^15 < 2^31.
inline constexpr std::uint64_t kMostShortFrames = 257;
inline constexpr std::uint64_t kMostNarrowFrames = 1U << 15;

// Sum i of so many frames.
[[nodiscard]] inline PixelSum sum_at(const Brick& pixels,
                                     std::uint64_t frames,
                                     std::size_t i) {
    return sum_of(pixels[i], frames);
}
[[nodiscard]] inline PixelSum sum_at(const ShortSums& sums,
                                     std::uint64_t frames,
                                     std::size_t i) {
    return {255U * sums[0][i], 255U * sums[1][i], 255U * sums[2][i], 255 * frames};
}
template <typename Sum>
[[nodiscard]] PixelSum sum_at(const std::array<SumPlane<Sum>, 4>& sums,
                              std::uint64_t /*frames*/,
                              std::size_t i) {
    return {sums[0][i], sums[1][i], sums[2][i], sums[3][i]};
}

// Adds so many frames, one sum after the other.
template <typename Addend, typename Sum>
void add_each(const Addend& added,
              std::uint64_t frames,
              std::array<SumPlane<Sum>, 4>& sums) {
    for (std::size_t i = 0; i < kBrickPixels; ++i) {
        const PixelSum sum = sum_at(added, frames, i);
        sums[0][i] += static_cast<Sum>(sum.r);
        sums[1][i] += static_cast<Sum>(sum.g);
        sums[2][i] += static_cast<Sum>(sum.b);
        sums[3][i] += static_cast<Sum>(sum.a);
    }
}

template <typename Sum, std::size_t N>
void add_planes(const std::array<SumPlane<Sum>, N>& added,
                std::array<SumPlane<Sum>, N>& sums) {
    for (std::size_t plane = 0; plane < N; ++plane) {
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            sums[plane][i] = static_cast<Sum>(sums[plane][i] + added[plane][i]);
        }
    }
}

// The sum of the 2 x 2 sums at (2 x, 2 y) of a square with rows of `side`.
[[nodiscard]] inline PixelSum sum_of_four(const PixelSum* sums,
                                          std::size_t side,
                                          std::size_t x,
                                          std::size_t y) {
    const PixelSum* const upper = sums + 2 * y * side + 2 * x;
    PixelSum sum = upper[0];
    sum += upper[1];
    sum += upper[side];
    sum += upper[side + 1];
    return sum;
}

// Where quadrant q of a brick begins.
[[nodiscard]] constexpr std::size_t quadrant_corner(std::size_t q) {
    constexpr std::size_t kHalf = kBrickSide / 2;
    return (q >> 1) * kHalf * kBrickSide + (q & 1) * kHalf;
}

// A quadrant of 8 x 8 values with twice the detail.
template <typename Value>
[[nodiscard]] std::array<Value, kBrickPixels> quadrant_of(
    const std::array<Value, kBrickPixels>& values,
    std::size_t quadrant) {
    const Value* const corner = &values[quadrant_corner(quadrant)];
    std::array<Value, kBrickPixels> finer;
    for (std::size_t y = 0; y < kBrickSide; ++y) {
        for (std::size_t x = 0; x < kBrickSide; ++x) {
            finer[y * kBrickSide + x] = corner[y / 2 * kBrickSide + x / 2];
        }
    }
    return finer;
}
template <typename Sum, std::size_t N>
[[nodiscard]] std::array<SumPlane<Sum>, N> quadrant_of(
    const std::array<SumPlane<Sum>, N>& planes,
    std::size_t quadrant) {
    std::array<SumPlane<Sum>, N> finer;
    for (std::size_t plane = 0; plane < N; ++plane) {
        finer[plane] = quadrant_of(planes[plane], quadrant);
    }
    return finer;
}

}  // namespace haarmony::video
