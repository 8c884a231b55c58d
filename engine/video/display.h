// A frame drawn: any space level, any region, integer levels and those between.
//   time_tree.h -> [display.h] -> playback.h, panorama.h
//
// Shape   pixel (x, y) of level l is the cropped picture's, width_at(l) x height_at(l).
//         Boxes must lie inside the picture that is drawn.
// Errors  none; an address or box outside is a caller's bug and asserts.
// Cost    proportional to the pixels asked for (and, of a box, the bricks that it touches);
//         the same at every time level.
// Source  sec. 5.3.2, Figure 5.8; "Fractional-level zoom"; ERRATA of the project, video 10,
//         11, 17, 26.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/picture.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

// The pixels of `box` at an integer level, into rows `stride` pixels apart.
// Requires: 0 <= level <= frame.space_level().
void draw(const Frame& frame,
          int level,
          Edge edge,
          const PixelBox& box,
          Rgba* out,
          std::ptrdiff_t stride);
[[nodiscard]] Picture draw(const Frame& frame, int level, Edge edge, const PixelBox& box);
// The whole picture of a level.
[[nodiscard]] Picture draw(const Frame& frame, int level, Edge edge);

inline constexpr std::int32_t kMaxRootSide = 1 << 30;

// The size of the cropped picture when the root square is `root_side` pixels wide: all of
// them that show a part of the picture.
[[nodiscard]] std::int32_t zoomed_width(const ClipShape& shape, std::int32_t root_side);
[[nodiscard]] std::int32_t zoomed_height(const ClipShape& shape, std::int32_t root_side);
// ceil(log2 root_side): the finest level that a zoom reads, at most space_levels.
[[nodiscard]] int zoom_level(const ClipShape& shape, std::int32_t root_side);
// How wide the root square is when the clip is `width` pixels wide: width x 2^L / W, rounded.
// zoomed_width() of it is `width`, or one more: a last pixel that is cropped away.
// Errors: kInvalidArgument (width) where that is not 1 to kMaxRootSide.
[[nodiscard]] Result<std::int32_t> root_side_for_width(const ClipShape& shape,
                                                       std::int64_t width);

// What is drawn where the clip has no finer detail: flat squares, or a smooth surface through
// their centres (sec. 5.6, "antialiasing").
enum class Finer : std::uint8_t { kFlat, kSmooth };

// Fractional-level zoom: the root square root_side pixels wide, colours mixed between the two
// levels around it; the same as draw() where it is 2^level. A root_side above 2^space_levels
// enlarges. With Edge::kNormalize an opaque clip stays opaque up to its edges.
// Requires: 1 <= root_side <= kMaxRootSide, frame.space_level() >= zoom_level().
[[nodiscard]] Picture zoom(const Frame& frame,
                           std::int32_t root_side,
                           Edge edge,
                           const PixelBox& box,
                           Finer finer = Finer::kFlat);

// Whether finer levels than `level` show more than this one does, inside a box of its pixels
// (edges normalized, so that padding is no detail). What the frame does not hold counts as
// detail where the tree goes on; a frame of less than kBrickLevel always says so.
// Requires: frame.space_level() > level or level = space_levels.
[[nodiscard]] bool finer_in_space(const Frame& frame, int level, const PixelBox& box);

// The bounding box of what is not clear, in pixels of a level.
[[nodiscard]] PixelBox bounding_box(const Frame& frame, int level);

}  // namespace haarmony::video
