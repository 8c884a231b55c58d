#include "engine/video/layer_places.h"

#include <cassert>

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

    // Places a node unless it is an ancestor's, or placed already.
    bool takes(Ref ref) {
        if (ref == kNoDetailRef || time_level_of(ref) != own()) return false;
        const std::uint32_t index = index_of(ref);
        if (index >= seen_.size()) seen_.resize(index + 1);
        if (seen_[index]) return false;
        seen_[index] = true;
        return true;
    }

    void roots() {
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

    // The node below quadrant q, or the same one where it has none.
    Shown below(const Shown& shown, int level, int q) const {
        if (!shown.any() || shown.level < level) return shown;
        const Ref child = at_.node(level, shown.node).child[q];
        return child == kNoDetailRef ? shown : Shown{child, level + 1};
    }

    void descend(int level) {
        std::vector<Placed> above = std::move(placed_);
        placed_.clear();
        seen_.clear();
        for (const Placed& over : above) {
            const Shown self{make_ref(own(), over.node), level};
            for (int q = 0; q < 4; ++q) {
                const Ref child = at_.node(level, self.node).child[q];
                if (!takes(child)) continue;
                const int i = q & 1;
                const int j = q >> 1;
                Placed& placed = placed_.emplace_back();
                placed.node = index_of(child);
                placed.x = 2 * over.x + i;
                placed.y = 2 * over.y + j;
                placed.parent = below(over.parent, level, q);
                placed.first = below(over.first, level, q);
                placed.other_edge = below(over.other_edge, level, q);
                placed.left =
                    i == 1 ? below(self, level, q - 1) : below(over.left, level, q + 1);
                placed.above =
                    j == 1 ? below(self, level, q - 2) : below(over.above, level, q + 2);
                placed.coarse = self;
                placed.parent_coarse = over.parent;
            }
        }
    }

    const LayerSurroundings& at_;
    std::vector<Placed> placed_;
    std::vector<bool> seen_;
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
