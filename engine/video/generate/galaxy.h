// A galaxy of stars that is swept past heavy bodies and ripped apart: points of light on
// black, with detail nowhere else.
//   create_frame.h -> [galaxy.h] -> generator.h
//
// Errors  none.
// Source  Figure 5.17; stars without mass around moving bodies, by leapfrog integration.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"

namespace haarmony::video {

[[nodiscard]] Result<std::unique_ptr<FrameSource>> galaxy_frames(const Recipe& recipe);

}  // namespace haarmony::video
