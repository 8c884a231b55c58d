// Trees at random, and pixels moved one by one: the oracle of engine/video/ops, of which
// it shares no code.
#pragma once

#include <cstdint>

#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"
#include "engine/video/picture.h"

namespace haarmony::video::testing {

// Random squares of random depth, which may be flat where nothing demands it.
[[nodiscard]] ImageTree random_tree(const FrameFormat& format, std::uint32_t seed);

// Whether a quadrant has a child exactly where finer pixels differ from one another.
[[nodiscard]] bool is_pruned(const ImageTree& tree);

// Every pixel repeated across and down, and moved onto a clear canvas.
[[nodiscard]] Picture placed_pixels(const Picture& picture,
                                    int repeat_x,
                                    int repeat_y,
                                    std::int64_t dx,
                                    std::int64_t dy,
                                    const FrameFormat& canvas);

}  // namespace haarmony::video::testing
