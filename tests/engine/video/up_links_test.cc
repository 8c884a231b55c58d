#include "engine/video/up_links.h"

#include <gtest/gtest.h>

#include "tests/engine/video/plain_frame.h"

namespace haarmony::video {
namespace {

using testing::exact_frame;
using testing::random_clip;
using testing::RawClip;

std::size_t own_nodes(const UpLinks& links) {
    std::size_t nodes = 0;
    for (const Layer& layer : links.layers()) nodes += layer.nodes.size();
    return nodes;
}
std::size_t own_bricks(const UpLinks& links) {
    std::size_t bricks = 0;
    for (const Layer& layer : links.layers()) bricks += layer.bricks.size();
    return bricks;
}

ExactFrame single(const Picture& picture) {
    RawClip clip;
    clip.format = {picture.width, picture.height, {25, 1}};
    clip.frames.push_back(picture);
    return exact_frame(clip, {0, 0});
}

// A square of noise at (x, y) on black.
Picture patch(int side, int x, int y, std::uint32_t seed) {
    const Picture noise = random_clip(8, 8, 1, seed).frames[0];
    Picture picture(side, side);
    for (Rgba& pixel : picture.pixels) pixel = {0, 0, 0, 255};
    for (int v = 0; v < 8; ++v) {
        for (int u = 0; u < 8; ++u) picture.at(x + u, y + v) = noise.at(u, v);
    }
    return picture;
}

TEST(UpLinks, ARootWithoutAncestorsIsItsOwn) {
    UpLinks links(4, 0);
    links.descend();
    const ExactFrame frame = single(random_clip(16, 16, 1, 1).frames[0]);
    const Result<TimeNode> node = links.link(frame, nullptr);
    ASSERT_TRUE(node.has_value());
    EXPECT_EQ((*node).apex, frame.apex);
    EXPECT_EQ((*node).bounds, frame.bounds);
    // No edge crosses a square of 16: both trees are the same one.
    EXPECT_EQ((*node).root[0], (*node).root[1]);
    EXPECT_EQ(own_nodes(links), 5U);
    EXPECT_EQ(own_bricks(links), 5U);
}

TEST(UpLinks, TheSamePictureIsItsTimeParents) {
    UpLinks links(4, 0);
    const ExactFrame frame = single(random_clip(16, 13, 1, 2).frames[0]);
    links.descend();
    const Result<TimeNode> root = links.link(frame, nullptr);
    ASSERT_TRUE(root.has_value());
    links.descend();
    const Result<TimeNode> half = links.link(frame, &*root);
    ASSERT_TRUE(half.has_value());
    EXPECT_EQ((*half).root, (*root).root);
    EXPECT_EQ(own_nodes(links), 0U);
    EXPECT_EQ(own_bricks(links), 0U);
}

TEST(UpLinks, WhatTheBrotherHasIsNotHadTwice) {
    UpLinks links(4, 0);
    links.descend();
    const Result<TimeNode> root =
        links.link(single(random_clip(16, 16, 1, 3).frames[0]), nullptr);
    ASSERT_TRUE(root.has_value());
    links.descend();
    const ExactFrame frame = single(random_clip(16, 16, 1, 4).frames[0]);
    const Result<TimeNode> first = links.link(frame, &*root);
    const Result<TimeNode> second = links.link(frame, &*root);
    ASSERT_TRUE(first.has_value() && second.has_value());
    EXPECT_EQ((*first).root, (*second).root);
    EXPECT_EQ(time_level_of((*first).root[0]), 1);
    EXPECT_EQ(own_nodes(links), 5U);
}

TEST(UpLinks, AMovedPatchIsLinkedFromItsNewPlace) {
    UpLinks links(5, 0);
    links.descend();
    const Result<TimeNode> root = links.link(single(patch(32, 0, 0, 5)), nullptr);
    ASSERT_TRUE(root.has_value());
    const std::size_t patches = links.layers()[2].nodes.size();
    ASSERT_EQ(patches, 1U);
    links.descend();
    ASSERT_TRUE(links.link(single(patch(32, 16, 8, 5)), &*root).has_value());
    // Coarser bricks have it elsewhere and are new; the finest is the ancestor's.
    EXPECT_EQ(links.layers()[2].nodes.size(), 0U);
    EXPECT_EQ(links.layers()[2].bricks.size(), 0U);
    EXPECT_GT(own_nodes(links), 0U);
}

TEST(UpLinks, ABrickIsSharedBelowWhichDetailDiffers) {
    // Two frames whose level 3 is equal and whose level 4 is not.
    Picture first(16, 16), second(16, 16);
    for (int i = 0; i < 256; ++i) {
        const bool odd = (i + i / 16) % 2 == 1;
        first.pixels[static_cast<std::size_t>(i)] =
            odd ? Rgba{10, 0, 0, 255} : Rgba{20, 0, 0, 255};
        second.pixels[static_cast<std::size_t>(i)] =
            odd ? Rgba{20, 0, 0, 255} : Rgba{10, 0, 0, 255};
    }
    UpLinks links(4, 0);
    links.descend();
    const Result<TimeNode> root = links.link(single(first), nullptr);
    ASSERT_TRUE(root.has_value());
    links.descend();
    ASSERT_TRUE(links.link(single(second), &*root).has_value());
    ASSERT_EQ(links.layers()[0].nodes.size(), 1U);
    EXPECT_EQ(links.layers()[0].bricks.size(), 0U);
    EXPECT_EQ(time_level_of(links.layers()[0].nodes[0].brick), 0);
    EXPECT_EQ(links.layers()[1].bricks.size(), 1U);  // all four are equal
}

TEST(UpLinks, ContentOfCousinsIsForgotten) {
    UpLinks links(4, 0);
    links.descend();
    const Result<TimeNode> root =
        links.link(single(random_clip(16, 16, 1, 6).frames[0]), nullptr);
    ASSERT_TRUE(root.has_value());
    const ExactFrame frame = single(random_clip(16, 16, 1, 7).frames[0]);
    for (int cousin = 0; cousin < 3; ++cousin) {
        links.descend();
        const Result<TimeNode> node = links.link(frame, &*root);
        ASSERT_TRUE(node.has_value());
        // A ref into siblings that are not on the way from the root would dangle.
        EXPECT_EQ(time_level_of((*node).root[0]), 1);
        EXPECT_EQ(own_nodes(links), 5U);
        links.ascend();
    }
}

TEST(UpLinks, WithinDeltaIsLinkedAndBeyondIsNot) {
    Picture grey(16, 16), lighter(16, 16);
    for (int i = 0; i < 256; ++i) {
        const auto value = static_cast<std::uint8_t>(100 + i % 7);
        grey.pixels[static_cast<std::size_t>(i)] = {value, value, value, 255};
        const auto other = static_cast<std::uint8_t>(value + 3);
        lighter.pixels[static_cast<std::size_t>(i)] = {other, other, other, 255};
    }
    for (const std::uint32_t levels : {2U, 3U}) {
        UpLinks links(4, levels * kDifferenceOne);
        links.descend();
        const Result<TimeNode> root = links.link(single(grey), nullptr);
        ASSERT_TRUE(root.has_value());
        links.descend();
        const Result<TimeNode> half = links.link(single(lighter), &*root);
        ASSERT_TRUE(half.has_value());
        EXPECT_EQ((*half).root == (*root).root, levels == 3);
        EXPECT_EQ(own_bricks(links) == 0, levels == 3);
    }
}

TEST(UpLinks, DetailWithinDeltaIsPruned) {
    Picture grey(32, 32);
    for (int i = 0; i < 1024; ++i) {
        const auto value = static_cast<std::uint8_t>(100 + 2 * (i % 2));
        grey.pixels[static_cast<std::size_t>(i)] = {value, value, value, 255};
    }
    UpLinks pruned(5, kDifferenceOne);
    pruned.descend();
    ASSERT_TRUE(pruned.link(single(grey), nullptr).has_value());
    EXPECT_EQ(own_nodes(pruned), 1U);
    UpLinks exact(5, kDifferenceOne - 1);
    exact.descend();
    ASSERT_TRUE(exact.link(single(grey), nullptr).has_value());
    EXPECT_GT(own_nodes(exact), 1U);
}

TEST(UpLinks, MoreThanARefCanNameIsRefused) {
    const ExactFrame frame = single(random_clip(32, 32, 1, 8).frames[0]);
    UpLinks enough(5, 0, 15);
    enough.descend();
    EXPECT_TRUE(enough.link(frame, nullptr).has_value());
    UpLinks few(5, 0, 14);
    few.descend();
    const Result<TimeNode> node = few.link(frame, nullptr);
    ASSERT_FALSE(node.has_value());
    EXPECT_EQ(node.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(node.error().message,
              "two time nodes have more than 15 nodes or bricks of their own at space "
              "level 5");
}

TEST(UpLinks, TooManyNodesAreRefusedEvenIfTheirBricksAreShared) {
    // Sixteen squares of one look whose detail differs: few bricks at level 5, many nodes.
    Picture picture(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const int square = y / 16 * 4 + x / 16;
            const bool swapped = (square >> (x / 4 % 4) & 1) != 0;
            const bool odd = ((x + y) % 2 == 1) != swapped;
            picture.at(x, y) = odd ? Rgba{10, 0, 0, 255} : Rgba{20, 0, 0, 255};
        }
    }
    UpLinks links(6, 0, 3);
    links.descend();
    const Result<TimeNode> node = links.link(single(picture), nullptr);
    ASSERT_FALSE(node.has_value());
    EXPECT_EQ(node.error().code, ErrorCode::kTooLarge);
}

}  // namespace
}  // namespace haarmony::video
