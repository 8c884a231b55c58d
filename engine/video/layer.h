// What two siblings of the time tree have that no time-ancestor has: their own nodes and
// bricks, and up-links for the rest.
//   image_tree.h -> build.h -> [layer.h] -> time_tree.h -> display.h
//
// Shape    siblings are the two halves of one time node (k - 1, index): the nodes (k, 2 index)
//          and (k, 2 index + 1), the second absent where no frames are left; the root of the
//          time tree is alone. Their nodes and bricks stand together in one layer a space
//          level, 3 and up. A Ref names a node or a brick of the same frame's chain: the time
//          level of the siblings that own it (its own, or a time-ancestor's), and the index
//          in their layer of the space level at hand.
// Memory   4 or 20 bytes a node (linked_nodes.h), 192 an opaque brick and 256 another
//          (bricks.h); only the siblings on the way from the root of the time tree to the
//          frame on display need be in memory (sec. 5.2.4).
// Source   sec. 5.2.1, Figures 5.2, 5.4; sec. 5.2.2 [up-links]; ERRATA of the project,
//          video, "Lossy bound".
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/brick.h"
#include "engine/video/bricks.h"
#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"
#include "engine/video/linked_nodes.h"

namespace haarmony::video {

// The own nodes and bricks of two siblings at one space level.
struct Layer {
    LinkedNodes nodes;
    Bricks bricks;

    // Once it is finished: takes as little memory as it can.
    void compact() {
        nodes.compact();
        bricks.shrink_to_fit();
    }
    [[nodiscard]] std::size_t memory_bytes() const {
        return nodes.memory_bytes() + bricks.memory_bytes();
    }
    friend bool operator==(const Layer&, const Layer&) = default;
};

// One time node, without its layers. root[] are nodes of space level 3.
struct TimeNode {
    std::array<Ref, kEdges> root = {kNoDetailRef, kNoDetailRef};  // by Edge
    std::array<Apex, kEdges> apex{};
    Bounds bounds;

    friend bool operator==(const TimeNode&, const TimeNode&) = default;
};

struct SiblingAddress {
    int time_level = 0;      // of the siblings themselves
    std::int64_t index = 0;  // of their parent at time_level - 1; 0 for the root

    friend bool operator==(const SiblingAddress&, const SiblingAddress&) = default;
};

[[nodiscard]] constexpr SiblingAddress siblings_of(const NodeAddress& at) {
    return {at.time_level, at.time_level == 0 ? 0 : at.index >> 1};
}

// The siblings at a time level that is theirs or above. Requires: time_level <= at.time_level.
[[nodiscard]] constexpr SiblingAddress ancestor_of(const SiblingAddress& at,
                                                   int time_level) {
    return {time_level, at.index >> (at.time_level - time_level)};
}

struct SiblingNodes {
    std::array<TimeNode, 2> node{};
    int count = 0;  // 1 or 2

    friend bool operator==(const SiblingNodes&, const SiblingNodes&) = default;
};

struct Siblings {
    SiblingAddress address;
    SiblingNodes nodes;
    std::vector<Layer> layers;  // layers[l - kBrickLevel]
};

// Takes a clip as it is built: begin, siblings from the root of the time tree down (parents
// before their children, the first half's descendants before the second's), finish.
// Siblings are left out where all frames below a time node are that node, byte for byte:
// there is no finer detail in time.
class ClipSink {
  public:
    virtual ~ClipSink() = default;
    // `delta` in units of difference().
    [[nodiscard]] virtual Result<void> begin(const ClipShape& shape,
                                             std::uint32_t delta) = 0;
    [[nodiscard]] virtual Result<void> add(Siblings siblings) = 0;
    [[nodiscard]] virtual Result<void> finish() = 0;
};

}  // namespace haarmony::video
