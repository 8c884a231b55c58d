#include "engine/video/ops/leaf_tree.h"

#include <algorithm>

namespace haarmony::video {
namespace {

class Copy {
  public:
    Copy(const Frame& frame, ImageTree& tree) : frame_(frame), tree_(tree) {}

    std::uint32_t node(int level, Ref ref) {
        const LinkedNode& linked = frame_.node(level, ref);
        TreeNode node;
        if (level < frame_.space_level()) {
            for (std::size_t q = 0; q < 4; ++q) {
                if (linked.child[q] == kNoDetailRef) continue;
                node.child[q] = this->node(level + 1, linked.child[q]);
            }
        }
        if (std::find(node.child.begin(), node.child.end(), kNoDetail) !=
            node.child.end()) {
            node.brick = static_cast<std::uint32_t>(tree_.bricks.size());
            tree_.bricks.push_back(frame_.brick(level, linked.brick));
        }
        tree_.nodes.push_back(node);
        return static_cast<std::uint32_t>(tree_.nodes.size() - 1);
    }

  private:
    const Frame& frame_;
    ImageTree& tree_;
};

void copy_apex(const Apex& apex, int level, ImageTree& tree) {
    const int shift = kBrickLevel - level;
    Brick& brick = tree.bricks.emplace_back();
    for (int y = 0; y < kBrickSide; ++y) {
        for (int x = 0; x < kBrickSide; ++x) {
            const int from = apex_offset(level) + ((y >> shift) << level) + (x >> shift);
            brick[static_cast<std::size_t>(y * kBrickSide + x)] =
                apex[static_cast<std::size_t>(from)];
        }
    }
    TreeNode& node = tree.nodes.emplace_back();
    node.brick = 0;
    tree.root = 0;
}

}  // namespace

Visited leaf_tree(const Frame& frame, ImageTree& tree) {
    tree.nodes.clear();
    tree.bricks.clear();
    if (frame.space_level() < kBrickLevel) {
        copy_apex(frame.apex(Edge::kPad), frame.space_level(), tree);
    } else {
        tree.root = Copy(frame, tree).node(kBrickLevel, frame.root(Edge::kPad));
    }
    const auto nodes = static_cast<std::int64_t>(tree.nodes.size());
    return {nodes, nodes};
}

}  // namespace haarmony::video
