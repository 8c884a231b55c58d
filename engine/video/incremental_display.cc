#include "engine/video/incremental_display.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/video/display.h"
#include "engine/video/drawing.h"

namespace haarmony::video {
namespace {

PixelBox around(const PixelBox& a, const PixelBox& b) {
    if (a.width == 0 || a.height == 0) return b;
    if (b.width == 0 || b.height == 0) return a;
    const std::int32_t left = std::min(a.x, b.x);
    const std::int32_t top = std::min(a.y, b.y);
    return {left,
            top,
            std::max(a.x + a.width, b.x + b.width) - left,
            std::max(a.y + a.height, b.y + b.height) - top};
}

PixelBox common(const PixelBox& a, const PixelBox& b) {
    const std::int32_t left = std::max(a.x, b.x);
    const std::int32_t top = std::max(a.y, b.y);
    const std::int32_t right = std::min(a.x + a.width, b.x + b.width);
    const std::int32_t bottom = std::min(a.y + a.height, b.y + b.height);
    if (right <= left || bottom <= top) return {};
    return {left, top, right - left, bottom - top};
}

class Changes {
  public:
    Changes(const Frame& shown,
            const Frame& next,
            int level,
            const PixelBox& box,
            Rgba* out,
            std::ptrdiff_t stride)
        : shown_(shown),
          next_(next),
          level_(level),
          shared_(Frame::last_shared_level(shown, next)),
          box_(box),
          drawing_(next, level, box, out, stride) {}

    void tree(int at, Ref before, Ref after, std::int32_t x, std::int32_t y) {
        if (same(before, after)) return;
        const LinkedNode old_node = shown_.node(at, before);
        const LinkedNode new_node = next_.node(at, after);
        const PackedBrick old_brick = shown_.packed(at, old_node.brick);
        const PackedBrick new_brick = next_.packed(at, new_node.brick);
        if (at == level_) {
            if (same(old_node.brick, new_node.brick) || same_pixels(old_brick, new_brick))
                return;
            drawing_.brick(new_brick, x, y);
            note(x, y, kBrickSide);
            return;
        }
        const int shift = level_ - at;
        const std::int32_t half = kBrickSide / 2 << shift;
        for (unsigned q = 0; q < 4; ++q) {
            const std::int32_t child_x = x + ((q & 1) != 0 ? half : 0);
            const std::int32_t child_y = y + ((q & 2) != 0 ? half : 0);
            if (!drawing_.touches(child_x, child_y, half)) continue;
            const Ref old_child = old_node.child[q];
            const Ref new_child = new_node.child[q];
            if (old_child != kNoDetailRef && new_child != kNoDetailRef) {
                tree(at + 1, old_child, new_child, child_x, child_y);
            } else if (new_child != kNoDetailRef) {
                drawing_.tree(at + 1, new_child, child_x, child_y);
                note(child_x, child_y, half);
            } else if (old_child != kNoDetailRef ||
                       !same_quadrant(old_brick, new_brick, static_cast<int>(q))) {
                drawing_.flat(new_brick, q, child_x, child_y, shift);
                note(child_x, child_y, half);
            }
        }
    }

    [[nodiscard]] Redrawn redrawn() const { return {drawing_.squares(), redrawn_}; }

  private:
    [[nodiscard]] bool same(Ref before, Ref after) const {
        return before == after && time_level_of(before) <= shared_;
    }
    void note(std::int32_t x, std::int32_t y, std::int32_t side) {
        redrawn_ = around(redrawn_, common(box_, {x, y, side, side}));
    }

    const Frame& shown_;
    const Frame& next_;
    int level_;
    int shared_;
    PixelBox box_;
    Drawing drawing_;
    PixelBox redrawn_;
};

// Below kBrickLevel a pixel is a square.
Redrawn draw_changed_apex(const Frame& shown,
                          const Frame& next,
                          int level,
                          Edge edge,
                          const PixelBox& box,
                          Rgba* out,
                          std::ptrdiff_t stride) {
    const Rgba* before = shown.apex(edge).data() + apex_offset(level);
    const Rgba* after = next.apex(edge).data() + apex_offset(level);
    Redrawn redrawn;
    for (std::int32_t y = box.y; y < box.y + box.height; ++y) {
        for (std::int32_t x = box.x; x < box.x + box.width; ++x) {
            const std::int32_t i = (y << level) + x;
            if (before[i] == after[i]) continue;
            out[(y - box.y) * stride + (x - box.x)] = after[i];
            ++redrawn.squares;
            redrawn.box = around(redrawn.box, {x, y, 1, 1});
        }
    }
    return redrawn;
}

}  // namespace

Redrawn draw_changes(const Frame& shown,
                     const Frame& next,
                     int level,
                     Edge edge,
                     const PixelBox& box,
                     Rgba* out,
                     std::ptrdiff_t stride) {
    assert(shown.shape() == next.shape());
    assert(level >= 0 && level <= std::min(shown.space_level(), next.space_level()));
    // Outside both bounding boxes both frames are clear.
    const PixelBox part =
        common(box, around(bounding_box(shown, level), bounding_box(next, level)));
    if (part.width == 0) return {};
    out += (part.y - box.y) * stride + (part.x - box.x);
    if (level < kBrickLevel) {
        return draw_changed_apex(shown, next, level, edge, part, out, stride);
    }
    Changes changes(shown, next, level, part, out, stride);
    changes.tree(kBrickLevel, shown.root(edge), next.root(edge), 0, 0);
    return changes.redrawn();
}

Redrawn IncrementalDisplay::show(Frame frame) {
    Redrawn redrawn;
    if (shown_) {
        redrawn = draw_changes(
            *shown_, frame, level_, edge_, box_, picture_.pixels.data(), box_.width);
    } else if (level_ < kBrickLevel) {
        draw(frame, level_, edge_, box_, picture_.pixels.data(), box_.width);
        redrawn = {std::int64_t{box_.width} * box_.height, box_};
    } else {
        Drawing drawing(frame, level_, box_, picture_.pixels.data(), box_.width);
        drawing.tree(kBrickLevel, frame.root(edge_), 0, 0);
        redrawn = {drawing.squares(), box_};
    }
    shown_.emplace(std::move(frame));
    return redrawn;
}

}  // namespace haarmony::video
