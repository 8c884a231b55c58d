// Two fluids, the heavy one above the light one, that change places in a closed tank:
// fine where they meet, coarse elsewhere, in space and in time.
//   refine.h -> [fluid.h] -> generator.h
//
// Errors  none.
// Source  Figure 5.16 ["the resolution of the data is higher at the interface", "this
//         refinement also occurs in time"].
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"

namespace haarmony::video {

[[nodiscard]] Result<std::unique_ptr<FrameSource>> fluid_frames(const Recipe& recipe);

}  // namespace haarmony::video
