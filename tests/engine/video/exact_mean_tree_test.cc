// Which nodes exact means have, which of them both edge rules share, and their bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "engine/video/create_frame.h"
#include "engine/video/exact_mean.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video::testing {
namespace {

constexpr Edge kEdgeRules[] = {Edge::kPad, Edge::kNormalize};

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

TEST(ExactMeanTree, AQuadrantHasAChildExactlyWhereSomethingFinerDiffers) {
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

// Nodes of the two trees at the same place: which squares have one of their own in each.
void expect_shared(const ExactFrame& frame,
                   const FrameFormat& format,
                   std::uint32_t pad,
                   std::uint32_t normalize,
                   std::int64_t x,
                   std::int64_t y,
                   std::int64_t side) {
    const bool outside = x >= format.width || y >= format.height;
    const bool crossed =
        !outside && (x + side > format.width || y + side > format.height);
    if (!crossed) {
        ASSERT_EQ(pad, normalize) << x << " " << y << ", " << side << " pixels";
    }
    if (pad == normalize) return;
    for (std::size_t q = 0; q < 4; ++q) {
        const std::uint32_t a = frame.nodes[pad].child[q];
        const std::uint32_t b = frame.nodes[normalize].child[q];
        if (a == kNoDetail || b == kNoDetail) continue;
        const std::int64_t half = side / 2;
        expect_shared(frame,
                      format,
                      a,
                      b,
                      x + half * static_cast<std::int64_t>(q & 1),
                      y + half * static_cast<std::int64_t>(q >> 1),
                      half);
    }
}

TEST(ExactMeanTree, TheTreesShareNodesThatNoEdgeCrosses) {
    for (const RawClip& clip : {random_clip(70, 33, 2, 71),
                                opaque(random_clip(64, 64, 2, 72)),
                                opaque(random_clip(40, 64, 1, 73)),
                                blocks(90, 100, 2, 74)}) {
        const ExactFrame frame = mean_of(clip);
        expect_shared(frame,
                      clip.format,
                      frame.root[0],
                      frame.root[1],
                      0,
                      0,
                      std::int64_t{1} << shape_of(clip).space_levels());
        std::vector<int> uses(frame.nodes.size());
        for (const std::uint32_t root : frame.root) ++uses[root];
        for (const TreeNode& node : frame.nodes) {
            for (const std::uint32_t child : node.child) {
                if (child != kNoDetail) ++uses[child];
            }
        }
        for (const int count : uses) ASSERT_GE(count, 1);
    }
}

TEST(ExactMeanTree, BoundsAreThoseOfWhatIsNotClear) {
    std::uint32_t seed = 90;
    for (const auto& [width, height] : {std::array{1, 1},
                                        std::array{3, 2},
                                        std::array{5, 5},
                                        std::array{30, 50},
                                        std::array{128, 20}}) {
        for (int dots = 0; dots <= 3; ++dots) {
            RawClip clip{{width, height, {}}, {Picture(width, height)}};
            std::mt19937 random(++seed);
            for (int i = 0; i < dots; ++i) {
                clip.frames[0].at(static_cast<int>(random() % unsigned(width)),
                                  static_cast<int>(random() % unsigned(height))) = {
                    1, 2, 3, 4};
            }
            Bounds want{width, height, 0, 0};
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    if (clip.frames[0].at(x, y).a == 0) continue;
                    want.left = std::min(want.left, x);
                    want.top = std::min(want.top, y);
                    want.right = std::max(want.right, x + 1);
                    want.bottom = std::max(want.bottom, y + 1);
                }
            }
            if (dots == 0) want = {};
            EXPECT_EQ(mean_of(clip).bounds, want) << width << " x " << height;
        }
    }
}

// A dot that is there for less than half a level's time is not seen, nor counted.
TEST(ExactMeanTree, BoundsAreOfWhatIsLeftAfterRounding) {
    Picture dots(16, 16);
    dots.at(3, 4) = {9, 9, 9, 255};
    dots.at(12, 13) = {9, 9, 9, 254};
    const FrameFormat format{16, 16, {}};
    FrameSum sum(format);
    sum.add(tree_of(dots), 1);
    sum.add(tree_of(Picture(16, 16)), 509);
    ExactFrame frame;
    sum.mean_into(frame);
    EXPECT_EQ(pixel_of(frame, Edge::kPad, 4, 3, 4), (Rgba{9, 9, 9, 1}));
    EXPECT_EQ(frame.bounds, (Bounds{3, 4, 4, 5}));
}

TEST(ExactMeanTree, AClearClipIsOneBrick) {
    const ExactFrame frame = mean_of({{300, 200, {}}, {Picture(300, 200)}});
    EXPECT_EQ(frame.nodes.size(), 1U);
    EXPECT_EQ(frame.bricks.size(), 1U);
    EXPECT_TRUE(frame.bounds.empty());
}

}  // namespace
}  // namespace haarmony::video::testing
