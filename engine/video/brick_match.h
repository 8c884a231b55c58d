// Bricks compared with one another: byte for byte, within a bound, and by hash.
//   brick.h, pixel_mask.h -> [brick_match.h] -> near_match.h, up_links.h, accounting.h
//
// Errors   none.
// Threads  const-thread-safe.
// Source   sec. 5.3.1, ColorDiff(); ERRATA of the project, video 12, 13.
#pragma once

#include <cstdint>
#include <cstring>

#include "engine/video/brick.h"
#include "engine/video/pixel_mask.h"

namespace haarmony::video {

[[nodiscard]] inline bool same_bytes(const Brick& a, const Brick& b) {
    static_assert(sizeof(Brick) == 4 * kBrickPixels);
    return std::memcmp(&a, &b, sizeof(Brick)) == 0;
}

// Whether every pixel of `a` differs from that of `b` by at most `delta` (difference()).
[[nodiscard]] bool within(const Brick& a, const Brick& b, std::uint32_t delta);

// Of the 256 bytes; the same on every machine of one byte order.
[[nodiscard]] std::uint64_t hash_of(const Brick& brick);

// Quadrant q (i + 2 j) with every pixel twice as wide and high: what lies below it where it
// has no finer detail.
[[nodiscard]] Brick enlarged_quadrant(const Brick& brick, int q);

// Which pixels are the same in both.
[[nodiscard]] PixelMask equal_pixels(const Brick& a, const Brick& b);

// Which pixels of quadrant q are what all four of `below`, the brick below it, are.
[[nodiscard]] QuadrantMask repeated_pixels(const Brick& brick, int q, const Brick& below);

}  // namespace haarmony::video
