#include "engine/video/exact_mean.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "engine/video/create_frame.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video::testing {
namespace {

constexpr Edge kEdgeRules[] = {Edge::kPad, Edge::kNormalize};

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

void expect_exact(const RawClip& clip, const ExactFrame& frame) {
    for (int level = 0; level <= shape_of(clip).space_levels(); ++level) {
        for (const Edge edge : kEdgeRules) {
            ASSERT_EQ(picture_of(frame, clip.format, level, edge),
                      exact_picture(clip, {0, 0}, level, edge))
                << clip.format.width << " x " << clip.format.height << " x "
                << clip.frames.size() << ", level " << level << ", edge " << int(edge);
        }
    }
}

// Grey levels that share many bricks, flat squares and edges between them.
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

TEST(ExactMean, IsTheDefinitionOfEveryShape) {
    constexpr int kSizes[][2] = {{1, 1},
                                 {1, 2},
                                 {3, 2},
                                 {4, 4},
                                 {5, 7},
                                 {8, 8},
                                 {9, 1},
                                 {13, 9},
                                 {16, 16},
                                 {5, 40},
                                 {33, 20},
                                 {32, 64}};
    std::uint32_t seed = 1;
    for (const auto& [width, height] : kSizes) {
        for (const int frames : {1, 3, 4, 7}) {
            const RawClip random = random_clip(width, height, frames, ++seed);
            expect_exact(random, mean_of(random));
            const RawClip still =
                opaque(random_clip(width, height, frames, ++seed, true));
            expect_exact(still, mean_of(still));
            const RawClip squares = blocks(width, height, frames, seed += 10);
            expect_exact(squares, mean_of(squares));
        }
    }
}

// A root square at a level, what is outside the cropped picture clear.
struct Square {
    Picture cropped;
    [[nodiscard]] Rgba at(int x, int y) const {
        return x < cropped.width && y < cropped.height ? cropped.at(x, y) : kClear;
    }
};

void expect_pruned(const std::vector<Square>& levels,
                   const ExactFrame& frame,
                   std::uint32_t at,
                   int level,
                   int x,
                   int y) {
    const TreeNode& node = frame.nodes[at];
    ASSERT_NE(node.brick, kNoDetail);
    for (int q = 0; q < 4; ++q) {
        const int left = 8 * x + 4 * (q & 1), top = 8 * y + 4 * (q >> 1);
        bool differs = false;
        for (std::size_t l = static_cast<std::size_t>(level) + 1; l < levels.size();
             ++l) {
            const int below = static_cast<int>(l) - level;
            for (int v = top << below; v < (top + 4) << below; ++v) {
                for (int u = left << below; u < (left + 4) << below; ++u) {
                    differs |= levels[l].at(u, v) != levels[l - 1].at(u >> 1, v >> 1);
                }
            }
        }
        const std::uint32_t child = node.child[static_cast<std::size_t>(q)];
        ASSERT_EQ(child != kNoDetail, differs)
            << "level " << level << ", brick " << x << " " << y << ", quadrant " << q;
        if (differs) {
            expect_pruned(
                levels, frame, child, level + 1, 2 * x + (q & 1), 2 * y + (q >> 1));
        }
    }
}

TEST(ExactMean, AQuadrantHasAChildExactlyWhereSomethingFinerDiffers) {
    for (const RawClip& clip : {random_clip(33, 20, 3, 5),
                                opaque(random_clip(70, 40, 2, 6, true)),
                                blocks(64, 64, 1, 7),
                                blocks(50, 64, 2, 8),
                                blocks(9, 90, 3, 9)}) {
        const ExactFrame frame = mean_of(clip);
        for (const Edge edge : kEdgeRules) {
            std::vector<Square> levels;
            for (int level = 0; level <= shape_of(clip).space_levels(); ++level) {
                levels.push_back({exact_picture(clip, {0, 0}, level, edge)});
            }
            expect_pruned(levels,
                          frame,
                          frame.root[static_cast<std::size_t>(edge)],
                          kBrickLevel,
                          0,
                          0);
        }
    }
}

TEST(ExactMean, SumsAddUp) {
    const RawClip clip = blocks(50, 40, 7, 60);
    FrameSum all(clip.format), first(clip.format), rest(clip.format);
    for (std::size_t t = 0; t < clip.frames.size(); ++t) {
        const ImageTree tree = tree_of(clip.frames[t]);
        all.add(tree, 1);
        (t < 3 ? first : rest).add(tree, 1);
    }
    first.add(rest);
    EXPECT_EQ(first.frames(), 7);
    ExactFrame a, b;
    all.mean_into(a);
    first.mean_into(b);
    EXPECT_EQ(a, b);
}

TEST(ExactMean, AnEmptySumAddsNothing) {
    const RawClip clip = random_clip(20, 20, 1, 61);
    FrameSum sum(clip.format), empty(clip.format);
    sum.add(tree_of(clip.frames[0]), 1);
    sum.add(empty);
    EXPECT_EQ(sum.frames(), 1);
    empty.add(sum);
    ExactFrame a, b;
    sum.mean_into(a);
    empty.mean_into(b);
    EXPECT_EQ(a, b);
    expect_exact(clip, a);
}

TEST(ExactMean, AFrameThatStaysCountsAsOften) {
    RawClip clip = blocks(40, 20, 2, 62);
    FrameSum sum(clip.format);
    sum.add(tree_of(clip.frames[0]), 5);
    sum.add(tree_of(clip.frames[1]), 2);
    EXPECT_EQ(sum.frames(), 7);
    ExactFrame frame;
    sum.mean_into(frame);
    clip.frames.insert(clip.frames.begin(), 4, clip.frames[0]);
    clip.frames.push_back(clip.frames.back());
    expect_exact(clip, frame);
}

TEST(ExactMean, AClearedSumIsAsNew) {
    const RawClip clip = random_clip(30, 20, 2, 63);
    FrameSum sum(clip.format);
    sum.add(tree_of(clip.frames[0]), 3);
    ExactFrame frame;
    sum.mean_into(frame);
    sum.clear();
    EXPECT_EQ(sum.frames(), 0);
    sum.add(tree_of(clip.frames[1]), 1);
    sum.mean_into(frame);
    expect_exact({clip.format, {clip.frames[1]}}, frame);
}

}  // namespace
}  // namespace haarmony::video::testing
