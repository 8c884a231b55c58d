#include "engine/video/sum_tree.h"

#include <cassert>
#include <cstddef>

namespace haarmony::video {
namespace {

// A quadrant of a brick with twice the detail.
SumBrick quadrant_of(const SumBrick& sums, std::size_t quadrant) {
    constexpr std::size_t kHalf = kBrickSide / 2;
    const std::size_t corner =
        (quadrant >> 1) * kHalf * kBrickSide + (quadrant & 1) * kHalf;
    SumBrick finer;
    for (std::size_t y = 0; y < kBrickSide; ++y) {
        for (std::size_t x = 0; x < kBrickSide; ++x) {
            finer[y * kBrickSide + x] = sums[corner + y / 2 * kBrickSide + x / 2];
        }
    }
    return finer;
}

struct TreeSource {
    const ImageTree& tree;
    std::int64_t repeats;

    [[nodiscard]] const TreeNode& node(std::uint32_t index) const {
        return tree.nodes[index];
    }
    [[nodiscard]] SumBrick brick(std::uint32_t index) const {
        SumBrick sums;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            sums[i] = sum_of(tree.bricks[index][i], static_cast<std::uint64_t>(repeats));
        }
        return sums;
    }
};

}  // namespace

void SumTree::add(const ImageTree& tree, std::int64_t repeats) {
    assert(repeats >= 1 && tree.root != kNoDetail);
    if (nodes_.empty()) nodes_.emplace_back();
    add_node(root(), TreeSource{tree, repeats}, tree.root);
    frames_ += repeats;
}

void SumTree::add(const SumTree& other) {
    assert(this != &other);
    if (other.frames_ == 0) return;
    if (nodes_.empty()) nodes_.emplace_back();
    add_node(root(), other, other.root());
    frames_ += other.frames_;
}

void SumTree::clear() {
    nodes_.clear();
    bricks_.clear();
    frames_ = 0;
}

template <typename Source>
void SumTree::add_node(std::uint32_t at, const Source& source, std::uint32_t node) {
    const TreeNode& added = source.node(node);
    bool has_flat = false;
    for (std::size_t q = 0; q < 4; ++q) {
        if (added.child[q] != kNoDetail) {
            add_node(split(at, q), source, added.child[q]);
        } else if (nodes_[at].child[q] != kNoDetail) {
            add_flat(nodes_[at].child[q], quadrant_of(source.brick(added.brick), q));
        } else {
            has_flat = true;
        }
    }
    if (has_flat) add_brick(at, source.brick(added.brick));
}

void SumTree::add_flat(std::uint32_t at, const SumBrick& sums) {
    bool has_flat = false;
    for (std::size_t q = 0; q < 4; ++q) {
        if (nodes_[at].child[q] == kNoDetail) {
            has_flat = true;
        } else {
            add_flat(nodes_[at].child[q], quadrant_of(sums, q));
        }
    }
    if (has_flat) add_brick(at, sums);
}

void SumTree::add_brick(std::uint32_t at, const SumBrick& sums) {
    if (nodes_[at].brick == kNoDetail) {
        nodes_[at].brick = static_cast<std::uint32_t>(bricks_.size());
        bricks_.push_back(sums);
        return;
    }
    SumBrick& brick = bricks_[nodes_[at].brick];
    for (std::size_t i = 0; i < brick.size(); ++i) brick[i] += sums[i];
}

// The child below a quadrant: made, if need be, of what was added to the quadrant so far.
std::uint32_t SumTree::split(std::uint32_t at, std::size_t quadrant) {
    if (nodes_[at].child[quadrant] != kNoDetail) return nodes_[at].child[quadrant];
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].child[quadrant] = child;
    const std::uint32_t brick = nodes_[at].brick;
    nodes_.emplace_back();
    if (brick != kNoDetail) {
        nodes_[child].brick = static_cast<std::uint32_t>(bricks_.size());
        bricks_.push_back(quadrant_of(bricks_[brick], quadrant));
    }
    return child;
}

}  // namespace haarmony::video
