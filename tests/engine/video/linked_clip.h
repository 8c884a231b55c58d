// A clip as a build leaves it: pruned where finer levels show nothing new, linked to its
// time-ancestors where nothing differs from them, no siblings where nothing moves. Made of
// plain_clip() by comparing whole subtrees.
#pragma once

#include <cstdint>
#include <memory>

#include "tests/engine/video/plain_clip.h"

namespace haarmony::video::testing {

[[nodiscard]] std::unique_ptr<MemoryClip> linked_clip(const RawClip& clip);

// A sprite that moves over a still picture with textured, flat and clear parts, and rests now
// and then.
[[nodiscard]] RawClip moving_clip(int width, int height, int frames, std::uint32_t seed);

}  // namespace haarmony::video::testing
