#include "engine/video/sum_tree.h"

#include <algorithm>

#include "engine/video/sum_kernel.h"

namespace haarmony::video {
namespace {

struct PictureSource {
    const ImageTree& tree;

    [[nodiscard]] const TreeNode& node(std::uint32_t at) const { return tree.nodes[at]; }
    template <typename Visitor>
    void visit(const TreeNode& node, const Visitor& visitor) const {
        visitor(tree.bricks[node.brick]);
    }
};

// The shortest sums that pixels or sums can be added to, whatever the number of frames.
SumWidth width_of(const Brick& pixels) {
    std::uint8_t alpha = 255;
    for (const Rgba& pixel : pixels) alpha &= pixel.a;
    return alpha == 255 ? SumWidth::kShort : SumWidth::kNarrow;
}
SumWidth width_of(const ShortSums&) { return SumWidth::kShort; }
SumWidth width_of(const NarrowSums&) { return SumWidth::kNarrow; }
SumWidth width_of(const WideSums&) { return SumWidth::kWide; }

SumWidth width_of(std::uint64_t frames) {
    return frames <= kMostShortFrames    ? SumWidth::kShort
           : frames <= kMostNarrowFrames ? SumWidth::kNarrow
                                         : SumWidth::kWide;
}

// The sums have room for what is added: widen() saw to it.
void add_to(ShortSums& sums, const Brick& pixels, std::uint64_t frames) {
    add_opaque(pixels, static_cast<std::uint32_t>(frames), sums);
}
void add_to(ShortSums& sums, const ShortSums& added, std::uint64_t) {
    add_planes(added, sums);
}
template <typename Addend>
void add_to(ShortSums&, const Addend&, std::uint64_t) {
    assert(false);
}
void add_to(NarrowSums& sums, const Brick& pixels, std::uint64_t frames) {
    add_pixels(pixels, static_cast<std::uint32_t>(frames), sums);
}
void add_to(NarrowSums& sums, const NarrowSums& added, std::uint64_t) {
    add_planes(added, sums);
}
template <typename Addend>
void add_to(NarrowSums& sums, const Addend& added, std::uint64_t frames) {
    add_each(added, frames, sums);
}
template <typename Addend>
void add_to(WideSums& sums, const Addend& added, std::uint64_t frames) {
    add_each(added, frames, sums);
}

template <typename T>
std::uint32_t index_of_new(std::vector<T>& all) {
    all.emplace_back();
    return static_cast<std::uint32_t>(all.size() - 1);
}

}  // namespace

void SumTree::add(const ImageTree& tree, std::int64_t repeats) {
    assert(repeats >= 1 && tree.root != kNoDetail);
    add_tree(PictureSource{tree}, tree.root, repeats);
}

void SumTree::add(const SumTree& other) {
    assert(this != &other);
    if (other.frames_ > 0) add_tree(other, other.root(), other.frames_);
}

void SumTree::clear() {
    nodes_.clear();
    short_.clear();
    narrow_.clear();
    wide_.clear();
    frames_ = 0;
}

template <typename Source>
void SumTree::add_tree(const Source& source,
                       std::uint32_t root_node,
                       std::int64_t frames) {
    if (nodes_.empty()) nodes_.emplace_back();
    const Count count{.before = static_cast<std::uint64_t>(frames_),
                      .added = static_cast<std::uint64_t>(frames)};
    add_node(root(), source, root_node, count);
    frames_ += frames;
}

template <typename Source>
void SumTree::add_node(std::uint32_t at,
                       const Source& source,
                       std::uint32_t node,
                       const Count& count) {
    const auto& added = source.node(node);
    bool has_flat = false;
    for (std::size_t q = 0; q < 4; ++q) {
        if (added.child[q] != kNoDetail) {
            add_node(split(at, q), source, added.child[q], count);
        } else if (nodes_[at].child[q] != kNoDetail) {
            source.visit(added, [&](const auto& brick) {
                add_flat(nodes_[at].child[q], quadrant_of(brick, q), count);
            });
        } else {
            has_flat = true;
        }
    }
    if (!has_flat) return;
    source.visit(added, [&](const auto& brick) { add_brick(at, brick, count); });
}

template <typename Addend>
void SumTree::add_flat(std::uint32_t at, const Addend& addend, const Count& count) {
    bool has_flat = false;
    for (std::size_t q = 0; q < 4; ++q) {
        if (nodes_[at].child[q] == kNoDetail) {
            has_flat = true;
        } else {
            add_flat(nodes_[at].child[q], quadrant_of(addend, q), count);
        }
    }
    if (has_flat) add_brick(at, addend, count);
}

template <typename Addend>
void SumTree::add_brick(std::uint32_t at, const Addend& addend, const Count& count) {
    SumNode& node = nodes_[at];
    widen(node,
          std::max(width_of(addend), width_of(count.before + count.added)),
          count.before);
    switch (node.width) {
        case SumWidth::kShort:
            return add_to(short_[node.brick], addend, count.added);
        case SumWidth::kNarrow:
            return add_to(narrow_[node.brick], addend, count.added);
        case SumWidth::kWide:
            return add_to(wide_[node.brick], addend, count.added);
    }
}

// Gives the node, which has so many frames, a brick of this width at least.
void SumTree::widen(SumNode& node, SumWidth width, std::uint64_t frames) {
    const SumNode before = node;
    if (before.brick != kNoDetail && before.width >= width) return;
    node.width = width;
    switch (width) {
        case SumWidth::kShort:
            node.brick = index_of_new(short_);
            return;
        case SumWidth::kNarrow:
            node.brick = index_of_new(narrow_);
            if (before.brick == kNoDetail) return;
            return add_each(short_[before.brick], frames, narrow_[node.brick]);
        case SumWidth::kWide:
            node.brick = index_of_new(wide_);
            if (before.brick == kNoDetail) return;
            return visit(before, [&](const auto& sums) {
                add_each(sums, frames, wide_[node.brick]);
            });
    }
}

// The child below a quadrant: made, if need be, of what was added to the quadrant so far.
std::uint32_t SumTree::split(std::uint32_t at, std::size_t quadrant) {
    if (nodes_[at].child[quadrant] != kNoDetail) return nodes_[at].child[quadrant];
    const std::uint32_t index = index_of_new(nodes_);
    nodes_[at].child[quadrant] = index;
    const SumNode& parent = nodes_[at];
    SumNode& child = nodes_[index];
    if (parent.brick == kNoDetail) return index;
    widen(child, parent.width, 0);
    switch (parent.width) {
        case SumWidth::kShort:
            short_[child.brick] = quadrant_of(short_[parent.brick], quadrant);
            break;
        case SumWidth::kNarrow:
            narrow_[child.brick] = quadrant_of(narrow_[parent.brick], quadrant);
            break;
        case SumWidth::kWide:
            wide_[child.brick] = quadrant_of(wide_[parent.brick], quadrant);
            break;
    }
    return index;
}

}  // namespace haarmony::video
