#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/video/display.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::linked_clip;
using testing::moving_clip;
using testing::plain_clip;
using testing::RawClip;

// From the definition: every pixel of every finer level beside the one that it lies in.
bool finer_by_pixels(const Frame& frame, int level, const PixelBox& box) {
    const Picture coarse = draw(frame, level, Edge::kNormalize);
    for (int finer = level + 1; finer <= frame.shape().space_levels(); ++finer) {
        const Picture fine = draw(frame, finer, Edge::kNormalize);
        const int shift = finer - level;
        for (std::int32_t y = box.y << shift;
             y < std::min((box.y + box.height) << shift, fine.height);
             ++y) {
            for (std::int32_t x = box.x << shift;
                 x < std::min((box.x + box.width) << shift, fine.width);
                 ++x) {
                if (fine.at(x, y) != coarse.at(x >> shift, y >> shift)) return true;
            }
        }
    }
    return false;
}

void expect_same_as_by_pixels(const TimeTree& clip, int rounds) {
    std::mt19937 random(1);
    const ClipShape& shape = clip.shape();
    const Frame frame = *clip.frame({0, 0}, shape.space_levels());
    int found = 0;
    for (int round = 0; round < rounds; ++round) {
        const int level =
            static_cast<int>(random() % static_cast<unsigned>(shape.space_levels() + 1));
        const auto below = [&random](std::int32_t n) {
            return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
        };
        const std::int32_t x = below(shape.width_at(level));
        const std::int32_t y = below(shape.height_at(level));
        const PixelBox box{x,
                           y,
                           std::min(below(4), shape.width_at(level) - x),
                           std::min(below(4), shape.height_at(level) - y)};
        const bool finer = finer_by_pixels(frame, level, box);
        EXPECT_EQ(finer_in_space(frame, level, box), finer)
            << level << ": " << x << "," << y << " " << box.width << "x" << box.height;
        found += finer ? 1 : 0;
    }
    EXPECT_GT(found, rounds / 10);
    EXPECT_LT(found, rounds - rounds / 10);
}

TEST(FinerInSpace, IsWhatThePixelsSay) {
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const RawClip raw = moving_clip(45, 28, 1, seed);
        expect_same_as_by_pixels(*linked_clip(raw), 300);
    }
}

TEST(FinerInSpace, NodesThatShowNothingNewAreNoDetail) {
    expect_same_as_by_pixels(*plain_clip(moving_clip(45, 28, 1, 4)), 300);
}

TEST(FinerInSpace, HoldsForClipsSmallerThanABrick) {
    expect_same_as_by_pixels(*plain_clip(moving_clip(4, 3, 1, 5)), 200);
}

TEST(FinerInSpace, PaddingIsNoDetail) {
    RawClip raw{{5, 70, {25, 1}}, {Picture(5, 70)}};
    raw.frames[0].pixels.assign(5 * 70, Rgba{1, 2, 3, 255});
    const auto clip = linked_clip(raw);
    const Frame frame = *clip->frame({0, 0}, 7);
    for (int level = 0; level <= 7; ++level) {
        const ClipShape& shape = clip->shape();
        EXPECT_FALSE(finer_in_space(
            frame, level, {0, 0, shape.width_at(level), shape.height_at(level)}))
            << level;
    }
}

TEST(FinerInSpace, WhatTheFrameDoesNotHoldCountsWhereTheTreeGoesOn) {
    // A chessboard: grey at every level but the finest.
    RawClip raw{{64, 64, {25, 1}}, {Picture(64, 64)}};
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 32; ++x) {
            const auto grey = static_cast<std::uint8_t>((x + y) % 2 == 0 ? 0 : 100);
            raw.frames[0].at(x, y) = {grey, grey, grey, 255};
        }
        for (int x = 32; x < 64; ++x) raw.frames[0].at(x, y) = {50, 50, 50, 255};
    }
    const auto clip = linked_clip(raw);
    const Frame frame = *clip->frame({0, 0}, 4);
    EXPECT_TRUE(finer_in_space(frame, 3, {0, 0, 1, 1}));
    EXPECT_FALSE(finer_in_space(frame, 3, {4, 0, 4, 8}));
    EXPECT_TRUE(finer_in_space(*clip->frame({0, 0}, 1), 0, {0, 0, 1, 1}));
}

}  // namespace
}  // namespace haarmony::video
