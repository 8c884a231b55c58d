// Frames from pixels: a picture, or squares of different sizes (an adaptive source).
//   [create_frame.h] -> frame_source.h -> build.h
//
// Shape    pixels row-major straight RGBA; a leaf (level, x, y) fills square (x, y) of the
//          2^level x 2^level squares that the root square is divided into.
// Errors   kInvalidArgument names the leaf that lies outside, overlaps another, or is deeper
//          than the root square allows; the tree is then what it was. A leaf across the edge
//          of the picture is cut there.
// Source   sec. 5.3.1, Figure 5.6, CreateFrame(); "sample source material at different levels
//          of detail in different parts of a frame".
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/image_view.h"
#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"

namespace haarmony::video {

// Requires: picture.channels is 4 (straight alpha) or 3 (opaque), its size the format's.
// Flat regions cost no detail.
void create_frame(const ImageView& picture, ImageTree& tree);

struct LeafSquare {
    int level = 0;
    std::int32_t x = 0;
    std::int32_t y = 0;
    Rgba color;
};

// What no leaf covers is clear. `space_levels` are those of the clip.
[[nodiscard]] Result<void> create_frame(std::span<const LeafSquare> leaves,
                                        const FrameFormat& format,
                                        ImageTree& tree);

}  // namespace haarmony::video
