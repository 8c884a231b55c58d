#include "engine/video/timeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "engine/video/display.h"
#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::linked_clip;
using testing::moving_clip;
using testing::RawClip;

// The share of the picture's bricks of a level that differ, by their pixels at all levels
// from there on.
double changed_by_pixels(const Frame& parent, const Frame& child, int level) {
    const ClipShape& shape = child.shape();
    const int side = 1 << (shape.space_levels() - level + kBrickLevel);
    std::int64_t area = 0;
    for (std::int32_t y = 0; y < shape.height(); y += side) {
        for (std::int32_t x = 0; x < shape.width(); x += side) {
            const std::int32_t width = std::min(side, shape.width() - x);
            const std::int32_t height = std::min(side, shape.height() - y);
            bool differs = false;
            for (int l = level; l <= shape.space_levels(); ++l) {
                const int s = shape.space_levels() - l;
                const PixelBox box{x >> s,
                                   y >> s,
                                   std::min(side >> s, shape.width_at(l) - (x >> s)),
                                   std::min(side >> s, shape.height_at(l) - (y >> s))};
                differs = differs || draw(parent, l, Edge::kNormalize, box) !=
                                         draw(child, l, Edge::kNormalize, box);
            }
            if (differs) area += std::int64_t{width} * height;
        }
    }
    return static_cast<double>(area) / shape.width() / shape.height();
}

// 64 x 64 of noise, 16 x 16 of which change with every frame: a sixteenth.
TEST(Timeline, ChangedIsTheShareThatDiffersFromTheTimeParent) {
    const auto clip = linked_clip(testing::random_clip(64, 64, 8, 1, true));
    const Timeline whole = *timeline(*clip, 1, 6);
    ASSERT_EQ(whole.buckets.size(), 1U);
    EXPECT_EQ(whole.buckets[0].changed,
              (std::vector<double>{1 / 16.0, 1 / 16.0, 1 / 16.0}));
    EXPECT_EQ(whole.buckets[0].temporal(), 3 / 16.0);
    EXPECT_EQ(whole.buckets[0].frames, (FrameRange{0, 8}));
}

TEST(Timeline, AtALevelSquaresThatDifferBelowCountInFull) {
    const RawClip raw = moving_clip(45, 37, 4, 2);
    const auto clip = linked_clip(raw);
    for (int level = kBrickLevel; level <= 6; ++level) {
        const Timeline lines = *timeline(*clip, 4, level);
        for (std::int64_t i = 0; i < 4; ++i) {
            const auto share = [&](const NodeAddress& at) {
                const NodeAddress up{at.time_level - 1, at.index / 2};
                return changed_by_pixels(*clip->frame(up, 6), *clip->frame(at, 6), level);
            };
            const auto& changed = lines.buckets[static_cast<std::size_t>(i)].changed;
            // A square without children is compared as a whole, and pruned ones are larger.
            EXPECT_GE(changed[0] + 1e-12, share({1, i / 2})) << level << " " << i;
            EXPECT_GE(changed[1] + 1e-12, share({2, i})) << level << " " << i;
            if (level == 6) {
                EXPECT_LE(changed[1], 0.6);
            }
        }
    }
}

TEST(Timeline, AStillClipHasNoDetailInTime) {
    RawClip raw = testing::random_clip(30, 20, 1, 3);
    raw.frames.resize(7, raw.frames[0]);
    const auto clip = linked_clip(raw);
    const Timeline lines = *timeline(*clip, 3, 5);
    for (const TimelineBucket& bucket : lines.buckets) {
        EXPECT_EQ(bucket.temporal(), 0);
        EXPECT_EQ(bucket.deepest_level, 5);
        // All bricks of the levels 3, 4 and 5 but those of padding alone.
        EXPECT_GE(bucket.squares, 1 + 4 + 12);
    }
}

TEST(Timeline, ShowsWhereSomethingMoves) {
    RawClip raw = testing::random_clip(32, 32, 1, 4);
    raw.frames.resize(16, raw.frames[0]);
    raw.frames[13].at(5, 5) = {1, 2, 3, 255};
    const auto clip = linked_clip(raw);
    const Timeline lines = *timeline(*clip, 8, 5);
    for (std::size_t b = 0; b < 8; ++b) {
        // Frames 12 and 13 part at the last level; those before at the first.
        EXPECT_EQ(lines.buckets[b].changed[3] > 0, b == 6) << b;
        EXPECT_GT(lines.buckets[b].changed[0], 0) << b;
    }
}

TEST(Timeline, ShowsWhereThereIsDetailInSpace) {
    RawClip raw{{64, 64, {25, 1}}, {}};
    for (int t = 0; t < 8; ++t) {
        raw.frames.emplace_back(64, 64);
        raw.frames.back().pixels.assign(64 * 64, Rgba{5, 5, 5, 255});
        if (t >= 4) raw.frames.back().at(9, 9) = {200, 5, 5, 255};
        if (t == 7) {
            for (int i = 0; i < 256; ++i)
                raw.frames.back().at(i % 16, i / 16) = {7, 7, 7, 255};
        }
    }
    const auto clip = linked_clip(raw);
    const Timeline lines = *timeline(*clip, 4, 6);
    EXPECT_EQ(lines.buckets[0].deepest_level, kBrickLevel);  // flat
    EXPECT_EQ(lines.buckets[0].squares, 1);
    EXPECT_EQ(lines.buckets[2].deepest_level, 6);
    EXPECT_EQ(lines.buckets[2].squares, 4);
    EXPECT_EQ(lines.buckets[3].squares, (4 + 1) / 2.0);
    // Not looked at so deep, it is known that there is more.
    EXPECT_EQ(timeline(*clip, 4, 4)->buckets[2].deepest_level, 5);
}

TEST(Timeline, BucketsPartTheFramesAndAverageThem) {
    const auto clip = linked_clip(moving_clip(21, 18, 13, 5));
    const Timeline each = *timeline(*clip, 13, 5);
    for (const std::int64_t buckets : {1, 2, 3, 5, 12}) {
        const Timeline lines = *timeline(*clip, buckets, 5);
        std::int64_t next = 0;
        for (const TimelineBucket& bucket : lines.buckets) {
            EXPECT_EQ(bucket.frames.first, next);
            next = bucket.frames.end;
            double squares = 0, temporal = 0;
            int deepest = 0;
            for (std::int64_t t = bucket.frames.first; t < next; ++t) {
                const TimelineBucket& frame = each.buckets[static_cast<std::size_t>(t)];
                squares += frame.squares;
                temporal += frame.temporal();
                deepest = std::max(deepest, frame.deepest_level);
            }
            const auto count = static_cast<double>(bucket.frames.count());
            EXPECT_NEAR(bucket.squares, squares / count, 1e-9);
            EXPECT_NEAR(bucket.temporal(), temporal / count, 1e-9);
            EXPECT_EQ(bucket.deepest_level, deepest);
        }
        EXPECT_EQ(next, 13);
    }
}

TEST(Timeline, CoarserIsCheaper) {
    const auto clip = linked_clip(testing::random_clip(128, 128, 4, 6));
    const std::int64_t coarse = timeline(*clip, 4, 4)->nodes_visited;
    EXPECT_LE(coarse, (1 + 2 + 4) * 2 * (1 + 4));
    EXPECT_GT(timeline(*clip, 4, 7)->nodes_visited, 20 * coarse);
}

TEST(Timeline, WorksOnClipsSmallerThanABrick) {
    RawClip raw{{3, 2, {25, 1}}, {Picture(3, 2), Picture(3, 2)}};
    raw.frames[0].at(2, 1) = {1, 2, 3, 255};
    const Timeline lines = *timeline(*testing::plain_clip(raw), 2, 2);
    EXPECT_DOUBLE_EQ(lines.buckets[0].changed[0], 1 / 6.0);
    EXPECT_DOUBLE_EQ(lines.buckets[1].changed[0], 1 / 6.0);
    EXPECT_EQ(lines.buckets[0].deepest_level, 2);
}

TEST(Timeline, RefusesBucketsThatWouldBeEmpty) {
    const auto clip = linked_clip(moving_clip(9, 9, 3, 7));
    for (const std::int64_t bad : {0, -1, 4}) {
        const Result<Timeline> lines = timeline(*clip, bad, 4);
        ASSERT_FALSE(lines.has_value()) << bad;
        EXPECT_EQ(lines.error().param, "buckets");
        EXPECT_NE(lines.error().message.find(std::to_string(bad)), std::string::npos);
    }
}

TEST(Timeline, PassesOnWhatTheStorageMeets) {
    const auto clip = linked_clip(moving_clip(20, 13, 6, 8));
    EXPECT_TRUE(testing::passes_on_every_failure(
        *clip, [](const TimeTree& failing) { return timeline(failing, 3, 5); }));
}

}  // namespace
}  // namespace haarmony::video
