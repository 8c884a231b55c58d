#include "tests/engine/video/plain_draw.h"

namespace haarmony::video::testing {

Rgba shown_pixel(const Frame& frame, Edge edge, int level, int x, int y) {
    if (level < kBrickLevel) {
        const int i = apex_offset(level) + (y << level) + x;
        return frame.apex(edge)[static_cast<std::size_t>(i)];
    }
    Ref node = frame.root(edge);
    int at = kBrickLevel;
    for (; at < level; ++at) {
        const int half_x = x >> (level - at) >> 2 & 1;
        const int half_y = y >> (level - at) >> 2 & 1;
        const Ref below =
            frame.node(at, node).child[static_cast<std::size_t>(half_x + 2 * half_y)];
        if (below == kNoDetailRef) break;
        node = below;
    }
    const int u = x >> (level - at) & 7;
    const int v = y >> (level - at) & 7;
    return frame.brick(at,
                       frame.node(at, node).brick)[static_cast<std::size_t>(8 * v + u)];
}

Picture shown_picture(const Frame& frame, int level, Edge edge) {
    Picture picture(frame.shape().width_at(level), frame.shape().height_at(level));
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            picture.at(x, y) = shown_pixel(frame, edge, level, x, y);
        }
    }
    return picture;
}

}  // namespace haarmony::video::testing
