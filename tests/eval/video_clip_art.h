// Clip-art on a photo: a still background with the grain of a camera, and one small object
// that moves across it.
//   lattice_noise.h -> [video_clip_art.h] -> video_clips.h
//
// Shape   side x side, opaque; the object is a disc with a soft edge, 1/16 as wide.
// Source  sec. 5.4.4 ["video clip-art"]; the background must not be flat, or pruning alone
//         would do what up-links are for.
#pragma once

#include <cstdint>

#include "tests/eval/video_clips.h"

namespace haarmony::eval {

// The same at every call. Requires: side >= 16, frames >= 1.
[[nodiscard]] VideoClip make_clip_art(std::int32_t side, std::int64_t frames);

}  // namespace haarmony::eval
