#include "tests/engine/video/plain_frame.h"

#include <array>
#include <cassert>

namespace haarmony::video::testing {
namespace {

// A node and all below it, appended; or kNoDetail where it only repeats `above`.
std::uint32_t copy(const Frame& frame,
                   int level,
                   Ref ref,
                   const Brick* above,
                   int quadrant,
                   ExactFrame& to) {
    const LinkedNode& node = frame.node(level, ref);
    const Brick& brick = frame.brick(level, node.brick);
    TreeNode copied;
    bool finer = above == nullptr;
    for (int q = 0; q < 4; ++q) {
        const Ref child = node.child[static_cast<std::size_t>(q)];
        if (child == kNoDetailRef) continue;
        const std::uint32_t below = copy(frame, level + 1, child, &brick, q, to);
        copied.child[static_cast<std::size_t>(q)] = below;
        finer = finer || below != kNoDetail;
    }
    for (int i = 0; i < kBrickPixels && !finer; ++i) {
        const int x = 4 * (quadrant & 1) + i % 8 / 2;
        const int y = 4 * (quadrant >> 1) + i / 8 / 2;
        finer = !(brick[static_cast<std::size_t>(i)] ==
                  (*above)[static_cast<std::size_t>(8 * y + x)]);
    }
    if (!finer) return kNoDetail;
    copied.brick = static_cast<std::uint32_t>(to.bricks.size());
    to.bricks.push_back(brick);
    to.nodes.push_back(copied);
    return static_cast<std::uint32_t>(to.nodes.size() - 1);
}

}  // namespace

ExactFrame as_exact(const Frame& frame) {
    assert(frame.shape().space_levels() >= kBrickLevel);
    ExactFrame exact;
    for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
        const auto e = static_cast<std::size_t>(edge);
        exact.root[e] = copy(frame, kBrickLevel, frame.root(edge), nullptr, 0, exact);
        exact.apex[e] = frame.apex(edge);
    }
    exact.bounds = frame.time_node().bounds;
    return exact;
}

ExactFrame exact_frame(const RawClip& clip, const NodeAddress& at) {
    const std::unique_ptr<MemoryClip> plain = plain_clip(clip);
    return as_exact(*plain->frame(at, plain->shape().space_levels()));
}

}  // namespace haarmony::video::testing
