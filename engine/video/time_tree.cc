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
    assert(chain_.size() == static_cast<std::size_t>(stored.time_level) + 1);
    tables_.reserve(levels * chain_.size());
    for (std::size_t level = 0; level < levels; ++level) {
        for (const std::vector<LayerPtr>& layers : chain_) {
            tables_.push_back(layers[level].get());
        }
    }
}

Result<Frame> TimeTree::frame(const NodeAddress& at, int space_level) const {
    assert(shape_.contains(at));
    assert(space_level >= 0 && space_level <= shape_.space_levels());
    NodeAddress shown{0, 0};
    std::vector<std::vector<Frame::LayerPtr>> chain;
    for (int k = 0; k <= at.time_level; ++k) {
        const NodeAddress node{k, at.index >> (at.time_level - k)};
        const SiblingAddress address = siblings_of(node);
        if (!stored(address)) break;
        shown = node;
        std::vector<Frame::LayerPtr>& layers = chain.emplace_back();
        for (int level = kBrickLevel; level <= space_level; ++level) {
            Result<Frame::LayerPtr> found = layer(address, level);
            if (!found) return std::move(found).error();
            layers.push_back(*std::move(found));
        }
    }
    Result<Frame::Nodes> found = nodes(siblings_of(shown));
    if (!found) return std::move(found).error();
    return Frame(shape_, at, shown, space_level, *std::move(found), std::move(chain));
}

bool TimeTree::finer_in_time(const NodeAddress& at) const {
    assert(shape_.contains(at));
    return at.time_level < shape_.time_levels() && stored({at.time_level + 1, at.index});
}

}  // namespace haarmony::video
