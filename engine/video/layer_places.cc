#include "engine/video/layer_places.h"

#include <array>
#include <cassert>
#include <utility>

namespace haarmony::video {
namespace {

class Walk {
  public:
    explicit Walk(const LayerSurroundings& surroundings) : at_(surroundings) {}

    std::vector<Placed> run() {
        roots();
        for (int level = kBrickLevel; level < at_.space_level; ++level) descend(level);
        return std::move(placed_);
    }

  private:
    int own() const { return at_.address.time_level; }

    // Begins a level: none of its own nodes is placed.
    void enter(int level) { seen_.assign(at_.layer(own(), level).nodes.size(), 0); }

    // Places a node unless it is an ancestor's, or placed already.
    bool takes(Ref ref) {
        if (ref == kNoDetailRef || time_level_of(ref) != own()) return false;
        std::uint8_t& seen = seen_[index_of(ref)];
        return std::exchange(seen, 1) == 0;
    }

    void roots() {
        enter(kBrickLevel);
        for (int half = 0; half < at_.nodes->count; ++half) {
            const TimeNode& time_node = at_.nodes->node[half];
            for (int edge = 0; edge < kEdges; ++edge) {
                const Ref root = time_node.root[edge];
                if (!takes(root)) continue;
                Placed& placed = placed_.emplace_back();
                placed.node = index_of(root);
                if (at_.time_parent != nullptr)
                    placed.parent = {at_.time_parent->root[edge], kBrickLevel};
                if (half == 1)
                    placed.first = {at_.nodes->node[0].root[edge], kBrickLevel};
                if (edge == 1) placed.other_edge = {time_node.root[0], kBrickLevel};
            }
        }
    }

    // What shows the four quadrants of a place one level down: the children, or the same
    // where there is none.
    struct Below {
        Shown over;
        std::array<Ref, 4> child = LinkedNode{}.child;

        [[nodiscard]] Shown quadrant(int q, int level) const {
            if (child[q] == kNoDetailRef) return over;
            return {child[q], level + 1};
        }
    };
    [[nodiscard]] Below below(const Shown& over, int level) const {
        if (!over.any() || over.level < level) return {.over = over};
        return {over, at_.node(level, over.node).child};
    }

    void descend(int level) {
        const std::vector<Placed> above = std::move(placed_);
        placed_.clear();
        enter(level + 1);
        placed_.reserve(seen_.size());
        for (const Placed& over : above) {
            const Shown self{make_ref(own(), over.node), level};
            const LinkedNode node = at_.node(level, self.node);
            const Below parent = below(over.parent, level);
            const Below first = below(over.first, level);
            const Below other_edge = below(over.other_edge, level);
            for (int q = 0; q < 4; ++q) {
                const Ref child = node.child[q];
                if (!takes(child)) continue;
                Placed& placed = placed_.emplace_back();
                placed.node = index_of(child);
                placed.x = 2 * over.x + (q & 1);
                placed.y = 2 * over.y + (q >> 1);
                placed.parent = parent.quadrant(q, level);
                placed.first = first.quadrant(q, level);
                placed.other_edge = other_edge.quadrant(q, level);
                placed.coarse = self;
                placed.parent_coarse = over.parent;
            }
        }
    }

    const LayerSurroundings& at_;
    std::vector<Placed> placed_;
    std::vector<std::uint8_t> seen_;  // of the level at hand
};

}  // namespace

std::vector<Placed> places(const LayerSurroundings& surroundings) {
    return Walk(surroundings).run();
}

void enlarge(const Brick& brick, int levels, std::int32_t x, std::int32_t y, Brick& out) {
    assert(levels >= 1);
    const auto pixel_of = [levels](std::int32_t place, int i) {
        return (place * std::int64_t{kBrickSide} + i) >> levels & (kBrickSide - 1);
    };
    for (int v = 0; v < kBrickSide; ++v) {
        for (int u = 0; u < kBrickSide; ++u)
            out[v * kBrickSide + u] = brick[pixel_of(y, v) * kBrickSide + pixel_of(x, u)];
    }
}

}  // namespace haarmony::video
