#include "engine/video/time_tree.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace haarmony::video {

Frame::Frame(const ClipShape& shape,
             NodeAddress asked,
             NodeAddress stored,
             int space_level,
             Nodes nodes,
             std::vector<std::vector<LayerPtr>> chain)
    : shape_(shape),
      asked_(asked),
      stored_(stored),
      space_level_(space_level),
      nodes_(std::move(nodes)),
      chain_(std::move(chain)) {
    const auto levels =
        static_cast<std::size_t>(std::max(0, space_level - kBrickLevel + 1));
    assert(!chain_.empty() && depth() <= stored.time_level);
    tables_.reserve(levels * chain_.size());
    for (std::size_t level = 0; level < levels; ++level) {
        for (const std::vector<LayerPtr>& layers : chain_) {
            tables_.push_back(layers[level].get());
        }
    }
}

int Frame::last_shared_level(const Frame& a, const Frame& b) {
    const auto levels = static_cast<std::ptrdiff_t>(
        std::min(a.chain_.front().size(), b.chain_.front().size()));
    int level = -1;
    for (int k = 0; k <= std::min(a.depth(), b.depth()); ++k) {
        const std::vector<LayerPtr>& layers = a.chain_[static_cast<std::size_t>(k)];
        const std::vector<LayerPtr>& others = b.chain_[static_cast<std::size_t>(k)];
        if (!std::equal(layers.begin(), layers.begin() + levels, others.begin())) break;
        level = k;
    }
    return level;
}

Result<Frame> TimeTree::frame(const NodeAddress& at, int space_level) const {
    assert(shape_.contains(at));
    assert(space_level >= 0 && space_level <= shape_.space_levels());
    NodeAddress shown{0, 0};
    for (int k = 1; k <= at.time_level; ++k) {
        const NodeAddress node{k, at.index >> (at.time_level - k)};
        if (!stored(siblings_of(node))) break;
        shown = node;
    }
    const SiblingAddress address = siblings_of(shown);
    std::vector<std::vector<Frame::LayerPtr>> chain;
    for (int k = 0; k <= depth(address); ++k) {
        std::vector<Frame::LayerPtr>& layers = chain.emplace_back();
        for (int level = kBrickLevel; level <= space_level; ++level) {
            Result<Frame::LayerPtr> found = layer_on_way(address, k, level);
            if (!found) return std::move(found).error();
            layers.push_back(*std::move(found));
        }
    }
    Result<Frame::Nodes> found = nodes(address);
    if (!found) return std::move(found).error();
    return Frame(shape_, at, shown, space_level, *std::move(found), std::move(chain));
}

Result<Frame> TimeTree::above(const Frame& frame) const {
    const NodeAddress& shown = frame.stored();
    assert(shown.time_level >= 1 && frame.depth() >= 1);
    Result<Frame::Nodes> found = nodes_on_way(siblings_of(shown), frame.depth() - 1);
    if (!found) return std::move(found).error();
    const NodeAddress parent{shown.time_level - 1, shown.index >> 1};
    std::vector<std::vector<Frame::LayerPtr>> chain(frame.chain_.begin(),
                                                    frame.chain_.end() - 1);
    return Frame(
        shape_, parent, parent, frame.space_level(), *std::move(found), std::move(chain));
}

bool TimeTree::finer_in_time(const NodeAddress& at) const {
    assert(shape_.contains(at));
    return at.time_level < shape_.time_levels() && stored({at.time_level + 1, at.index});
}

}  // namespace haarmony::video
