// Julia sets of a parameter that moves, deeper the nearer their boundary is.
//   refine.h -> [julia.h] -> generator.h
//
// Errors  none.
// Source  Figure 5.13 ["with higher spatial resolution in places of higher detail"]; the
//         distance estimate |z| ln |z| / |dz|.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"

namespace haarmony::video {

[[nodiscard]] Result<std::unique_ptr<FrameSource>> julia_frames(const Recipe& recipe);

}  // namespace haarmony::video
