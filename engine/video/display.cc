#include "engine/video/display.h"

#include <algorithm>
#include <cassert>

#include "engine/video/drawing.h"

namespace haarmony::video {
namespace {

[[maybe_unused]] bool inside(const PixelBox& box,
                             std::int32_t width,
                             std::int32_t height) {
    return box.x >= 0 && box.y >= 0 && box.width >= 0 && box.height >= 0 &&
           box.width <= width - box.x && box.height <= height - box.y;
}

}  // namespace

void draw(const Frame& frame,
          int level,
          Edge edge,
          const PixelBox& box,
          Rgba* out,
          std::ptrdiff_t stride) {
    assert(level >= 0 && level <= frame.space_level());
    assert(inside(box, frame.shape().width_at(level), frame.shape().height_at(level)));
    if (box.width == 0 || box.height == 0) return;
    if (level >= kBrickLevel) {
        Drawing(frame, level, box, out, stride).tree(kBrickLevel, frame.root(edge), 0, 0);
        return;
    }
    const Rgba* square = frame.apex(edge).data() + apex_offset(level);
    for (std::int32_t y = box.y; y < box.y + box.height; ++y, out += stride) {
        std::copy_n(square + (y << level) + box.x, box.width, out);
    }
}

Picture draw(const Frame& frame, int level, Edge edge, const PixelBox& box) {
    Picture picture(box.width, box.height);
    draw(frame, level, edge, box, picture.pixels.data(), box.width);
    return picture;
}

Picture draw(const Frame& frame, int level, Edge edge) {
    const ClipShape& shape = frame.shape();
    return draw(
        frame, level, edge, {0, 0, shape.width_at(level), shape.height_at(level)});
}

PixelBox bounding_box(const Frame& frame, int level) {
    const Bounds& bounds = frame.time_node().bounds;
    if (bounds.empty()) return {};
    const int below = frame.shape().space_levels() - level;
    assert(level >= 0 && below >= 0);
    const std::int32_t left = bounds.left >> below;
    const std::int32_t top = bounds.top >> below;
    return {left,
            top,
            ((bounds.right - 1) >> below) + 1 - left,
            ((bounds.bottom - 1) >> below) + 1 - top};
}

}  // namespace haarmony::video
