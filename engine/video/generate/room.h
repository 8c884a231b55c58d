// A painted room with clip-art: a clock, a bee, and a television that shows Julia sets.
//   scene.h, julia.h, compose.h -> [room.h] -> generator.h
//
// Errors  none of its own; what composing meets.
// Source  Figure 5.14: a still background, composed with clips of other depth and size.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"

namespace haarmony::video {

[[nodiscard]] Result<std::unique_ptr<FrameSource>> room_frames(const Recipe& recipe);

}  // namespace haarmony::video
