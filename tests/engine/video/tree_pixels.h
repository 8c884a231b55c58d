// Pixels of trees, looked up one by one, and trees of squares, drawn at random.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/video/create_frame.h"
#include "engine/video/image_tree.h"
#include "engine/video/picture.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video::testing {

// The finest level of a format's trees: its space levels, but at least 3.
[[nodiscard]] int finest_level(const FrameFormat& format);

// Pixel (x, y) of the finest level.
[[nodiscard]] Rgba pixel_of(const ImageTree& tree, int finest, int x, int y);
// Pixel (x, y) of any level.
[[nodiscard]] Rgba pixel_of(const ExactFrame& frame, Edge edge, int level, int x, int y);

// The frame's picture, cropped. Of formats below 8 x 8 one pixel for each square.
[[nodiscard]] Picture picture_of(const ImageTree& tree, const FrameFormat& format);
// The cropped picture of a space level.
[[nodiscard]] Picture picture_of(const ExactFrame& frame,
                                 const FrameFormat& format,
                                 int level,
                                 Edge edge);

// Disjoint squares of many sizes in any order, some of the picture left out; none begins
// outside the picture.
[[nodiscard]] std::vector<LeafSquare> random_leaves(const FrameFormat& format,
                                                    std::uint32_t seed);
// The same painted on a picture.
[[nodiscard]] Picture painted(const std::vector<LeafSquare>& leaves,
                              const FrameFormat& format);

// Frames of such squares, another for each: flat places, of other depths in every frame.
[[nodiscard]] RawClip blocks(int width, int height, int frames, std::uint32_t seed);
[[nodiscard]] RawClip opaque(RawClip clip);

[[nodiscard]] ImageTree tree_of(const Picture& picture);
// Of all frames of a clip.
[[nodiscard]] ExactFrame mean_of(const RawClip& clip);

}  // namespace haarmony::video::testing
