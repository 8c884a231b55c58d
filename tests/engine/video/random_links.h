// Clips whose nodes and bricks are linked at random, in every way that a layer allows: to
// themselves, to any time-ancestor, several times, or from nowhere. Not what a build makes of
// pictures: what a file must keep whatever a build makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/video/layer.h"

namespace haarmony::video::testing {

struct LinkedClip {
    ClipShape shape;
    std::uint32_t delta = 0;
    std::vector<Siblings> siblings;  // parents before their children
};

[[nodiscard]] LinkedClip linked_clip(int width,
                                     int height,
                                     int frames,
                                     std::uint32_t seed);

// The .mrv file that a writer makes of the siblings.
[[nodiscard]] std::vector<std::byte> mrv_bytes(const LinkedClip& clip);

// The checksum of the newest slot of the header, as a writer would have put it.
void seal_header(std::vector<std::byte>& file);
// Those of the indexes, of the table of generations and of the newest slot.
void seal_front(std::vector<std::byte>& file);

}  // namespace haarmony::video::testing
