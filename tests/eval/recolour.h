// Pictures with other colours in the same places.
//
// Units   colours normalised to [0, 1]; what leaves that range is clamped.
// Source  sec. 4.5.3 (colour shifts).
#pragma once

#include <array>

#include "tests/eval/degrade.h"

namespace haarmony::eval {

// The same step added to every pixel.
[[nodiscard]] RgbPicture shift_colours(const RgbPicture& picture,
                                       const std::array<double, 3>& step);

// factor * value ^ gamma.
[[nodiscard]] RgbPicture tone(const RgbPicture& picture, double factor, double gamma);

// The distance from the pixel's own grey times `factor`: 0 makes it grey.
[[nodiscard]] RgbPicture saturate(const RgbPicture& picture, double factor);

// Each channel to the nearest of `levels` even steps. Requires: levels >= 2.
[[nodiscard]] RgbPicture posterize(const RgbPicture& picture, int levels);

// R = G = B, the luma of the pixel (0.299, 0.587, 0.114).
[[nodiscard]] RgbPicture to_grey(const RgbPicture& picture);

}  // namespace haarmony::eval
