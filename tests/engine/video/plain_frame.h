// Exact frames from the oracle, and shown ones as exact ones.
#pragma once

#include "engine/video/image_tree.h"
#include "engine/video/time_tree.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video::testing {

// What a frame shows, pruned without loss; the two trees share nothing.
// Requires: the frame's finest level is the clip's, which is at least 3.
[[nodiscard]] ExactFrame as_exact(const Frame& frame);

// The exact frame of a time node, straight from the definition.
[[nodiscard]] ExactFrame exact_frame(const RawClip& clip, const NodeAddress& at);

}  // namespace haarmony::video::testing
