#include "engine/video/sum_tree.h"

#include <algorithm>
#include <cassert>

namespace haarmony::video {
namespace {

// A quadrant of 8 x 8 values with twice the detail.
template <typename Value>
std::array<Value, kBrickPixels> quadrant_of(const std::array<Value, kBrickPixels>& values,
                                            std::size_t quadrant) {
    constexpr std::size_t kHalf = kBrickSide / 2;
    const Value* const corner =
        &values[(quadrant >> 1) * kHalf * kBrickSide + (quadrant & 1) * kHalf];
    std::array<Value, kBrickPixels> finer;
    for (std::size_t y = 0; y < kBrickSide; ++y) {
        for (std::size_t x = 0; x < kBrickSide; ++x) {
            finer[y * kBrickSide + x] = corner[y / 2 * kBrickSide + x / 2];
        }
    }
    return finer;
}

template <typename Sum>
Planes<Sum> quadrant_of(const Planes<Sum>& planes, std::size_t quadrant) {
    return {quadrant_of(planes[0], quadrant),
            quadrant_of(planes[1], quadrant),
            quadrant_of(planes[2], quadrant),
            quadrant_of(planes[3], quadrant)};
}

NarrowSums quadrant_of(const NarrowSums& sums, std::size_t quadrant) {
    NarrowSums finer;
    finer.opaque = sums.opaque;
    for (std::size_t plane = 0; plane < (sums.opaque ? 3U : 4U); ++plane) {
        finer.planes[plane] = quadrant_of(sums.planes[plane], quadrant);
    }
    return finer;
}

bool is_opaque(const Brick& pixels) {
    std::uint8_t alpha = 255;
    for (const Rgba& pixel : pixels) alpha &= pixel.a;
    return alpha == 255;
}

// Sums of opaque pixels as those of any.
void weigh(NarrowSums& sums, std::uint64_t samples) {
    if (!sums.opaque) return;
    sums.opaque = false;
    for (std::size_t plane = 0; plane < 3; ++plane) {
        for (std::uint32_t& sum : sums.planes[plane]) sum *= 255;
    }
    sums.planes[3].fill(static_cast<std::uint32_t>(255 * samples));
}

void add_sum(WidePlanes& planes, std::size_t i, const PixelSum& sum) {
    planes[0][i] += sum.r;
    planes[1][i] += sum.g;
    planes[2][i] += sum.b;
    planes[3][i] += sum.a;
}

struct PixelSource {
    const ImageTree& tree;

    [[nodiscard]] const TreeNode& node(std::uint32_t at) const { return tree.nodes[at]; }
    [[nodiscard]] const Brick& brick(std::uint32_t at) const { return tree.bricks[at]; }
};

struct NarrowSource {
    const SumTree& sums;

    [[nodiscard]] const TreeNode& node(std::uint32_t at) const { return sums.node(at); }
    [[nodiscard]] const NarrowSums& brick(std::uint32_t at) const {
        return sums.narrow_brick(at);
    }
};

struct WideSource {
    const SumTree& sums;

    [[nodiscard]] const TreeNode& node(std::uint32_t at) const { return sums.node(at); }
    [[nodiscard]] const WidePlanes& brick(std::uint32_t at) const {
        return sums.wide_brick(at);
    }
};

}  // namespace

PixelSum sum_at(const SumPlanes& planes,
                bool opaque,
                std::uint64_t samples,
                std::size_t i) {
    const std::uint64_t r = planes[0][i], g = planes[1][i], b = planes[2][i];
    if (opaque) return {255 * r, 255 * g, 255 * b, 255 * samples};
    return {r, g, b, planes[3][i]};
}

PixelSum sum_at(const WidePlanes& planes, std::size_t i) {
    return {planes[0][i], planes[1][i], planes[2][i], planes[3][i]};
}

void SumTree::add(const ImageTree& tree, std::int64_t repeats) {
    assert(repeats >= 1 && tree.root != kNoDetail);
    add_tree(PixelSource{tree}, tree.root, static_cast<std::uint64_t>(repeats));
}

void SumTree::add(const SumTree& other) {
    assert(this != &other);
    if (other.frames_ == 0) return;
    const auto count = static_cast<std::uint64_t>(other.frames_);
    if (other.wide_) {
        add_tree(WideSource{other}, other.root(), count);
    } else {
        add_tree(NarrowSource{other}, other.root(), count);
    }
}

void SumTree::clear() {
    nodes_.clear();
    narrow_bricks_.clear();
    wide_bricks_.clear();
    frames_ = 0;
    wide_ = false;
}

template <typename Source>
void SumTree::add_tree(const Source& source,
                       std::uint32_t root_node,
                       std::uint64_t count) {
    if (nodes_.empty()) nodes_.emplace_back();
    if (!wide_ && static_cast<std::uint64_t>(frames_) + count > kMostSamples) widen();
    add_node(root(), source, root_node, count);
    frames_ += static_cast<std::int64_t>(count);
}

template <typename Source>
void SumTree::add_node(std::uint32_t at,
                       const Source& source,
                       std::uint32_t node,
                       std::uint64_t count) {
    const TreeNode& added = source.node(node);
    bool has_flat = false;
    for (std::size_t q = 0; q < 4; ++q) {
        if (added.child[q] != kNoDetail) {
            add_node(split(at, q), source, added.child[q], count);
        } else if (nodes_[at].child[q] != kNoDetail) {
            add_flat(
                nodes_[at].child[q], quadrant_of(source.brick(added.brick), q), count);
        } else {
            has_flat = true;
        }
    }
    if (has_flat) add_brick(at, source.brick(added.brick), count);
}

template <typename Addend>
void SumTree::add_flat(std::uint32_t at, const Addend& addend, std::uint64_t count) {
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

void SumTree::add_brick(std::uint32_t at, const Brick& pixels, std::uint64_t count) {
    if (wide_) {
        WidePlanes& brick = wide_brick_of(at);
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            add_sum(brick, i, sum_of(pixels[i], count));
        }
        return;
    }
    const auto repeats = static_cast<std::uint32_t>(count);
    const bool opaque = is_opaque(pixels);
    if (nodes_[at].brick == kNoDetail) {
        nodes_[at].brick = static_cast<std::uint32_t>(narrow_bricks_.size());
        NarrowSums& brick = narrow_bricks_.emplace_back();
        brick.opaque = opaque;
        (opaque ? set_opaque : set_pixels)(pixels, repeats, brick.planes);
        return;
    }
    NarrowSums& brick = narrow_bricks_[nodes_[at].brick];
    if (!opaque) weigh(brick, static_cast<std::uint64_t>(frames_));
    (brick.opaque ? add_opaque : add_pixels)(pixels, repeats, brick.planes);
}

void SumTree::add_brick(std::uint32_t at, const NarrowSums& sums, std::uint64_t count) {
    if (wide_) {
        WidePlanes& brick = wide_brick_of(at);
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            add_sum(brick, i, sum_at(sums.planes, sums.opaque, count, i));
        }
        return;
    }
    if (nodes_[at].brick == kNoDetail) {
        nodes_[at].brick = static_cast<std::uint32_t>(narrow_bricks_.size());
        NarrowSums& brick = narrow_bricks_.emplace_back();
        brick.opaque = sums.opaque;
        std::copy_n(sums.planes.begin(), sums.opaque ? 3 : 4, brick.planes.begin());
        return;
    }
    NarrowSums& brick = narrow_bricks_[nodes_[at].brick];
    if (!sums.opaque) weigh(brick, static_cast<std::uint64_t>(frames_));
    if (sums.opaque && !brick.opaque) {
        NarrowSums weighed = sums;
        weigh(weighed, count);
        add_planes(weighed.planes, 4, brick.planes);
    } else {
        add_planes(sums.planes, brick.opaque ? 3 : 4, brick.planes);
    }
}

void SumTree::add_brick(std::uint32_t at, const WidePlanes& sums, std::uint64_t) {
    assert(wide_);
    WidePlanes& brick = wide_brick_of(at);
    for (std::size_t plane = 0; plane < sums.size(); ++plane) {
        for (std::size_t i = 0; i < kBrickPixels; ++i) brick[plane][i] += sums[plane][i];
    }
}

WidePlanes& SumTree::wide_brick_of(std::uint32_t at) {
    if (nodes_[at].brick == kNoDetail) {
        nodes_[at].brick = static_cast<std::uint32_t>(wide_bricks_.size());
        return wide_bricks_.emplace_back(WidePlanes{});
    }
    return wide_bricks_[nodes_[at].brick];
}

// The child below a quadrant: made, if need be, of what was added to the quadrant so far.
std::uint32_t SumTree::split(std::uint32_t at, std::size_t quadrant) {
    if (nodes_[at].child[quadrant] != kNoDetail) return nodes_[at].child[quadrant];
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].child[quadrant] = child;
    const std::uint32_t brick = nodes_[at].brick;
    nodes_.emplace_back();
    if (brick == kNoDetail) return child;
    if (wide_) {
        nodes_[child].brick = static_cast<std::uint32_t>(wide_bricks_.size());
        wide_bricks_.push_back(quadrant_of(wide_bricks_[brick], quadrant));
    } else {
        nodes_[child].brick = static_cast<std::uint32_t>(narrow_bricks_.size());
        narrow_bricks_.push_back(quadrant_of(narrow_bricks_[brick], quadrant));
    }
    return child;
}

void SumTree::widen() {
    wide_ = true;
    for (const NarrowSums& sums : narrow_bricks_) {
        WidePlanes& brick = wide_bricks_.emplace_back(WidePlanes{});
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            add_sum(
                brick,
                i,
                sum_at(sums.planes, sums.opaque, static_cast<std::uint64_t>(frames_), i));
        }
    }
    narrow_bricks_.clear();
}

}  // namespace haarmony::video
