#include "engine/video/memory_clip.h"

#include <cassert>

namespace haarmony::video {

Result<void> MemoryClip::Sink::begin(const ClipShape& shape, std::uint32_t delta) {
    clip_.reset(new MemoryClip(shape, delta));
    return {};
}

Result<void> MemoryClip::Sink::add(Siblings siblings) {
    Held held;
    held.nodes = std::make_shared<const SiblingNodes>(siblings.nodes);
    held.layers.reserve(siblings.layers.size());
    for (Layer& layer : siblings.layers) {
        layer.compact();
        held.layers.push_back(std::make_shared<const Layer>(std::move(layer)));
    }
    clip_->siblings_.insert_or_assign(
        {siblings.address.time_level, siblings.address.index}, std::move(held));
    return {};
}

Result<void> MemoryClip::Sink::finish() { return {}; }

bool MemoryClip::stored(const SiblingAddress& address) const {
    return siblings_.contains({address.time_level, address.index});
}

const MemoryClip::Held& MemoryClip::held(const SiblingAddress& address) const {
    const auto found = siblings_.find({address.time_level, address.index});
    assert(found != siblings_.end());
    return found->second;
}

Result<Frame::Nodes> MemoryClip::nodes(const SiblingAddress& address) const {
    return held(address).nodes;
}

Result<Frame::LayerPtr> MemoryClip::layer(const SiblingAddress& address,
                                          int space_level) const {
    return held(address).layers[static_cast<std::size_t>(space_level - kBrickLevel)];
}

std::uint64_t MemoryClip::memory_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& [address, held] : siblings_) {
        bytes += static_cast<std::uint64_t>(held.nodes->count) * sizeof(TimeNode);
        for (const Frame::LayerPtr& layer : held.layers) bytes += layer->memory_bytes();
    }
    return bytes;
}

}  // namespace haarmony::video
