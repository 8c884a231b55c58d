#include "tests/engine/video/tree_pixels.h"

#include <algorithm>
#include <random>
#include <utility>

#include "engine/video/exact_mean.h"

namespace haarmony::video::testing {
namespace {

int levels_of(const FrameFormat& format) {
    return (*ClipShape::make(format, 1)).space_levels();
}

// Pixel (x, y) of a level, below a node of level 3.
template <typename Tree>
Rgba below(const Tree& tree, std::uint32_t root, int level, int x, int y) {
    const TreeNode* node = &tree.nodes[root];
    int depth = level - kBrickLevel;
    while (depth > 0) {
        const int q = (x >> (depth + 2) & 1) + 2 * (y >> (depth + 2) & 1);
        const std::uint32_t child = node->child[static_cast<std::size_t>(q)];
        if (child == kNoDetail) break;
        node = &tree.nodes[child];
        --depth;
    }
    const int column = x >> depth & 7, row = y >> depth & 7;
    return tree.bricks[node->brick][static_cast<std::size_t>(row * kBrickSide + column)];
}

void split_at_random(const FrameFormat& format,
                     int level,
                     int x,
                     int y,
                     std::mt19937& random,
                     std::vector<LeafSquare>& leaves) {
    const int levels = levels_of(format);
    if (x << (levels - level) >= format.width || y << (levels - level) >= format.height) {
        return;
    }
    if (level < levels && random() % 4 != 0) {
        for (int q = 0; q < 4; ++q) {
            split_at_random(
                format, level + 1, 2 * x + (q & 1), 2 * y + (q >> 1), random, leaves);
        }
        return;
    }
    const auto bits = static_cast<std::uint32_t>(random());
    if (bits % 8 == 0) return;
    const auto shade = [bits](int shift) {
        return static_cast<std::uint8_t>(bits >> shift & 192);
    };
    leaves.push_back({level, x, y, {shade(8), shade(12), shade(16), shade(20)}});
}

}  // namespace

int finest_level(const FrameFormat& format) {
    return std::max(levels_of(format), kBrickLevel);
}

Rgba pixel_of(const ImageTree& tree, int finest, int x, int y) {
    return below(tree, tree.root, finest, x, y);
}

Rgba pixel_of(const ExactFrame& frame, Edge edge, int level, int x, int y) {
    const auto e = static_cast<std::size_t>(edge);
    if (level >= kBrickLevel) return below(frame, frame.root[e], level, x, y);
    return frame.apex[e][static_cast<std::size_t>(apex_offset(level) + (y << level) + x)];
}

Picture picture_of(const ImageTree& tree, const FrameFormat& format) {
    const int finest = finest_level(format), scale = finest - levels_of(format);
    Picture picture(format.width, format.height);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            picture.at(x, y) = pixel_of(tree, finest, x << scale, y << scale);
        }
    }
    return picture;
}

Picture picture_of(const ExactFrame& frame,
                   const FrameFormat& format,
                   int level,
                   Edge edge) {
    const ClipShape shape = *ClipShape::make(format, 1);
    Picture picture(shape.width_at(level), shape.height_at(level));
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            picture.at(x, y) = pixel_of(frame, edge, level, x, y);
        }
    }
    return picture;
}

std::vector<LeafSquare> random_leaves(const FrameFormat& format, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<LeafSquare> leaves;
    split_at_random(format, 0, 0, 0, random, leaves);
    std::shuffle(leaves.begin(), leaves.end(), random);
    return leaves;
}

Picture painted(const std::vector<LeafSquare>& leaves, const FrameFormat& format) {
    Picture picture(format.width, format.height);
    for (const LeafSquare& leaf : leaves) {
        const int side = 1 << (levels_of(format) - leaf.level);
        for (int y = leaf.y * side; y < std::min((leaf.y + 1) * side, format.height);
             ++y) {
            for (int x = leaf.x * side; x < std::min((leaf.x + 1) * side, format.width);
                 ++x) {
                picture.at(x, y) = canonical(leaf.color);
            }
        }
    }
    return picture;
}

RawClip blocks(int width, int height, int frames, std::uint32_t seed) {
    RawClip clip{{width, height, {25, 1}}, {}};
    for (int t = 0; t < frames; ++t) {
        clip.frames.push_back(
            painted(random_leaves(clip.format, seed + static_cast<std::uint32_t>(t)),
                    clip.format));
    }
    return clip;
}

RawClip opaque(RawClip clip) {
    for (Picture& frame : clip.frames) {
        for (Rgba& pixel : frame.pixels) pixel.a = 255;
    }
    return clip;
}

ImageTree tree_of(const Picture& picture) {
    ImageTree tree;
    create_frame(picture.view(), tree);
    return tree;
}

ExactFrame mean_of(const RawClip& clip) {
    FrameSum sum(clip.format);
    for (const Picture& frame : clip.frames) sum.add(tree_of(frame), 1);
    ExactFrame frame;
    sum.mean_into(frame);
    return frame;
}

}  // namespace haarmony::video::testing
