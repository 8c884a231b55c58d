#include "tests/engine/video/ops/plain_trees.h"

#include <algorithm>

namespace haarmony::video::testing {
namespace {

int levels_of(const FrameFormat& format) {
    int levels = 0;
    while ((1 << levels) < std::max(format.width, format.height)) ++levels;
    return levels;
}

std::uint32_t scrambled(std::uint32_t value) {
    value = (value ^ value >> 16) * 0x7FEB352DU;
    value = (value ^ value >> 15) * 0x846CA68BU;
    return value ^ value >> 16;
}

// Few colours, so that neighbours are often alike.
Rgba color_of(std::uint32_t bits) {
    const std::uint32_t kind = bits >> 24 & 7;
    const std::uint32_t alpha = kind < 2 ? 0 : kind < 6 ? 255 : bits >> 8 & 255;
    return canonical({static_cast<std::uint8_t>(bits & 0xC0),
                      static_cast<std::uint8_t>(bits >> 8 & 0x80),
                      static_cast<std::uint8_t>(bits >> 16 & 0x80),
                      static_cast<std::uint8_t>(alpha)});
}

struct Grower {
    FrameFormat format;
    int unit;  // units in a finest pixel
    std::uint32_t seed;
    ImageTree tree;

    // Of a square of units: the same for all units of one finest pixel.
    [[nodiscard]] std::uint32_t random(int x, int y, int side) const {
        return scrambled(scrambled(scrambled(seed + static_cast<std::uint32_t>(side)) +
                                   static_cast<std::uint32_t>(x / unit)) +
                         static_cast<std::uint32_t>(y / unit));
    }
    [[nodiscard]] bool inside(int x, int y, int side) const {
        return (x + side - 1) / unit < format.width &&
               (y + side - 1) / unit < format.height;
    }
    std::uint32_t grow(int x, int y, int side) {
        TreeNode node;
        const int cell = side / kBrickSide, half = side / 2;
        Brick brick{};
        for (int i = 0; i < kBrickPixels; ++i) {
            const int px = x + i % kBrickSide * cell, py = y + i / kBrickSide * cell;
            if (!inside(px, py, cell)) continue;
            brick[static_cast<std::size_t>(i)] = color_of(random(px, py, cell));
        }
        node.brick = static_cast<std::uint32_t>(tree.bricks.size());
        tree.bricks.push_back(brick);
        for (int q = 0; q < 4 && half >= kBrickSide; ++q) {
            const int qx = x + (q & 1) * half, qy = y + (q >> 1) * half;
            if (!inside(qx, qy, half) || random(qx, qy, half) % 2 == 0) {
                node.child[static_cast<std::size_t>(q)] = grow(qx, qy, half);
            }
        }
        tree.nodes.push_back(node);
        return static_cast<std::uint32_t>(tree.nodes.size() - 1);
    }
};

bool pruned_below(const ImageTree& tree, std::uint32_t index) {
    const TreeNode& node = tree.nodes[index];
    bool children = false;
    for (const std::uint32_t child : node.child) {
        if (child == kNoDetail) continue;
        children = true;
        if (!pruned_below(tree, child)) return false;
    }
    if (children || index == tree.root) return true;
    const Brick& brick = tree.bricks[node.brick];
    for (std::size_t y = 0; y < 8; y += 2) {
        for (std::size_t x = 0; x < 8; x += 2) {
            const Rgba first = brick[y * 8 + x];
            if (brick[y * 8 + x + 1] != first || brick[y * 8 + x + 8] != first ||
                brick[y * 8 + x + 9] != first) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

ImageTree random_tree(const FrameFormat& format, std::uint32_t seed) {
    const int levels = levels_of(format);
    Grower grower{format, 1 << std::max(0, 3 - levels), seed, {}};
    grower.tree.root = grower.grow(0, 0, 1 << std::max(3, levels));
    return grower.tree;
}

bool is_pruned(const ImageTree& tree) { return pruned_below(tree, tree.root); }

Picture placed_pixels(const Picture& picture,
                      int repeat_x,
                      int repeat_y,
                      std::int64_t dx,
                      std::int64_t dy,
                      const FrameFormat& canvas) {
    Picture placed(canvas.width, canvas.height);
    for (std::int32_t y = 0; y < canvas.height; ++y) {
        for (std::int32_t x = 0; x < canvas.width; ++x) {
            const std::int64_t u = x - dx, v = y - dy;
            if (u < 0 || v < 0 || u / repeat_x >= picture.width ||
                v / repeat_y >= picture.height) {
                continue;
            }
            placed.at(x, y) = picture.at(static_cast<std::int32_t>(u / repeat_x),
                                         static_cast<std::int32_t>(v / repeat_y));
        }
    }
    return placed;
}

}  // namespace haarmony::video::testing
