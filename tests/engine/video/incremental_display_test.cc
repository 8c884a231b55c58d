#include "engine/video/incremental_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/video/display.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::linked_clip;
using testing::moving_clip;
using testing::plain_clip;
using testing::random_clip;
using testing::RawClip;

PixelBox random_box(const ClipShape& shape, int level, std::mt19937& random) {
    const auto below = [&random](std::int32_t n) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
    };
    if (random() % 2 == 0) {
        return {0, 0, shape.width_at(level), shape.height_at(level)};
    }
    const std::int32_t x = below(shape.width_at(level));
    const std::int32_t y = below(shape.height_at(level));
    return {x,
            y,
            1 + below(shape.width_at(level) - x),
            1 + below(shape.height_at(level) - y)};
}

bool inside(const PixelBox& box, std::int32_t x, std::int32_t y) {
    return x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height;
}

// Shows the frames in this order and compares each step with a full redraw.
void expect_equals_full_redraw(const TimeTree& clip,
                               const std::vector<NodeAddress>& order,
                               std::mt19937& random) {
    const ClipShape& shape = clip.shape();
    const int level =
        static_cast<int>(random() % static_cast<unsigned>(shape.space_levels() + 1));
    const Edge edge = random() % 2 == 0 ? Edge::kPad : Edge::kNormalize;
    const PixelBox box = random_box(shape, level, random);
    IncrementalDisplay display(level, edge, box);
    for (const NodeAddress& at : order) {
        const Frame frame = *clip.frame(at, level);
        const Picture before = display.picture();
        const Redrawn redrawn = display.show(frame);
        const Picture full = draw(frame, level, edge, box);
        ASSERT_EQ(display.picture(), full)
            << at.time_level << "/" << at.index << " level " << level << " edge "
            << int(edge) << " box " << box.x << "," << box.y;
        for (std::int32_t y = 0; y < box.height; ++y) {
            for (std::int32_t x = 0; x < box.width; ++x) {
                if (before.at(x, y) == full.at(x, y)) continue;
                ASSERT_TRUE(inside(redrawn.box, box.x + x, box.y + y));
                ASSERT_GT(redrawn.squares, 0);
            }
        }
    }
}

std::vector<NodeAddress> frames_of_level(const ClipShape& shape, int time_level) {
    std::vector<NodeAddress> order;
    for (std::int64_t i = 0; i < shape.nodes_at(time_level); ++i) {
        order.push_back({time_level, i});
    }
    return order;
}

TEST(IncrementalDisplay, EqualsAFullRedrawAtEveryStepInAnyOrder) {
    std::mt19937 random(1);
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const RawClip moving = moving_clip(37, 29, 9, seed);
        const RawClip coherent = random_clip(20, 33, 6, seed, true);
        const RawClip small = moving_clip(4, 3, 5, seed);
        for (const RawClip* raw : {&moving, &coherent, &small}) {
            for (const auto& clip : {linked_clip(*raw), plain_clip(*raw)}) {
                const ClipShape& shape = clip->shape();
                std::vector<NodeAddress> all;
                for (int k = 0; k <= shape.time_levels(); ++k) {
                    std::vector<NodeAddress> order = frames_of_level(shape, k);
                    expect_equals_full_redraw(*clip, order, random);
                    std::reverse(order.begin(), order.end());
                    expect_equals_full_redraw(*clip, order, random);
                    all.insert(all.end(), order.begin(), order.end());
                }
                for (int round = 0; round < 4; ++round) {
                    std::shuffle(all.begin(), all.end(), random);
                    expect_equals_full_redraw(*clip, all, random);
                }
            }
        }
    }
}

TEST(IncrementalDisplay, DrawsOnlyWhatMoves) {
    // 64 x 64 of noise; 16 x 16 of it change: at most 4 of 64 bricks, on and off the grid 9.
    const RawClip raw = random_clip(64, 64, 8, 4, true);
    const auto clip = linked_clip(raw);
    IncrementalDisplay display(6, Edge::kPad, {0, 0, 64, 64});
    EXPECT_EQ(display.show(*clip->frame({3, 0}, 6)), (Redrawn{64, {0, 0, 64, 64}}));
    for (const std::int64_t i : {1, 2, 3, 4, 5, 6, 7, 6, 5, 4, 3, 2, 1, 0, 7, 3}) {
        const Redrawn redrawn = display.show(*clip->frame({3, i}, 6));
        EXPECT_EQ(redrawn, (Redrawn{4, {0, 0, 16, 16}})) << i;
    }
}

TEST(IncrementalDisplay, TheSameFrameAgainDrawsNothing) {
    const auto clip = linked_clip(moving_clip(37, 29, 4, 5));
    IncrementalDisplay display(6, Edge::kNormalize, {0, 0, 37, 29});
    display.show(*clip->frame({2, 1}, 6));
    EXPECT_EQ(display.show(*clip->frame({2, 1}, 6)), Redrawn{});
}

TEST(IncrementalDisplay, FramesOfAStillClipDrawNothing) {
    RawClip raw = random_clip(30, 20, 1, 6);
    raw.frames.resize(5, raw.frames[0]);
    const auto clip = linked_clip(raw);
    IncrementalDisplay display(5, Edge::kPad, {3, 4, 20, 11});
    display.show(*clip->frame({3, 0}, 5));
    for (const std::int64_t i : {1, 2, 3, 4}) {
        EXPECT_EQ(display.show(*clip->frame({3, i}, 5)), Redrawn{}) << i;
    }
    EXPECT_EQ(display.show(*clip->frame({0, 0}, 5)), Redrawn{});
}

TEST(IncrementalDisplay, WhatMovesAwayIsCleared) {
    RawClip raw{{32, 32, {25, 1}}, {Picture(32, 32), Picture(32, 32)}};
    raw.frames[0].at(3, 3) = {255, 0, 0, 255};
    raw.frames[1].at(28, 3) = {255, 0, 0, 255};
    const auto clip = linked_clip(raw);
    IncrementalDisplay display(5, Edge::kPad, {0, 0, 32, 32});
    display.show(*clip->frame({1, 0}, 5));
    display.show(*clip->frame({1, 1}, 5));
    EXPECT_EQ(display.picture(), raw.frames[1]);
    display.show(*clip->frame({1, 0}, 5));
    EXPECT_EQ(display.picture(), raw.frames[0]);
}

TEST(IncrementalDisplay, OnlyWithinBothBoundingBoxes) {
    // Without any links each of the 64 bricks would be compared, and those that differ drawn.
    RawClip raw{{64, 64, {25, 1}}, {Picture(64, 64), Picture(64, 64)}};
    raw.frames[0].at(0, 0) = {1, 1, 1, 255};
    raw.frames[1].at(9, 9) = {1, 1, 1, 255};
    const auto clip = plain_clip(raw);
    IncrementalDisplay display(6, Edge::kPad, {0, 0, 64, 64});
    display.show(*clip->frame({1, 0}, 6));
    EXPECT_EQ(display.show(*clip->frame({1, 1}, 6)), (Redrawn{2, {0, 0, 10, 10}}));
}

TEST(DrawChanges, WritesNothingOutsideTheBox) {
    const RawClip raw = random_clip(32, 32, 2, 7);
    const auto clip = linked_clip(raw);
    const Rgba untouched{1, 2, 3, 4};
    Picture canvas(32, 32);
    canvas.pixels.assign(canvas.pixels.size(), untouched);
    const PixelBox box{5, 6, 13, 11};
    const Frame first = *clip->frame({1, 0}, 5), second = *clip->frame({1, 1}, 5);
    draw(first, 5, Edge::kPad, box, &canvas.at(5, 6), 32);
    draw_changes(first, second, 5, Edge::kPad, box, &canvas.at(5, 6), 32);
    for (std::int32_t y = 0; y < 32; ++y) {
        for (std::int32_t x = 0; x < 32; ++x) {
            EXPECT_EQ(canvas.at(x, y),
                      inside(box, x, y) ? raw.frames[1].at(x, y) : untouched);
        }
    }
}

}  // namespace
}  // namespace haarmony::video
