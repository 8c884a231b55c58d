#include "engine/video/shutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::linked_clip;
using testing::moving_clip;
using testing::passes_on_every_failure;
using testing::plain_clip;
using testing::random_clip;

TEST(HalfBlur, IsTheFirstHalf) {
    const auto clip = plain_clip(random_clip(3, 3, 5, 1));
    EXPECT_EQ(half_blur(*clip, {0, 0}), (NodeAddress{1, 0}));
    EXPECT_EQ(half_blur(*clip, {2, 1}), (NodeAddress{3, 2}));
    EXPECT_EQ(half_blur(*clip, {2, 2}), (NodeAddress{3, 4}));
    EXPECT_EQ(half_blur(*clip, {3, 4}), (NodeAddress{3, 4}));
}

TEST(CoveringNodes, HoldExactlyTheFramesAndAreTheFewest) {
    for (const std::int64_t frames : {1, 2, 5, 13, 16}) {
        const ClipShape shape = *ClipShape::make({4, 4, {25, 1}}, frames);
        // fewest[e - f]: by trying every node that begins where the rest ends.
        for (std::int64_t first = 0; first < frames; ++first) {
            std::vector<std::size_t> fewest(static_cast<std::size_t>(frames + 1), 1000);
            fewest[static_cast<std::size_t>(first)] = 0;
            for (std::int64_t at = first; at < frames; ++at) {
                for (int k = 0; k <= shape.time_levels(); ++k) {
                    const std::int64_t i = at >> (shape.time_levels() - k);
                    const FrameRange node = shape.frames_of({k, i});
                    if (node.first != at) continue;
                    auto& best = fewest[static_cast<std::size_t>(node.end)];
                    best = std::min(best, fewest[static_cast<std::size_t>(at)] + 1);
                }
            }
            for (std::int64_t end = first + 1; end <= frames; ++end) {
                const auto nodes = covering_nodes(shape, {first, end});
                EXPECT_EQ(nodes.size(), fewest[static_cast<std::size_t>(end)]);
                EXPECT_LE(nodes.size(),
                          static_cast<std::size_t>(std::max(1, 2 * shape.time_levels())));
                std::int64_t next = first;
                for (const NodeAddress& node : nodes) {
                    ASSERT_TRUE(shape.contains(node));
                    EXPECT_EQ(shape.frames_of(node).first, next);
                    next = shape.frames_of(node).end;
                }
                EXPECT_EQ(next, end);
            }
        }
    }
}

TEST(Shutter, OneNodeIsDrawnAsItIs) {
    const auto clip = linked_clip(moving_clip(20, 13, 6, 2));
    const PixelBox box{1, 2, 15, 9};
    EXPECT_EQ(*draw_shutter(*clip, {4, 6}, 5, Edge::kNormalize, box),
              draw(*clip->frame({1, 1}, 5), 5, Edge::kNormalize, box));
    EXPECT_EQ(*zoom_shutter(*clip, {0, 6}, 27, Edge::kPad, {0, 0, 9, 9}),
              zoom(*clip->frame({0, 0}, 5), 27, Edge::kPad, {0, 0, 9, 9}));
}

TEST(Shutter, AverageIsThatOfItsFramesWithinTheRoundingOfTheNodes) {
    const testing::RawClip raw = random_clip(9, 7, 13, 3);
    const auto clip = plain_clip(raw);
    for (const FrameRange range : {FrameRange{1, 12}, {3, 6}, {0, 13}, {5, 13}}) {
        const Picture got = *draw_shutter(*clip, range, 4, Edge::kPad, {0, 0, 9, 7});
        for (std::size_t i = 0; i < got.pixels.size(); ++i) {
            double alpha = 0;
            for (std::int64_t t = range.first; t < range.end; ++t) {
                alpha += raw.frames[static_cast<std::size_t>(t)].pixels[i].a;
            }
            // Half a level by the nodes' rounding and half by the last one.
            EXPECT_NEAR(
                got.pixels[i].a, alpha / static_cast<double>(range.count()), 1.01);
        }
    }
}

TEST(Shutter, SingleFramesAreAveragedWithOneRounding) {
    const testing::RawClip raw = random_clip(9, 7, 4, 4);
    const auto clip = plain_clip(raw);
    const Picture got = *draw_shutter(*clip, {1, 3}, 4, Edge::kPad, {0, 0, 9, 7});
    for (std::size_t i = 0; i < got.pixels.size(); ++i) {
        PixelSum sum = sum_of(raw.frames[1].pixels[i], 1);
        sum += sum_of(raw.frames[2].pixels[i], 1);
        EXPECT_EQ(got.pixels[i], mean(sum, 2));
    }
}

TEST(Shutter, LongerNodesWeighMore) {
    testing::RawClip raw{{1, 1, {25, 1}}, {}};
    for (const int grey : {0, 90, 90, 90}) {
        raw.frames.emplace_back(1, 1);
        const auto level = static_cast<std::uint8_t>(grey);
        raw.frames.back().at(0, 0) = {level, level, level, 255};
    }
    raw.frames.push_back(raw.frames[0]);
    const auto clip = plain_clip(raw);
    // Frames 1, 2 and 3, and 4: (90 + 2 * 90 + 0) / 4.
    EXPECT_EQ(draw_shutter(*clip, {1, 5}, 0, Edge::kPad, {0, 0, 1, 1})->at(0, 0),
              (Rgba{68, 68, 68, 255}));
}

TEST(Shutter, PassesOnWhatTheStorageMeets) {
    const auto clip = linked_clip(moving_clip(20, 13, 6, 5));
    EXPECT_TRUE(passes_on_every_failure(*clip, [](const TimeTree& failing) {
        return draw_shutter(failing, {1, 6}, 5, Edge::kPad, {0, 0, 20, 13});
    }));
    EXPECT_TRUE(passes_on_every_failure(*clip, [](const TimeTree& failing) {
        return zoom_shutter(failing, {1, 6}, 20, Edge::kPad, {0, 0, 5, 5});
    }));
}

}  // namespace
}  // namespace haarmony::video
