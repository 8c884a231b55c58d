// A clip, read: any time node at any space level, with only its time-ancestors in memory.
//   layer.h -> [time_tree.h] -> display.h, ops/, playback.h
//
// Errors   frame() passes on what the storage meets; an address outside the clip is a
//          caller's bug and asserts.
// Threads  const-thread-safe, also where layers are fetched on demand.
// Source   sec. 5.2.1, 5.2.4 [working storage].
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/layer.h"

namespace haarmony::video {

// A time node ready to be drawn up to one space level: it holds on to what it shows.
class Frame {
  public:
    using Nodes = std::shared_ptr<const SiblingNodes>;
    using LayerPtr = std::shared_ptr<const Layer>;

    // `stored` is `asked` or, where nothing finer is stored, its nearest time-ancestor.
    // chain[k][l - kBrickLevel] are the layers of the siblings that refs of time level k
    // name, the last being those of `stored`, l = kBrickLevel .. space_level (none if less).
    Frame(const ClipShape& shape,
          NodeAddress asked,
          NodeAddress stored,
          int space_level,
          Nodes nodes,
          std::vector<std::vector<LayerPtr>> chain);

    [[nodiscard]] const ClipShape& shape() const { return shape_; }
    [[nodiscard]] const NodeAddress& asked() const { return asked_; }
    [[nodiscard]] const NodeAddress& stored() const { return stored_; }
    // The finest space level that can be drawn.
    [[nodiscard]] int space_level() const { return space_level_; }
    [[nodiscard]] const TimeNode& time_node() const {
        return nodes_->node[stored_.time_level == 0 ? 0 : stored_.index & 1];
    }
    [[nodiscard]] Ref root(Edge edge) const {
        return time_node().root[static_cast<std::size_t>(edge)];
    }
    [[nodiscard]] const Apex& apex(Edge edge) const {
        return time_node().apex[static_cast<std::size_t>(edge)];
    }
    // Refs are of time levels 0 .. depth().
    [[nodiscard]] int depth() const { return static_cast<int>(chain_.size()) - 1; }
    // Requires: 0 <= time_level <= depth(), kBrickLevel <= level <= space_level().
    [[nodiscard]] const Layer& layer(int time_level, int level) const {
        return *chain_[static_cast<std::size_t>(time_level)]
                      [static_cast<std::size_t>(level - kBrickLevel)];
    }
    // Requires: kBrickLevel <= level <= space_level(), a ref of that level of this frame.
    [[nodiscard]] LinkedNode node(int level, Ref ref) const {
        return tables_[row(level, ref)]->nodes[index_of(ref)];
    }
    // The brick of a node, held as it is.
    [[nodiscard]] PackedBrick brick_of(int level, Ref node) const {
        return packed(level, tables_[row(level, node)]->nodes.brick(index_of(node)));
    }
    [[nodiscard]] Brick brick(int level, Ref ref) const {
        return tables_[row(level, ref)]->bricks[index_of(ref)];
    }
    [[nodiscard]] PackedBrick packed(int level, Ref ref) const {
        return tables_[row(level, ref)]->bricks.packed(index_of(ref));
    }

    // The last time level of refs down to which both frames hold the same layers, or -1: a
    // ref of that level or above is the same node or brick in both.
    [[nodiscard]] static int last_shared_level(const Frame& a, const Frame& b);

  private:
    friend class TimeTree;
    [[nodiscard]] std::size_t row(int level, Ref ref) const {
        return static_cast<std::size_t>(level - kBrickLevel) * chain_.size() +
               static_cast<std::size_t>(time_level_of(ref));
    }

    ClipShape shape_;
    NodeAddress asked_;
    NodeAddress stored_;
    int space_level_ = 0;
    Nodes nodes_;
    std::vector<std::vector<LayerPtr>> chain_;
    std::vector<const Layer*> tables_;  // by space level, then time level
};

class TimeTree {
  public:
    virtual ~TimeTree() = default;

    [[nodiscard]] const ClipShape& shape() const { return shape_; }
    [[nodiscard]] std::uint32_t delta() const { return delta_; }

    // The time node that shows `at`, up to a space level.
    // Requires: shape().contains(at), 0 <= space_level <= space_levels.
    [[nodiscard]] Result<Frame> frame(const NodeAddress& at, int space_level) const;
    // The time-parent of what `frame` shows, by the same refs: its chain is the beginning of
    // the frame's. Requires: a frame of this clip, frame.stored().time_level >= 1.
    [[nodiscard]] Result<Frame> above(const Frame& frame) const;
    // Whether anything below this node differs from it.
    [[nodiscard]] bool finer_in_time(const NodeAddress& at) const;

    // The siblings at an address of the time tree, or their layer of a space level >= 3 (and
    // up to max(space_levels, 3)). Requires: stored(address).
    [[nodiscard]] virtual bool stored(const SiblingAddress& address) const = 0;
    [[nodiscard]] virtual Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const = 0;
    [[nodiscard]] virtual Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                        int space_level) const = 0;

    // Refs of siblings lead to siblings of time levels 0 .. depth(), the last being they
    // themselves. In a clip that was built at once these are their time-ancestors. Where
    // frames were appended, siblings of what was complete stay as they are, and with them
    // the time-ancestors of that time: fewer, if the time tree has grown since.
    [[nodiscard]] virtual int depth(const SiblingAddress& address) const {
        return address.time_level;
    }
    // The siblings that refs of `time_level` lead to from those at `address`.
    // Requires: stored(address), 0 <= time_level <= depth(address).
    [[nodiscard]] virtual Result<Frame::Nodes> nodes_on_way(const SiblingAddress& address,
                                                            int time_level) const {
        return nodes(ancestor_of(address, time_level));
    }
    [[nodiscard]] virtual Result<Frame::LayerPtr>
    layer_on_way(const SiblingAddress& address, int time_level, int space_level) const {
        return layer(ancestor_of(address, time_level), space_level);
    }

  protected:
    TimeTree(const ClipShape& shape, std::uint32_t delta)
        : shape_(shape), delta_(delta) {}

  private:
    ClipShape shape_;
    std::uint32_t delta_;
};

}  // namespace haarmony::video
