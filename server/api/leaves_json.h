// Frames of an adaptive source in JSON: [{"leaves": [[level, x, y, r, g, b, a], ...],
// "repeats": n}, ...].
//
// Errors   400 for what has another type or another name; 422 for leaves that no frame can
//          have, and for more frames than a clip has. Both name the place.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "engine/video/clip_shape.h"
#include "server/api/outcome.h"

namespace haarmony::server {

struct LeafFramesIn {
    video::FrameFormat format;
    std::vector<std::byte> bytes;  // server/app/leaf_frames.h
};

// A side of `format` that is 0 becomes the square of the deepest leaf. Every frame is made
// once, to see that it can be.
[[nodiscard]] Outcome<LeafFramesIn> read_leaf_frames(const nlohmann::json& frames,
                                                     video::FrameFormat format);

}  // namespace haarmony::server
