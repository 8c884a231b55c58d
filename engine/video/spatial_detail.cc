// Where a frame has more to show than a level does.
#include <algorithm>
#include <cassert>
#include <cstdint>

#include "engine/video/display.h"

namespace haarmony::video {
namespace {

class Search {
  public:
    Search(const Frame& frame, int level, const PixelBox& box)
        : frame_(frame), level_(level), box_(box) {}

    // Levels below kBrickLevel, and the step from them to the root brick.
    [[nodiscard]] bool in_apex() const {
        const int last = std::min(frame_.space_level(), kBrickLevel);
        for (int at = level_; at < last; ++at) {
            const Region region = region_at(at + 1);
            for (std::int32_t y = region.top; y < region.bottom; ++y) {
                for (std::int32_t x = region.left; x < region.right; ++x) {
                    if (coarse(at + 1, x, y) != coarse(at, x >> 1, y >> 1)) return true;
                }
            }
        }
        return false;
    }

    // (x, y) counts the bricks of level `at`.
    [[nodiscard]] bool below(int at, Ref ref, std::int32_t x, std::int32_t y) const {
        if (at == frame_.shape().space_levels()) return false;
        const LinkedNode node = frame_.node(at, ref);
        for (std::int32_t q = 0; q < 4; ++q) {
            const Ref child = node.child[static_cast<std::size_t>(q)];
            const std::int32_t child_x = 2 * x + (q & 1);
            const std::int32_t child_y = 2 * y + (q >> 1);
            if (child == kNoDetailRef) continue;
            const Region part = region_at(at + 1).in_brick(child_x, child_y);
            if (part.empty()) continue;
            if (at + 1 > frame_.space_level()) return true;
            if (at >= level_ && differs(node, at, child, q, part)) return true;
            if (below(at + 1, child, child_x, child_y)) return true;
        }
        return false;
    }

  private:
    struct Region {
        std::int32_t left, top, right, bottom;

        [[nodiscard]] bool empty() const { return right <= left || bottom <= top; }
        // What of it lies in a brick, in pixels of that brick.
        [[nodiscard]] Region in_brick(std::int32_t x, std::int32_t y) const {
            return {std::max(left - x * kBrickSide, 0),
                    std::max(top - y * kBrickSide, 0),
                    std::min(right - x * kBrickSide, kBrickSide),
                    std::min(bottom - y * kBrickSide, kBrickSide)};
        }
    };

    // The box in pixels of another level, without the padding.
    [[nodiscard]] Region region_at(int at) const {
        const std::int32_t width = frame_.shape().width_at(at);
        const std::int32_t height = frame_.shape().height_at(at);
        const std::int32_t right = box_.x + box_.width;
        const std::int32_t bottom = box_.y + box_.height;
        if (at >= level_) {
            const int finer = at - level_;
            return {box_.x << finer,
                    box_.y << finer,
                    std::min(right << finer, width),
                    std::min(bottom << finer, height)};
        }
        const int coarser = level_ - at;
        return {box_.x >> coarser,
                box_.y >> coarser,
                std::min(((right - 1) >> coarser) + 1, width),
                std::min(((bottom - 1) >> coarser) + 1, height)};
    }

    // A pixel of a level up to kBrickLevel.
    [[nodiscard]] Rgba coarse(int at, std::int32_t x, std::int32_t y) const {
        const auto pixel = static_cast<std::size_t>((y << at) + x);
        if (at < kBrickLevel) {
            return frame_.apex(
                Edge::kNormalize)[static_cast<std::size_t>(apex_offset(at)) + pixel];
        }
        const LinkedNode root = frame_.node(kBrickLevel, frame_.root(Edge::kNormalize));
        return frame_.brick(kBrickLevel, root.brick)[pixel];
    }

    // Whether a child's brick differs from the quadrant that it lies in.
    [[nodiscard]] bool differs(const LinkedNode& node,
                               int at,
                               Ref child,
                               std::int32_t q,
                               const Region& part) const {
        const Brick& above = frame_.brick(at, node.brick);
        const Brick& finer = frame_.brick(at + 1, frame_.node(at + 1, child).brick);
        const std::int32_t left = (q & 1) * kBrickSide / 2;
        const std::int32_t top = (q >> 1) * kBrickSide / 2;
        for (std::int32_t y = part.top; y < part.bottom; ++y) {
            for (std::int32_t x = part.left; x < part.right; ++x) {
                const Rgba flat = above[static_cast<std::size_t>(
                    (top + y / 2) * kBrickSide + left + x / 2)];
                if (finer[static_cast<std::size_t>(y * kBrickSide + x)] != flat)
                    return true;
            }
        }
        return false;
    }

    const Frame& frame_;
    int level_;
    PixelBox box_;
};

}  // namespace

bool finer_in_space(const Frame& frame, int level, const PixelBox& box) {
    const int finest = frame.shape().space_levels();
    assert(level >= 0 && level <= finest);
    if (level == finest || box.width == 0 || box.height == 0) return false;
    assert(frame.space_level() > level);
    const Search search(frame, level, box);
    if (search.in_apex()) return true;
    if (finest < kBrickLevel) return frame.space_level() < finest;
    if (frame.space_level() < kBrickLevel) return true;
    return search.below(kBrickLevel, frame.root(Edge::kNormalize), 0, 0);
}

}  // namespace haarmony::video
