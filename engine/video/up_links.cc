#include "engine/video/up_links.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <string>

#include "engine/video/brick_match.h"

namespace haarmony::video {
namespace {

// Kinds of content: what lies at one space level can only be linked from there.
constexpr std::uint32_t brick_kind(int level) {
    return 2 * static_cast<std::uint32_t>(level);
}
constexpr std::uint32_t node_kind(int level) { return brick_kind(level) + 1; }

std::uint64_t hash_of(const LinkedNode& node) {
    std::uint64_t hash = static_cast<std::uint32_t>(node.brick);
    for (const Ref child : node.child) {
        hash = (hash ^ static_cast<std::uint32_t>(child)) * 0x9E37'79B9'7F4A'7C15;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

UpLinks::UpLinks(int space_levels, std::uint32_t delta, std::uint32_t max_index)
    : finest_(std::max(space_levels, kBrickLevel)),
      delta_(delta),
      max_index_(max_index),
      near_(chain_, delta) {
    assert(max_index <= kMaxRefIndex);
}

void UpLinks::descend() {
    ++depth_;
    if (chain_.layers.size() < static_cast<std::size_t>(depth_)) {
        chain_.layers.emplace_back(static_cast<std::size_t>(finest_ - kBrickLevel + 1));
    }
    marks_.push_back(table_.size());
}

void UpLinks::ascend() {
    assert(depth_ > 0);
    for (Layer& layer : chain_.layers[static_cast<std::size_t>(depth_) - 1]) {
        layer.nodes.clear();
        layer.bricks.clear();
    }
    table_.shrink(marks_.back());
    marks_.pop_back();
    --depth_;
}

Result<TimeNode> UpLinks::link(const ExactFrame& frame, const TimeNode* parent) {
    assert(depth_ > 0);
    assert((parent == nullptr) == (depth_ == 1));
    resolved_.assign(frame.nodes.size(), kNoDetailRef);
    if (delta_ > 0) near_.begin(frame);
    TimeNode linked;
    linked.apex = frame.apex;
    linked.bounds = frame.bounds;
    for (std::size_t edge = 0; edge < linked.root.size(); ++edge) {
        const Ref above = parent == nullptr ? kNoDetailRef : parent->root[edge];
        linked.root[edge] = resolve(frame, frame.root[edge], kBrickLevel, above);
    }
    if (full_level_ < 0) return linked;
    return Error{ErrorCode::kTooLarge,
                 "two time nodes have more than " + std::to_string(max_index_ + 1) +
                     " nodes or bricks of their own at space level " +
                     std::to_string(full_level_),
                 "frames"};
}

Ref UpLinks::resolve(const ExactFrame& frame, std::uint32_t index, int level, Ref above) {
    Ref& resolved = resolved_[index];
    if (resolved != kNoDetailRef) return resolved;
    if (delta_ > 0 && above != kNoDetailRef && near_.shows(above, index, level)) {
        return resolved = above;
    }
    const TreeNode& exact = frame.nodes[index];
    std::optional<LinkedNode> shown;
    if (above != kNoDetailRef) shown = chain_.node(level, above);
    if (level == finest_) {
        const Brick& brick = frame.bricks[exact.brick];
        const bool linked = shown && chain_.equals(level, shown->brick, brick);
        return resolved = linked ? above : own_finest(brick);
    }
    LinkedNode made;
    made.brick =
        brick_for(frame.bricks[exact.brick], level, shown ? shown->brick : kNoDetailRef);
    if (made.brick == kNoDetailRef) return kNoDetailRef;
    Brick displayed;
    if (delta_ > 0) displayed = chain_.brick(level, made.brick);
    for (int q = 0; q < 4; ++q) {
        const auto quadrant = static_cast<std::size_t>(q);
        const std::uint32_t below = exact.child[quadrant];
        if (below == kNoDetail) continue;
        if (delta_ > 0 && near_.flat(displayed, q, below)) continue;
        const Ref above_below = !shown ? kNoDetailRef : shown->child[quadrant];
        made.child[quadrant] = resolve(frame, below, level + 1, above_below);
        if (made.child[quadrant] == kNoDetailRef) return kNoDetailRef;
    }
    if (shown && made == *shown) return resolved = above;
    return resolved = own(made, level);
}

Ref UpLinks::brick_for(const Brick& exact, int level, Ref above) {
    const auto shown = [&] {
        return delta_ == 0 ? chain_.equals(level, above, exact)
                           : within(exact, chain_.brick(level, above), delta_);
    };
    if (above != kNoDetailRef && shown()) return above;
    return own(exact, level);
}

Ref UpLinks::own(const Brick& brick, int level) {
    return table_.find_or_make(
        hash_of(brick),
        brick_kind(level),
        [&](Ref ref) { return chain_.equals(level, ref, brick); },
        [&] { return append(own_layer(level).bricks, brick, level); });
}

Ref UpLinks::own(const LinkedNode& node, int level) {
    return table_.find_or_make(
        hash_of(node),
        node_kind(level),
        [&](Ref ref) { return node == chain_.node(level, ref); },
        [&] { return append(own_layer(level).nodes, node, level); });
}

Ref UpLinks::own_finest(const Brick& brick) {
    return table_.find_or_make(
        hash_of(brick),
        node_kind(finest_),
        [&](Ref ref) {
            const Ref known = chain_.node(finest_, ref).brick;
            return chain_.equals(finest_, known, brick);
        },
        [&] {
            LinkedNode node;
            node.brick = append(own_layer(finest_).bricks, brick, finest_);
            if (node.brick == kNoDetailRef) return kNoDetailRef;
            return append(own_layer(finest_).nodes, node, finest_);
        });
}

template <typename List, typename T>
Ref UpLinks::append(List& to, const T& what, int level) {
    if (to.size() > max_index_) {
        full_level_ = level;
        return kNoDetailRef;
    }
    to.push_back(what);
    return make_ref(depth_ - 1, static_cast<std::uint32_t>(to.size() - 1));
}

}  // namespace haarmony::video
