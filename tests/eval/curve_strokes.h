// Our own strokes for the figures of chapter 3, made by code: the same at every call.
//   [curve_strokes.h] -> figure_3_4.h ... figure_3_13.h
//
// Shape   open curves of level kStrokeLevel; x and y, pen_stroke() thickness as well.
// Units   a page about 1000 wide, y downwards.
// Source  sec. 3.3, 3.4, 3.6: the figures' strokes were drawn by hand.
#pragma once

#include <string_view>
#include <vector>

#include "engine/curve/points.h"

namespace haarmony::eval {

inline constexpr int kStrokeLevel = 8;

// A face seen from the side, by a hand that trembles.
[[nodiscard]] curve::Points profile_stroke();
// An arch with nothing finer than it, for details to be put on.
[[nodiscard]] curve::Points arch_stroke();
// A line that trembles, from left to right.
[[nodiscard]] curve::Points trembling_line();
// A meander most of whose length lies in few segments: u hurries on the right.
[[nodiscard]] curve::Points uneven_stroke();
// A flourish, pressed harder in the middle: x, y, thickness.
[[nodiscard]] curve::Points pen_stroke();

struct DrawingPart {
    std::string_view name;
    std::string_view character;  // built in, that suits it
    int from_level = 0;          // of the character's details
    curve::Points sweep;
};
// A landscape of smooth strokes.
[[nodiscard]] std::vector<DrawingPart> landscape();

}  // namespace haarmony::eval
