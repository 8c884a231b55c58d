// Small pictures from integer arithmetic alone, so that a golden file made on one machine
// holds on every other.
//
// Shape   96 x 64 or 64 x 96 pixels: a gradient, then some rectangles and discs.
#pragma once

#include "tests/eval/degrade.h"

namespace haarmony::golden {

[[nodiscard]] eval::RgbPicture scene(int number);

}  // namespace haarmony::golden
