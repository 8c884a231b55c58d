// Trees scaled and moved, against every pixel repeated and moved on its own.
#include "engine/video/ops/place.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/video/tree_writer.h"
#include "tests/engine/video/ops/plain_trees.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

using testing::is_pruned;
using testing::picture_of;
using testing::placed_pixels;
using testing::random_tree;

int levels_of(const FrameFormat& format) {
    return ClipShape::make(format, 1).value().space_levels();
}

ImageTree flat_tree(Rgba color) {
    ImageTree tree;
    TreePart part;
    part.pixels.fill(color);
    TreeWriter(tree).finish(part);
    return tree;
}

TEST(Place, EqualsPixelsRepeatedAndMoved) {
    std::mt19937 random(5);
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        const auto side = [&](int most) { return static_cast<int>(1 + random() % most); };
        const FrameFormat format{side(70), side(70), {25, 1}};
        const FrameFormat canvas{side(150), side(150), {25, 1}};
        const int sx = side(seed % 3 == 0 ? 1 : 5), sy = side(seed % 3 == 0 ? 1 : 5);
        const std::int64_t dx = static_cast<std::int64_t>(random() % 121) - 60;
        const std::int64_t dy = static_cast<std::int64_t>(random() % 121) - 60;
        const ImageTree tree = random_tree(format, seed);
        ImageTree placed;
        place(tree, levels_of(format), {sx, sy, dx, dy, 0}, canvas, placed);
        ASSERT_EQ(picture_of(placed, canvas),
                  placed_pixels(picture_of(tree, format), sx, sy, dx, dy, canvas))
            << format.width << "x" << format.height << " by " << sx << "," << sy << " at "
            << dx << "," << dy << " on " << canvas.width << "x" << canvas.height;
        ASSERT_TRUE(is_pruned(placed)) << seed;
    }
}

TEST(Place, ByMultiplesOfLargePixelsNeedsNoFinerOnes) {
    const FrameFormat format{1024, 1024, {25, 1}};
    ImageTree tree = random_tree({8, 8, {25, 1}}, 3);
    ImageTree placed;
    const Visited visited = place(tree, 10, {1, 1, 256, -128, 0}, format, placed);
    EXPECT_EQ(placed.bricks.size(), 1U);
    EXPECT_EQ(visited.written, 1);
}

TEST(Place, HalvingsShowThePixelInTheMiddle) {
    const FrameFormat format{40, 24, {25, 1}};
    const FrameFormat canvas{20, 12, {25, 1}};
    const ImageTree tree = random_tree(format, 8);
    const Picture from = picture_of(tree, format);
    ImageTree placed;
    place(tree, levels_of(format), {1, 1, 1, 1, 1}, canvas, placed);
    const Picture to = picture_of(placed, canvas);
    for (std::int32_t y = 0; y < canvas.height; ++y) {
        for (std::int32_t x = 0; x < canvas.width; ++x) {
            ASSERT_EQ(to.at(x, y), from.at(2 * x, 2 * y)) << x << "," << y;
        }
    }
}

TEST(Place, WhatLiesBeyondTheCanvasIsGone) {
    ImageTree placed;
    const Visited visited =
        place(flat_tree({1, 2, 3, 255}), 6, {1, 1, -64, 0, 0}, {64, 64, {25, 1}}, placed);
    EXPECT_EQ(placed.bricks[placed.nodes[placed.root].brick], Brick{});
    EXPECT_LE(visited.read + visited.written, 2);
}

TEST(Place, TwiceTheFlatBackgroundIsFree) {
    // A detailed corner on a flat background that grows, moved by an odd number of
    // pixels.
    std::vector<std::int64_t> visits;
    for (int levels = 10; levels <= 16; ++levels) {
        const FrameFormat format{1 << levels, 1 << levels, {25, 1}};
        // 64 x 64 pixels of detail in the middle of nothing, as far down as there are
        // levels.
        const ImageTree detail = random_tree({64, 64, {25, 1}}, 1);
        ImageTree tree, placed;
        place(detail, 6, {1, 1, 512, 512, 0}, format, tree);
        const Visited visited = place(tree, levels, {1, 1, 3, 5, 0}, format, placed);
        visits.push_back(visited.read + visited.written);
    }
    for (std::size_t i = 1; i < visits.size(); ++i) {
        // Four times the area is one more level to walk down.
        EXPECT_LE(visits[i] - visits[i - 1], 100) << visits[i];
    }
}

TEST(Place, VisitsAreLinearInTheDetail) {
    std::vector<double> per_node;
    for (int side = 64; side <= 512; side *= 2) {
        const FrameFormat format{side, side, {25, 1}};
        const ImageTree tree = random_tree(format, 2);
        ImageTree placed;
        const Visited visited = place(
            tree, levels_of(format), {3, 2, 7, 9, 0}, {2048, 2048, {25, 1}}, placed);
        per_node.push_back(static_cast<double>(visited.read + visited.written) /
                           static_cast<double>(tree.nodes.size() + placed.nodes.size()));
    }
    for (const double ratio : per_node) EXPECT_LT(ratio, 20.0);
    EXPECT_LT(per_node.back(), 1.2 * per_node.front());
}

}  // namespace
}  // namespace haarmony::video
