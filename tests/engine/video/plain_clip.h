// The slow, plain way: pictures averaged pixel by pixel from the source, and a clip built of
// them without any sharing. The oracle of engine/video; shares no code with it but the shapes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"
#include "engine/video/memory_clip.h"
#include "engine/video/picture.h"

namespace haarmony::video::testing {

struct RawClip {
    FrameFormat format;
    std::vector<Picture> frames;
};

[[nodiscard]] ClipShape shape_of(const RawClip& clip);

// The cropped picture of a time node at a space level, straight from the definition.
[[nodiscard]] Picture exact_picture(const RawClip& clip,
                                    const NodeAddress& at,
                                    int level,
                                    Edge edge);

// Every node of every level its own, complete trees, no links.
[[nodiscard]] std::unique_ptr<MemoryClip> plain_clip(const RawClip& clip);

// Random pixels, alpha included, with a fixed seed; `coherent` frames change only in a corner.
[[nodiscard]] RawClip random_clip(int width,
                                  int height,
                                  int frames,
                                  std::uint32_t seed,
                                  bool coherent = false);

}  // namespace haarmony::video::testing
