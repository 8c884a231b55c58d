// 8 x 8 pixels: the grain in which image trees are stored, compared, shared and drawn.
//
// Shape   row-major, origin top left. The dissertation's leaves are single pixels; bricks
//         cost the same memory and draw ten times faster (ARCHITECTURE.md).
//         Quadrant q = i + 2 j of a brick is its 4 x 4 pixels at x = 4 i, y = 4 j; the brick
//         below that quadrant shows the same square with twice the detail.
#pragma once

#include <array>
#include <cstdint>

#include "engine/video/pixel.h"

namespace haarmony::video {

inline constexpr int kBrickSide = 8;
inline constexpr int kBrickLevel = 3;  // log2 of the side
inline constexpr int kBrickPixels = kBrickSide * kBrickSide;

using Brick = std::array<Rgba, kBrickPixels>;

// The space levels 0, 1 and 2 of a frame: 1, 4 and 16 pixels, each level row-major.
inline constexpr int kApexPixels = 1 + 4 + 16;
using Apex = std::array<Rgba, kApexPixels>;

// Where level 0, 1 or 2 begins in an apex.
[[nodiscard]] constexpr int apex_offset(int level) {
    return level == 0 ? 0 : level == 1 ? 1 : 5;
}

}  // namespace haarmony::video
