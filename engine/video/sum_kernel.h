// The inner loops of sums of pixels and of their means. Vector code chosen at run time; all of
// it is integers and gives the same values on every machine.
//   sum_brick.h -> [sum_kernel.h] -> sum_tree.h, exact_mean.h
//
// Errors  none; a wrong argument is a caller's bug and asserts.
// Threads const-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/video/sum_brick.h"

namespace haarmony::video {

// The pixels of a brick as words, red in the lowest byte.
using PixelWords = std::array<std::uint32_t, kBrickPixels>;

// Adds pixels times `repeats`. Requires: the sums have room for them; opaque pixels.
void add_opaque(const Brick& pixels, std::uint32_t repeats, ShortSums& sums);
// Requires: the sums have room for them.
void add_pixels(const Brick& pixels, std::uint32_t repeats, NarrowSums& sums);

// How many samples have sums that mean_of() can divide: below 2^31.
inline constexpr std::uint64_t kMostSamples = 1U << 15;
inline constexpr std::uint64_t kMostOpaqueSamples = 1U << 23;

// mean() of every sum.
// Requires: 1 <= samples <= kMostSamples, the sums those of no more.
void mean_of(const NarrowSums& sums, std::uint32_t samples, PixelWords& means);
// Of opaque pixels: sums of colour alone; plane a is not read.
// Requires: 1 <= samples <= kMostOpaqueSamples, the sums those of as many.
void mean_of_opaque(const NarrowSums& sums, std::uint32_t samples, PixelWords& means);

// The same sums of colour, with more room.
void widen(const ShortSums& sums, NarrowSums& wider);

// The sums of each 2 x 2, of the first `planes` planes, become a quadrant of the square above,
// whose first is `corner`.
void halve(const NarrowSums& sums,
           std::size_t planes,
           std::size_t corner,
           NarrowSums& above);

}  // namespace haarmony::video
