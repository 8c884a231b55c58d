#include "engine/video/tree_writer.h"

#include <algorithm>
#include <cstddef>

namespace haarmony::video {
namespace {

constexpr std::size_t kSide = kBrickSide;
constexpr std::size_t kHalf = kBrickSide / 2;

// Whether each 2 x 2 pixels are of one colour.
bool is_flat(const Brick& brick) {
    for (std::size_t y = 0; y < kSide; y += 2) {
        const Rgba* const upper = &brick[y * kSide];
        if (!std::equal(upper, upper + kSide, upper + kSide)) return false;
        for (std::size_t x = 0; x < kSide; x += 2) {
            if (upper[x] != upper[x + 1]) return false;
        }
    }
    return true;
}

std::array<Rgba, kBrickPixels / 4> first_of_each_four(const Brick& brick) {
    std::array<Rgba, kBrickPixels / 4> pixels;
    for (std::size_t y = 0; y < kHalf; ++y) {
        for (std::size_t x = 0; x < kHalf; ++x) {
            pixels[y * kHalf + x] = brick[2 * y * kSide + 2 * x];
        }
    }
    return pixels;
}

std::uint32_t next(std::size_t size) { return static_cast<std::uint32_t>(size); }

}  // namespace

TreeWriter::TreeWriter(ImageTree& tree) : tree_(tree) {
    tree_.nodes.clear();
    tree_.bricks.clear();
    tree_.root = kNoDetail;
}

TreePart TreeWriter::add(const Brick& brick) {
    TreePart part{.node = kNoDetail, .pixels = first_of_each_four(brick)};
    if (is_flat(brick)) return part;
    part.node = next(tree_.nodes.size());
    tree_.nodes.push_back({.brick = next(tree_.bricks.size())});
    tree_.bricks.push_back(brick);
    return part;
}

TreePart TreeWriter::join(const std::array<TreePart, 4>& quadrants) {
    Brick brick;
    TreeNode node;
    bool has_detail = false;
    bool has_all = true;
    for (std::size_t q = 0; q < 4; ++q) {
        Rgba* const corner = &brick[(q >> 1) * kHalf * kSide + (q & 1) * kHalf];
        for (std::size_t y = 0; y < kHalf; ++y) {
            std::copy_n(&quadrants[q].pixels[y * kHalf], kHalf, corner + y * kSide);
        }
        node.child[q] = quadrants[q].node;
        has_detail |= node.child[q] != kNoDetail;
        has_all &= node.child[q] != kNoDetail;
    }
    if (!has_detail) return add(brick);
    if (!has_all) {
        node.brick = next(tree_.bricks.size());
        tree_.bricks.push_back(brick);
    }
    const TreePart part{.node = next(tree_.nodes.size()),
                        .pixels = first_of_each_four(brick)};
    tree_.nodes.push_back(node);
    return part;
}

void TreeWriter::finish(const TreePart& root) {
    tree_.root = root.node;
    if (root.node != kNoDetail) return;
    Brick& brick = tree_.bricks.emplace_back();
    for (std::size_t i = 0; i < brick.size(); ++i) {
        brick[i] = root.pixels[i / kSide / 2 * kHalf + i % kSide / 2];
    }
    tree_.root = next(tree_.nodes.size());
    tree_.nodes.push_back({.brick = next(tree_.bricks.size()) - 1});
}

}  // namespace haarmony::video
