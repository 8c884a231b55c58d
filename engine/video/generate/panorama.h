// All around a square room: windows with moving clouds, doors, and a picture on a wall
// that is the video of another room.
//   scene.h, room.h, compose.h -> [panorama.h] -> generator.h
//
// Shape   the width is 360 degrees, periodic; what is vertical stays vertical.
// Errors  none of its own; what composing meets.
// Source  Figure 5.18, sec. 5.4.5 [a cylindrical projection].
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"

namespace haarmony::video {

[[nodiscard]] Result<std::unique_ptr<FrameSource>> panorama_frames(const Recipe& recipe);

}  // namespace haarmony::video
