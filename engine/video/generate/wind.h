// A field of vectors that changes everywhere and always: hue is direction, value is
// magnitude, which is small over continents.
//   refine.h -> [wind.h] -> generator.h
//
// Errors  none.
// Source  Figure 5.15 ["the emergence of the dark continents" in the root time node].
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"

namespace haarmony::video {

[[nodiscard]] Result<std::unique_ptr<FrameSource>> wind_frames(const Recipe& recipe);

}  // namespace haarmony::video
