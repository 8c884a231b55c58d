// Pictures enlarged, turned and moved, as the robustness tests do it.
//
// Shape   the result has the size of the picture. Each of its pixels is read at the inverse
//         place, between the four nearest pixel centres; what lies outside the picture is
//         its average colour.
// Units   lengths in pixels, angles in degrees, counter-clockwise.
// Errors  none; a factor below 1 is a caller's bug and asserts.
// Source  sec. 4.5.3.
#pragma once

#include <array>

#include "tests/eval/degrade.h"

namespace haarmony::eval {

[[nodiscard]] std::array<double, 3> average_colour(const RgbPicture& picture);

// Enlarged about the centre; what then lies outside the frame is cut off.
// Requires: factor >= 1.
[[nodiscard]] RgbPicture enlarge(const RgbPicture& picture, double factor);

[[nodiscard]] RgbPicture rotate(const RgbPicture& picture, double degrees);

// To the right by dx, down by dy.
[[nodiscard]] RgbPicture translate(const RgbPicture& picture, double dx, double dy);

}  // namespace haarmony::eval
