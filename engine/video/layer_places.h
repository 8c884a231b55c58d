// Where the own nodes of a layer lie in the picture, and what is shown around each of them:
// refs alone do not say places, so the trees are walked from their roots.
//   layer.h -> [layer_places.h] -> layer_coder.h
//
// Shape    place (x, y) of space level l counts bricks. A node that is shown in several places
//          counts in the first: first half before second, padded tree before normalised, then
//          quadrant by quadrant. Nodes of ancestors are never entered: what is below them is
//          theirs.
// Cost     linear in the own nodes of the levels walked, however often they are shown.
// Errors   none; refs are valid where they come from (layer_coder.h).
#pragma once

#include <cstdint>
#include <vector>

#include "engine/video/layer.h"

namespace haarmony::video {

// The siblings at hand, and what is known before their layer of one space level: the finished
// layers of their time-ancestors up to that level, and their own of the levels above it.
struct LayerSurroundings {
    SiblingAddress address;
    int space_level = kBrickLevel;
    int finest_level = kBrickLevel;         // of the clip
    const SiblingNodes* nodes = nullptr;    // of these siblings
    const TimeNode* time_parent = nullptr;  // null at the root of the time tree
    // layers[k][l - kBrickLevel], k up to address.time_level. The last entry of the last
    // row may be what is being decoded.
    std::vector<std::vector<const Layer*>> layers;
    // Nodes of space level + 1, by time level; empty at the finest level.
    std::vector<std::uint32_t> finer_nodes;

    [[nodiscard]] const Layer& layer(int time_level, int level) const {
        return *layers[time_level][level - kBrickLevel];
    }
    [[nodiscard]] LinkedNode node(int level, Ref ref) const {
        return layer(time_level_of(ref), level).nodes[index_of(ref)];
    }
    [[nodiscard]] Brick brick(int level, Ref ref) const {
        return layer(time_level_of(ref), level).bricks[index_of(ref)];
    }
};

// A node that shows a place: of that place's own level, or of a coarser one where there is no
// finer detail.
struct Shown {
    Ref node = kNoDetailRef;  // none: outside the picture, or no such tree
    int level = 0;

    [[nodiscard]] bool any() const { return node != kNoDetailRef; }
};

struct Placed {
    std::uint32_t node = 0;  // index in the siblings' own layer
    std::int32_t x = 0;
    std::int32_t y = 0;
    Shown parent;         // at the same place, in the time-parent
    Shown first;          // in the first half, for a node of the second
    Shown other_edge;     // in the padded tree, for a node of the normalised
    Shown coarse;         // one level up: its own parent
    Shown parent_coarse;  // one level up in the time-parent
};

// The own nodes of surroundings.space_level that are shown, in the order of the walk.
[[nodiscard]] std::vector<Placed> places(const LayerSurroundings& surroundings);

// What a brick shows at place (x, y) of a level so many levels finer than its own.
// Requires: levels >= 1.
void enlarge(const Brick& brick, int levels, std::int32_t x, std::int32_t y, Brick& out);

}  // namespace haarmony::video
