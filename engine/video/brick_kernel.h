// The inner loops of predicting bricks and of packing what is left. Vector code chosen at run
// time; all of it is integers and gives the same values on every machine.
//   brick.h -> [brick_kernel.h] -> brick_prediction.h, row_coder.h
//
// Errors  none.
// Threads const-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/video/brick.h"

namespace haarmony::video {

inline constexpr int kPlanes = 4;  // green, red, blue, alpha
inline constexpr int kRows = kPlanes * kBrickSide;

// How large the residuals of a row of eight are: all 0; -1 or 0; -2 .. 1; -4 .. 3; -8 .. 7;
// any. They are packed into as many bytes as kRowBytes says: in 0, 1, 2, 4, 4 and 8 bits
// each, as two's complement, the leftmost lowest.
inline constexpr int kRowClasses = 6;
inline constexpr std::array<std::uint8_t, kRowClasses> kRowBytes = {0, 1, 2, 4, 4, 8};

// The residuals of a brick by plane and row.
struct PackedRows {
    std::array<std::uint64_t, kRows> bytes;  // of which the first kRowBytes count
    std::array<std::uint64_t, kRows> row_class;
};
using Residuals = std::array<std::uint8_t, kPlanes * kBrickPixels>;  // modulo 256

// The sum of the magnitudes of a - b modulo 256, as -128 .. 127, over all channels.
[[nodiscard]] std::uint32_t deviation(const Brick& a, const Brick& b);

// base + to - from, within 0 .. 255, channel by channel.
void shift(const Brick& base, const Brick& to, const Brick& from, Brick& out);

// A quadrant with twice the detail, guessed: each pixel is 3/4 the one it lies in and 1/4 the
// nearest one beside it in the brick, across and then down.
void smooth(const Brick& coarse, int quadrant, Brick& out);

// What pack_residuals() found.
struct Left {
    bool follows_green = false;
    bool opaque = false;  // the brick
    bool colors = false;  // any residuals of green, red or blue
    bool alpha = false;   // any of alpha
};
// brick - predicted, for red and blue less green's where that makes them smaller. Clear pixels
// have no residuals of colour.
[[nodiscard]] Left pack_residuals(const Brick& brick,
                                  const Brick& predicted,
                                  PackedRows& rows);
// The brick again. `opaque`: every alpha is 255, whatever was predicted.
void add_residuals(const Residuals& residuals,
                   const Brick& predicted,
                   bool follows_green,
                   bool opaque,
                   Brick& brick);

}  // namespace haarmony::video
