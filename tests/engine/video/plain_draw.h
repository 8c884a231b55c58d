// A frame of a clip drawn pixel by pixel, each found from the root: slow, and not display.h.
#pragma once

#include "engine/video/picture.h"
#include "engine/video/time_tree.h"

namespace haarmony::video::testing {

// Pixel (x, y) of a level.
[[nodiscard]] Rgba shown_pixel(const Frame& frame, Edge edge, int level, int x, int y);
// The cropped picture of a level.
[[nodiscard]] Picture shown_picture(const Frame& frame, int level, Edge edge);

}  // namespace haarmony::video::testing
