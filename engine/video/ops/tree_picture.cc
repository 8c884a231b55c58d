#include "engine/video/ops/tree_picture.h"

#include <algorithm>

#include "engine/video/ops/tree_square.h"

namespace haarmony::video {
namespace {

// `side` pixels of the picture, or of a brick where the root square is smaller than one;
// `shift` halvings lead from those to pixels of the picture.
void paint(const TreeSquare& square,
           std::int32_t left,
           std::int32_t top,
           std::int32_t side,
           int shift,
           Picture& picture) {
    if ((left >> shift) >= picture.width || (top >> shift) >= picture.height) return;
    if (!square.resolved()) {
        for (int q = 0; q < 4; ++q) {
            paint(square.quadrant(q),
                  left + (q & 1) * side / 2,
                  top + (q >> 1) * side / 2,
                  side / 2,
                  shift,
                  picture);
        }
        return;
    }
    const std::int32_t right = std::min((left + side) >> shift, picture.width);
    const std::int32_t bottom = std::min((top + side) >> shift, picture.height);
    const std::int32_t cell = side / square.side();
    for (std::int32_t y = top >> shift; y < bottom; ++y) {
        for (std::int32_t x = left >> shift; x < right; ++x) {
            picture.at(x, y) =
                square.pixel(((x << shift) - left) / cell, ((y << shift) - top) / cell);
        }
    }
}

}  // namespace

Picture tree_picture(const ImageTree& tree, const FrameFormat& format) {
    Picture picture(format.width, format.height);
    const int levels = ClipShape::make(format, 1).value().space_levels();
    const int brick_levels = std::max(levels, kBrickLevel);
    paint(TreeSquare::root_of(tree),
          0,
          0,
          std::int32_t{1} << brick_levels,
          brick_levels - levels,
          picture);
    return picture;
}

}  // namespace haarmony::video
