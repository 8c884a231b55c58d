#include "engine/video/create_frame.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video::testing {
namespace {

constexpr int kSizes[][2] = {{1, 1},
                             {2, 1},
                             {3, 3},
                             {5, 7},
                             {8, 8},
                             {9, 3},
                             {17, 40},
                             {64, 64},
                             {70, 5},
                             {100, 60}};

TEST(CreateFrame, ShowsThePicture) {
    std::uint32_t seed = 1;
    for (const auto& [width, height] : kSizes) {
        const RawClip clip = random_clip(width, height, 1, ++seed);
        EXPECT_EQ(picture_of(tree_of(clip.frames[0]), clip.format), clip.frames[0])
            << width << " x " << height;
        const FrameFormat format{width, height, {}};
        const Picture squares = painted(random_leaves(format, ++seed), format);
        EXPECT_EQ(picture_of(tree_of(squares), format), squares)
            << width << " x " << height;
    }
}

TEST(CreateFrame, OutsideThePictureIsClear) {
    for (const auto& [width, height] : kSizes) {
        Picture picture(width, height);
        for (Rgba& pixel : picture.pixels) pixel = {7, 8, 9, 255};
        const FrameFormat format{width, height, {}};
        const ImageTree tree = tree_of(picture);
        const int finest = finest_level(format);
        const int scale = finest - (*ClipShape::make(format, 1)).space_levels();
        for (int y = 0; y < 1 << finest; ++y) {
            for (int x = 0; x < 1 << finest; ++x) {
                const bool inside = x >> scale < width && y >> scale < height;
                ASSERT_EQ(pixel_of(tree, finest, x, y),
                          inside ? picture.at(0, 0) : kClear);
            }
        }
    }
}

// What is clear in straight colour too.
TEST(CreateFrame, ClearPixelsLoseTheirColour) {
    Picture picture(9, 9);
    std::mt19937 random(3);
    for (Rgba& pixel : picture.pixels) {
        const auto bits = static_cast<std::uint32_t>(random());
        pixel = {static_cast<std::uint8_t>(bits),
                 static_cast<std::uint8_t>(bits >> 8),
                 static_cast<std::uint8_t>(bits >> 16),
                 static_cast<std::uint8_t>(bits >> 24 & 1)};
    }
    const Picture shown = picture_of(tree_of(picture), {9, 9, {}});
    for (int i = 0; i < 81; ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_EQ(shown.pixels[at],
                  picture.pixels[at].a == 0 ? kClear : picture.pixels[at]);
    }
}

TEST(CreateFrame, ThreeChannelsAreOpaqueAndRowsMayBePadded) {
    constexpr int kWidth = 13, kHeight = 10, kStride = 3 * kWidth + 5;
    std::mt19937 random(4);
    std::vector<std::uint8_t> rows(kStride * kHeight);
    for (std::uint8_t& byte : rows) byte = static_cast<std::uint8_t>(random());
    ImageTree tree;
    create_frame({rows.data(), kWidth, kHeight, 3, kStride}, tree);
    const Picture shown = picture_of(tree, {kWidth, kHeight, {}});
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::uint8_t* const in =
                &rows[static_cast<std::size_t>(y * kStride + 3 * x)];
            ASSERT_EQ(shown.at(x, y), (Rgba{in[0], in[1], in[2], 255}));
        }
    }
}

// A quadrant has a child exactly where one of its pixels is more than one flat square.
void expect_pruned(const Picture& picture,
                   const ImageTree& tree,
                   std::uint32_t at,
                   int below,
                   int x,
                   int y) {
    const auto color = [&picture](int u, int v) {
        return u < picture.width && v < picture.height ? picture.at(u, v) : kClear;
    };
    for (int q = 0; q < 4; ++q) {
        const int left = 8 * x + 4 * (q & 1), top = 8 * y + 4 * (q >> 1);
        bool has_detail = false;
        for (int v = top << below; v < (top + 4) << below; ++v) {
            for (int u = left << below; u < (left + 4) << below; ++u) {
                has_detail |=
                    color(u, v) != color(u >> below << below, v >> below << below);
            }
        }
        const std::uint32_t child = tree.nodes[at].child[static_cast<std::size_t>(q)];
        ASSERT_EQ(child != kNoDetail, has_detail)
            << below << " levels above, brick " << x << " " << y << ", quadrant " << q;
        if (has_detail) {
            expect_pruned(
                picture, tree, child, below - 1, 2 * x + (q & 1), 2 * y + (q >> 1));
        } else {
            ASSERT_NE(tree.nodes[at].brick, kNoDetail);
        }
    }
}

TEST(CreateFrame, FlatRegionsCostNoDetail) {
    std::uint32_t seed = 20;
    for (const auto& [width, height] : kSizes) {
        const FrameFormat format{width, height, {}};
        if (finest_level(format) != (*ClipShape::make(format, 1)).space_levels())
            continue;
        const Picture picture = painted(random_leaves(format, ++seed), format);
        const ImageTree tree = tree_of(picture);
        expect_pruned(picture, tree, tree.root, finest_level(format) - kBrickLevel, 0, 0);
    }
    Picture flat(512, 512);
    for (Rgba& pixel : flat.pixels) pixel = {1, 2, 3, 4};
    EXPECT_EQ(tree_of(flat).nodes.size(), 1U);
    EXPECT_EQ(tree_of(flat).bricks.size(), 1U);
}

TEST(CreateFrame, LeavesMakeTheTreeOfTheirPicture) {
    std::uint32_t seed = 40;
    for (const auto& [width, height] : kSizes) {
        for (int round = 0; round < 8; ++round) {
            const FrameFormat format{width, height, {}};
            const std::vector<LeafSquare> leaves = random_leaves(format, ++seed);
            ImageTree tree;
            ASSERT_TRUE(create_frame(leaves, format, tree).has_value());
            const ImageTree want = tree_of(painted(leaves, format));
            EXPECT_EQ(tree.nodes, want.nodes) << width << " x " << height;
            EXPECT_EQ(tree.bricks, want.bricks);
            EXPECT_EQ(tree.root, want.root);
        }
    }
}

TEST(CreateFrame, NoLeavesAreAClearFrame) {
    ImageTree tree;
    ASSERT_TRUE(create_frame({}, {100, 60, {}}, tree).has_value());
    EXPECT_EQ(picture_of(tree, {100, 60, {}}), Picture(100, 60));
}

// One leaf larger than all levels between, in a picture that only fills a corner of it.
TEST(CreateFrame, ALeafIsCutAtTheEdgeOfThePicture) {
    const std::vector<LeafSquare> leaves = {{0, 0, 0, {9, 9, 9, 99}}};
    const FrameFormat format{67, 35, {}};
    ImageTree tree;
    ASSERT_TRUE(create_frame(leaves, format, tree).has_value());
    EXPECT_EQ(picture_of(tree, format), painted(leaves, format));
    EXPECT_EQ(pixel_of(tree, 7, 67, 34), kClear);
    EXPECT_EQ(pixel_of(tree, 7, 66, 35), kClear);
}

TEST(CreateFrame, AWrongLeafIsNamed) {
    struct Case {
        std::vector<LeafSquare> leaves;
        const char* message;
    };
    const LeafSquare good{2, 0, 0, {1, 2, 3, 4}};
    const Case cases[] = {
        {{good, {2, 4, 0, {}}},
         "leaf 1 (level 2, x 4, y 0) lies outside the root square"},
        {{good, {2, 0, 4, {}}},
         "leaf 1 (level 2, x 0, y 4) lies outside the root square"},
        {{{1, -1, 0, {}}}, "leaf 0 (level 1, x -1, y 0) lies outside the root square"},
        {{{1, 0, -7, {}}}, "leaf 0 (level 1, x 0, y -7) lies outside the root square"},
        {{{-1, 0, 0, {}}}, "leaf 0 (level -1, x 0, y 0) lies outside the root square"},
        {{{-2147483647 - 1, 0, 0, {}}},
         "leaf 0 (level -2147483648, x 0, y 0) lies outside the root square"},
        {{good, {5, 0, 0, {}}},
         "leaf 1 (level 5, x 0, y 0) is deeper than the 4 levels of the root square"},
        {{{2147483647, 0, 0, {}}},
         "leaf 0 (level 2147483647, x 0, y 0) is deeper than the 4 levels of the root "
         "square"},
        {{good, {2, 1, 1, {}}, good},
         "leaf 2 (level 2, x 0, y 0) overlaps leaf 0 (level 2, x 0, y 0)"},
        {{{4, 3, 2, {}}, good},
         "leaf 0 (level 4, x 3, y 2) overlaps leaf 1 (level 2, x 0, y 0)"},
        {{{4, 9, 9, {}}, {0, 0, 0, {}}},
         "leaf 0 (level 4, x 9, y 9) overlaps leaf 1 (level 0, x 0, y 0)"},
    };
    const FrameFormat format{16, 10, {}};
    for (const auto& [leaves, message] : cases) {
        ImageTree tree;
        ASSERT_TRUE(create_frame({&good, 1}, format, tree).has_value());
        const std::vector<Brick> before = tree.bricks;
        const Result<void> made = create_frame(leaves, format, tree);
        ASSERT_FALSE(made.has_value()) << message;
        EXPECT_EQ(made.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(made.error().message, message);
        EXPECT_EQ(made.error().param, "leaves");
        EXPECT_EQ(tree.bricks, before);
    }
}

// Below 8 x 8 the tree is scaled up, but a leaf may not use that.
TEST(CreateFrame, ALeafIsNoFinerThanThePixelsOfASmallPicture) {
    ImageTree tree;
    const std::vector<LeafSquare> pixel = {{1, 1, 0, {5, 6, 7, 255}}};
    ASSERT_TRUE(create_frame(pixel, {2, 2, {}}, tree).has_value());
    EXPECT_EQ(picture_of(tree, {2, 2, {}}), painted(pixel, {2, 2, {}}));
    const std::vector<LeafSquare> finer = {{2, 1, 0, {5, 6, 7, 255}}};
    EXPECT_FALSE(create_frame(finer, {2, 2, {}}, tree).has_value());
}

TEST(CreateFrame, ATreeIsUsedAgain) {
    const RawClip clip = random_clip(40, 30, 2, 9);
    ImageTree tree = tree_of(clip.frames[0]);
    create_frame(clip.frames[1].view(), tree);
    EXPECT_EQ(picture_of(tree, clip.format), clip.frames[1]);
    EXPECT_EQ(tree.nodes.size(), tree_of(clip.frames[1]).nodes.size());
}

}  // namespace
}  // namespace haarmony::video::testing
