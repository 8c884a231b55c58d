// The pixels of a brick as they are held: colours without their alpha, which most bricks have
// not. Vector code chosen at run time; the same bytes on every machine.
//   brick.h -> [brick_packing.h] -> bricks.h, drawing.h
//
// Shape   colours: 64 times red, green, blue. Alphas: 64, and none at all where every pixel
//         is opaque, so that equal bricks are equal bytes.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Threads const-safe.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/video/brick.h"

namespace haarmony::video {

// Whole cache lines, of which none is shared.
struct alignas(64) BrickColors {
    std::array<std::uint8_t, 3 * kBrickPixels> byte;

    friend bool operator==(const BrickColors&, const BrickColors&) = default;
};
struct alignas(64) BrickAlphas {
    std::array<std::uint8_t, kBrickPixels> byte;

    friend bool operator==(const BrickAlphas&, const BrickAlphas&) = default;
};

// Where a brick is held.
struct PackedBrick {
    const BrickColors* colors = nullptr;
    const BrickAlphas* alphas = nullptr;  // null: opaque
};

// Returns whether the brick is opaque; if so, `alphas` is left as it was.
[[nodiscard]] bool pack(const Brick& brick, BrickColors& colors, BrickAlphas& alphas);

// A brick, and where the first of its pixels is to be put.
struct BrickPut {
    PackedBrick brick;
    Rgba* out = nullptr;
};
// Rows of eight pixels, `stride` pixels apart.
void put_bricks(std::span<const BrickPut> puts, std::ptrdiff_t stride);
// Quadrant q (i + 2 j) with every pixel twice as wide and high: eight rows of eight.
void put_doubled(const PackedBrick& brick, int q, Rgba* out, std::ptrdiff_t stride);

inline void unpack(const PackedBrick& packed, Brick& brick) {
    const BrickPut put{packed, brick.data()};
    put_bricks({&put, 1}, kBrickSide);
}

// Whether they are the same pixels, byte for byte.
[[nodiscard]] bool same_pixels(const PackedBrick& packed, const Brick& brick);
[[nodiscard]] bool same_pixels(const PackedBrick& a, const PackedBrick& b);
[[nodiscard]] bool same_quadrant(const PackedBrick& a, const PackedBrick& b, int q);

}  // namespace haarmony::video
