// The inner loops of sums of pixels and of their means. Vector code chosen at run time; all of
// it is integers and gives the same values on every machine.
//   brick.h -> [sum_kernel.h] -> sum_brick.h, sum_tree.h, exact_mean.h
//
// Shape   64 sums of one channel stand together, row-major 8 x 8: planes r, g, b and a.
// Units   sums of colour times alpha, and of alpha (PixelSum). Of opaque pixels: sums of
//         colour alone, and no plane a, since all of them would be 255 times as large.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Threads const-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/video/brick.h"

namespace haarmony::video {

template <typename Sum>
using Planes = std::array<std::array<Sum, kBrickPixels>, 4>;
using SumPlanes = Planes<std::uint32_t>;
// The pixels of a brick as words, red in the lowest byte.
using PixelWords = std::array<std::uint32_t, kBrickPixels>;

// How many samples have sums that mean_of() can divide: all below 2^31.
inline constexpr std::uint64_t kMostSamples = 1U << 15;
inline constexpr std::uint64_t kMostOpaqueSamples = 1U << 23;

// Pixels times `repeats`, put in the place of the sums, or added to them.
void set_pixels(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums);
void add_pixels(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums);
void set_opaque(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums);
void add_opaque(const Brick& pixels, std::uint32_t repeats, SumPlanes& sums);

// Adds the first `planes` planes.
void add_planes(const SumPlanes& added, std::size_t planes, SumPlanes& sums);

// The sums of each 2 x 2 become a quadrant of the square above, whose first is `corner`.
void halve(const SumPlanes& sums,
           std::size_t planes,
           std::size_t corner,
           SumPlanes& above);

// mean() of every sum.
// Requires: 1 <= samples <= kMostSamples, the sums those of no more.
void mean_of(const SumPlanes& sums, std::uint32_t samples, PixelWords& means);
// Requires: 1 <= samples <= kMostOpaqueSamples, the sums those of as many.
void mean_of_opaque(const SumPlanes& sums, std::uint32_t samples, PixelWords& means);

}  // namespace haarmony::video
