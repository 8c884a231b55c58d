// A square of an image tree, as a walk meets it: a node, or a part of a brick below which
// there is no finer detail. Walking down never ends: below one pixel is the same pixel.
//   image_tree.h -> [tree_square.h] -> place.h, composite.h
//
// Errors   none; a wrong quadrant is a caller's bug.
// Threads  as the tree, which must outlive it.
// Source   sec. 5.3.3, GC() ["returns its argument node if it is a color, or the
//          requested child if it is a subtree"].
#pragma once

#include <cstdint>

#include "engine/video/image_tree.h"

namespace haarmony::video {

class TreeSquare {
  public:
    static TreeSquare root_of(const ImageTree& tree) {
        return TreeSquare(&tree, tree.root);
    }

    // One colour.
    [[nodiscard]] bool flat() const { return side_ == 1; }
    // Nothing here is finer than side() x side() pixels.
    [[nodiscard]] bool resolved() const {
        if (node_ == kNoDetail) return true;
        const auto& child = tree_->nodes[node_].child;
        return (child[0] & child[1] & child[2] & child[3]) == kNoDetail;
    }
    [[nodiscard]] bool has_child(int q) const {
        return node_ != kNoDetail &&
               tree_->nodes[node_].child[static_cast<std::size_t>(q)] != kNoDetail;
    }
    [[nodiscard]] TreeSquare quadrant(int q) const {
        if (has_child(q)) {
            return TreeSquare(tree_,
                              tree_->nodes[node_].child[static_cast<std::size_t>(q)]);
        }
        if (flat()) return *this;
        TreeSquare part = *this;
        part.node_ = kNoDetail;
        part.side_ = side_ / 2;
        part.x_ += (q & 1) * part.side_;
        part.y_ += (q >> 1) * part.side_;
        if (part.uniform()) part.side_ = 1;
        return part;
    }
    // How many pixels of its brick it is wide.
    [[nodiscard]] int side() const { return side_; }
    // Requires: 0 <= x, y < side(), no child there.
    [[nodiscard]] Rgba pixel(int x, int y) const {
        return tree_
            ->bricks[brick_][static_cast<std::size_t>((y_ + y) * kBrickSide + x_ + x)];
    }

  private:
    TreeSquare(const ImageTree* tree, std::uint32_t node)
        : tree_(tree), node_(node), brick_(tree->nodes[node].brick) {}

    [[nodiscard]] bool uniform() const {
        for (int y = 0; y < side_; ++y) {
            for (int x = 0; x < side_; ++x) {
                if (pixel(x, y) != pixel(0, 0)) return false;
            }
        }
        return true;
    }

    const ImageTree* tree_;
    std::uint32_t node_;   // kNoDetail for a part of a brick
    std::uint32_t brick_;  // kNoDetail for a node with four children
    int x_ = 0;
    int y_ = 0;
    int side_ = kBrickSide;
};

}  // namespace haarmony::video
