// The quarter turns and mirrorings that a film's display matrix asks for.
//   libav_pixels.h -> [display_matrix.h]
//
// Shape   (x, y) goes to (a x + c y, b x + d y), moved so that nothing is negative; one of
//         a, c and one of b, d is 0, the others are 1 or -1.
// Errors  a matrix that turns by other angles, shears or scales only is no turn at all: how
//         a player would show it is not what the pixels are.
// Threads const-safe.
// Source  ISO/IEC 14496-12, 8.3.2, matrix.
#pragma once

#include <array>
#include <cstdint>

#include "engine/video/picture.h"

namespace haarmony::ingest {

struct Turn {
    int a = 1;
    int b = 0;
    int c = 0;
    int d = 1;

    [[nodiscard]] bool swaps_sides() const { return a == 0; }
    [[nodiscard]] bool is_identity() const { return a == 1 && d == 1; }
    friend bool operator==(const Turn&, const Turn&) = default;
};

// `matrix`: nine numbers as libav gives them; a, b, c, d are the 1st, 2nd, 4th and 5th.
[[nodiscard]] Turn turn_of(const std::array<std::int32_t, 9>& matrix);

// Into `to`, whose storage is used again.
void turn(const video::Picture& from, const Turn& how, video::Picture& to);

}  // namespace haarmony::ingest
