// One bit for each pixel of a brick, and how bricks one level apart correspond.
//   brick.h -> [pixel_mask.h] -> brick_match.h, accounting.h
//
// Shape   64 bits: bit 8 y + x. 16 bits, of a quadrant: bit 4 y + x. Pixel (x, y) of a
//         quadrant has the four pixels (2x, 2y) .. (2x + 1, 2y + 1) of the brick below it.
// Errors  none.
// Source  sec. 5.2.1: parent and child image nodes, for 64 at once.
#pragma once

#include <cstdint>

namespace haarmony::video {

using PixelMask = std::uint64_t;
using QuadrantMask = std::uint16_t;

// Quadrant q of a mask, and a mask that has it there and is zero elsewhere.
[[nodiscard]] constexpr QuadrantMask quadrant_of(PixelMask mask, int q) {
    std::uint64_t rows = mask >> (4 * (q & 1) + 32 * (q >> 1)) & 0x0F0F'0F0F;
    rows = (rows | rows >> 4) & 0x00FF'00FF;
    return static_cast<QuadrantMask>(rows | rows >> 8);
}
[[nodiscard]] constexpr PixelMask in_quadrant(QuadrantMask quadrant, int q) {
    std::uint64_t rows = quadrant;
    rows = (rows | rows << 8) & 0x00FF'00FF;
    rows = (rows | rows << 4) & 0x0F0F'0F0F;
    return rows << (4 * (q & 1) + 32 * (q >> 1));
}

// Bit (x, y) of the parents: whether all four below are set.
[[nodiscard]] constexpr QuadrantMask all_of_four(PixelMask below) {
    std::uint64_t bits = below & below >> 1;
    bits = bits & bits >> 8 & 0x0055'0055'0055'0055;
    bits = (bits | bits >> 1) & 0x0033'0033'0033'0033;
    bits = (bits | bits >> 2) & 0x000F'000F'000F'000F;
    bits = (bits | bits >> 12) & 0x0000'00FF'0000'00FF;
    return static_cast<QuadrantMask>(bits | bits >> 24);
}
[[nodiscard]] constexpr QuadrantMask any_of_four(PixelMask below) {
    return static_cast<QuadrantMask>(~all_of_four(~below));
}
// Every bit of the parents, four times below.
[[nodiscard]] constexpr PixelMask four_of_each(QuadrantMask above) {
    std::uint64_t bits = above;
    bits = (bits | bits << 24) & 0x0000'00FF'0000'00FF;
    bits = (bits | bits << 12) & 0x000F'000F'000F'000F;
    bits = (bits | bits << 2) & 0x0033'0033'0033'0033;
    bits = (bits | bits << 1) & 0x0055'0055'0055'0055;
    bits |= bits << 1;
    return bits | bits << 8;
}

}  // namespace haarmony::video
