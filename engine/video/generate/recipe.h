// What a generator is asked to make, within its limits.
//   generator.h -> [recipe.h] -> julia.h, galaxy.h, ...
#pragma once

#include <cstdint>

#include "engine/video/clip_shape.h"

namespace haarmony::video {

struct Recipe {
    FrameFormat format;
    std::int64_t frames = 1;
    int depth = 3;  // the finest space level that is painted
    std::uint32_t seed = 1;
};

}  // namespace haarmony::video
