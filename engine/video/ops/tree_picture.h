// A tree drawn: every pixel of its finest level.
//   image_tree.h -> [tree_picture.h] -> preview.h
//
// Errors  none; a wrong shape is a caller's bug and asserts.
// Cost    linear in the pixels.
#pragma once

#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"
#include "engine/video/picture.h"

namespace haarmony::video {

// Requires: `tree` is a frame of `format`.
[[nodiscard]] Picture tree_picture(const ImageTree& tree, const FrameFormat& format);

}  // namespace haarmony::video
