// Sizes and bounds against slow oracles.
#include "tests/eval/video_bound.h"

#include <gtest/gtest.h>

#include <array>

#include "engine/video/accounting.h"
#include "tests/engine/video/worst_difference.h"
#include "tests/eval/test/video_frames.h"
#include "tests/eval/video_sizes.h"

namespace haarmony::eval {
namespace {

TEST(VideoBound, LargestDifferenceIsTheOraclesOverAllTimeLevels) {
    const VideoClip clip = noisy_clip(21, 12, 5, false);
    const auto exact = built_in_memory(clip, 0);
    const auto lossy = built_in_memory(clip, 12 * video::kDifferenceOne);
    ASSERT_TRUE(exact.has_value() && lossy.has_value());
    const int finest = (*exact)->shape().time_levels();
    const auto leaf = largest_difference(**exact, **lossy, finest, finest + 1);
    const auto coarse = largest_difference(**exact, **lossy, 0, finest);
    ASSERT_TRUE(leaf.has_value() && coarse.has_value());
    EXPECT_EQ(std::max(*leaf, *coarse),
              video::testing::worst_difference(**exact, **lossy).anywhere());
    EXPECT_EQ(*largest_difference(**exact, **exact, 0, finest + 1), 0U);
}

TEST(VideoBound, LossyClipsStayWithinDeltaAndGrowNoLarger) {
    const VideoClip clip = noisy_clip(32, 24, 6);
    const std::array<int, 3> deltas = {2, 8, 32};
    const auto bounds = measure_video_bounds(clip, deltas);
    ASSERT_TRUE(bounds.has_value()) << bounds.error().message;
    ASSERT_EQ(bounds->size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const VideoBound& bound = (*bounds)[i];
        EXPECT_EQ(bound.delta, deltas[i]);
        EXPECT_TRUE(bound.held()) << bound.worst_leaf << " " << bound.worst_coarse;
        EXPECT_GT(bound.memory_ratio, 0);
        if (i > 0) {
            EXPECT_LE(bound.memory_ratio, (*bounds)[i - 1].memory_ratio);
        }
    }
    EXPECT_GT((*bounds)[2].worst_leaf, 2);
}

TEST(VideoBound, FartherThanDeltaIsNotHeld) {
    EXPECT_TRUE((VideoBound{"", 4, 4, 4, 1}).held());
    EXPECT_FALSE((VideoBound{"", 4, 4.001, 1, 1}).held());
    EXPECT_FALSE((VideoBound{"", 4, 1, 4.001, 1}).held());
}

TEST(VideoSizes, CountWhatTheClipAndItsFileTake) {
    const VideoClip clip = noisy_clip(26, 18, 5);
    const auto sizes = measure_video_sizes(clip);
    ASSERT_TRUE(sizes.has_value()) << sizes.error().message;
    const auto built = built_in_memory(clip, 0);
    ASSERT_TRUE(built.has_value());
    EXPECT_EQ(sizes->memory, (*built)->memory_bytes());
    EXPECT_EQ(sizes->paper, video::count_storage(**built)->paper_bytes);
    EXPECT_EQ(sizes->raw, 4U * 26 * 18 * 5);
    std::uint64_t file_bytes = 0;
    const auto file = built_as_file(clip, file_bytes);
    ASSERT_TRUE(file.has_value());
    EXPECT_EQ(sizes->file, file_bytes);
    EXPECT_DOUBLE_EQ(sizes->memory_ratio() * static_cast<double>(sizes->raw),
                     static_cast<double>(sizes->memory));
    EXPECT_DOUBLE_EQ(sizes->file_ratio() * static_cast<double>(sizes->ffv1),
                     static_cast<double>(sizes->file));
}

TEST(VideoSizes, WhatCannotBeBuiltOrEncodedIsNamed) {
    VideoClip clip = noisy_clip(16, 16, 1);
    clip.format.rate = {0, 1};
    EXPECT_TRUE(built_in_memory(clip, 0).error().message.starts_with("noisy: "));
    std::uint64_t bytes = 0;
    EXPECT_TRUE(built_as_file(clip, bytes).error().message.starts_with("noisy: "));
    EXPECT_FALSE(measure_video_sizes(clip).has_value());
    const VideoClip wide = noisy_clip(20'000, 2, 1);
    const auto sizes = measure_video_sizes(wide);
    ASSERT_FALSE(sizes.has_value());
    EXPECT_TRUE(sizes.error().message.starts_with("noisy: libx264"))
        << sizes.error().message;
}

TEST(VideoSizes, OnlyNaturalClipsAndClipArtHaveTargets) {
    EXPECT_EQ(memory_target(VideoKind::kNatural), 2.2);
    EXPECT_EQ(memory_target(VideoKind::kClipArt), 0.15);
    EXPECT_FALSE(memory_target(VideoKind::kGenerated).has_value());
    EXPECT_EQ(file_target(VideoKind::kNatural), 3);
    EXPECT_EQ(file_target(VideoKind::kClipArt), 0.15);
    EXPECT_FALSE(file_target(VideoKind::kGenerated).has_value());
    EXPECT_STREQ(video_kind_name(VideoKind::kGenerated), "generated");
    EXPECT_STREQ(video_kind_name(VideoKind::kClipArt), "clip-art");
    EXPECT_STREQ(video_kind_name(VideoKind::kNatural), "natural");
}

}  // namespace
}  // namespace haarmony::eval
