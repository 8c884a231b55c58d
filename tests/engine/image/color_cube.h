// Colours that stand for all colours.
#pragma once

#include <memory>

#include "engine/image/color_planes.h"

namespace haarmony::image {

// All combinations of 25 levels of R, G and B in [0, 1]: 15,625 of the places, the rest
// black.
[[nodiscard]] std::unique_ptr<ColorPlanes> color_cube();

// The twelve edges of the cube in steps of 1/1024, the rest black.
[[nodiscard]] std::unique_ptr<ColorPlanes> color_cube_edges();

}  // namespace haarmony::image
