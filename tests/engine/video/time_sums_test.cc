#include "engine/video/time_sums.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/engine/video/faulty_spool.h"
#include "tests/engine/video/plain_frame.h"
#include "tests/engine/video/raw_source.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

using testing::complete_tree;
using testing::exact_picture;
using testing::FaultySpool;
using testing::picture_of;
using testing::random_clip;
using testing::RawClip;

// Appends of one frame: nodes, bricks, head.
constexpr std::int64_t kAppends = 3;

// The clip with frame t shown repeats[t] times.
RawClip repeated(const RawClip& clip, const std::vector<std::int64_t>& repeats) {
    RawClip longer;
    longer.format = clip.format;
    for (std::size_t t = 0; t < repeats.size(); ++t) {
        for (std::int64_t i = 0; i < repeats[t]; ++i) {
            longer.frames.push_back(clip.frames[t]);
        }
    }
    return longer;
}

SpooledNodes sum_up(const RawClip& clip,
                    const std::vector<std::int64_t>& repeats,
                    FrameSpool& spool) {
    TimeSums sums(clip.format, spool);
    for (std::size_t t = 0; t < repeats.size(); ++t) {
        EXPECT_TRUE(
            sums.add(complete_tree(clip.frames[t], clip.format), repeats[t]).has_value());
    }
    Result<SpooledNodes> nodes = sums.finish();
    EXPECT_TRUE(nodes.has_value());
    return *std::move(nodes);
}

// Every node that is not below a uniform one is its exact mean, and uniform where it should.
void expect_exact(const RawClip& clip, const SpooledNodes& nodes, FrameSpool& spool) {
    const ClipShape shape = shape_of(clip);
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const auto uniform = [&](const NodeAddress& at) {
                const FrameRange range = shape.frames_of(at);
                for (std::int64_t t = range.first; t < range.end; ++t) {
                    if (!(clip.frames[static_cast<std::size_t>(t)] ==
                          clip.frames[static_cast<std::size_t>(range.first)])) {
                        return false;
                    }
                }
                return true;
            };
            if (k > 0 && uniform({k - 1, i >> 1})) continue;
            const SpooledNode& node = nodes.at(shape.time_levels() - k, i);
            EXPECT_EQ(node.uniform, uniform({k, i})) << k << " " << i;
            ExactFrame frame;
            ASSERT_TRUE(spool.get(node.frame, frame).has_value());
            for (int level = 0; level <= shape.space_levels(); ++level) {
                for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
                    EXPECT_EQ(picture_of(frame, clip.format, level, edge),
                              exact_picture(clip, {k, i}, level, edge))
                        << k << " " << i << " " << level;
                }
            }
        }
    }
}

// Old frames by their sums: the nodes of the whole and of what follows, and none below.
TEST(TimeSums, FramesAddedAsAWholeMakeTheSameNodesAbove) {
    const RawClip clip = random_clip(20, 12, 7, 33);
    MemorySpool memory;
    FrameSpool spool(memory);
    TimeSums sums(clip.format, spool);
    FrameSum whole(clip.format);
    for (std::size_t t = 0; t < 4; ++t)
        whole.add(complete_tree(clip.frames[t], clip.format), 1);
    ASSERT_TRUE(sums.add_whole(2, std::move(whole), false).has_value());
    EXPECT_EQ(sums.frames(), 4);
    for (std::size_t t = 4; t < 7; ++t)
        ASSERT_TRUE(sums.add(complete_tree(clip.frames[t], clip.format), 1).has_value());
    const Result<SpooledNodes> nodes = sums.finish();
    ASSERT_TRUE(nodes.has_value());
    // The root, its halves, (4, 5), (6), and three frames: (6) is a frame at two heights.
    EXPECT_EQ((*nodes).size(), 1U + 2 + 2 + 2);
    for (const auto& [height, index] :
         {std::pair(3, 0), {2, 0}, {2, 1}, {1, 2}, {1, 3}, {0, 4}, {0, 5}}) {
        ExactFrame frame;
        ASSERT_TRUE(spool.get((*nodes).at(height, index).frame, frame).has_value());
        for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
            EXPECT_EQ(picture_of(frame, clip.format, 5, edge),
                      exact_picture(clip, {3 - height, index}, 5, edge))
                << height << " " << index;
        }
    }
}

TEST(TimeSums, EveryTimeNodeIsItsExactMean) {
    for (int frames = 1; frames <= 9; ++frames) {
        const RawClip clip =
            random_clip(11, 9, frames, static_cast<std::uint32_t>(frames));
        MemorySpool memory;
        FrameSpool spool(memory);
        const std::vector<std::int64_t> once(static_cast<std::size_t>(frames), 1);
        expect_exact(clip, sum_up(clip, once, spool), spool);
    }
}

TEST(TimeSums, RunsAreFramesOneByOne) {
    const RawClip clip = random_clip(9, 9, 4, 21);
    for (const std::vector<std::int64_t>& repeats :
         std::vector<std::vector<std::int64_t>>{
             {2, 2}, {1, 3}, {5}, {8}, {3, 1, 4}, {1, 7, 2, 1}, {16, 1}}) {
        MemorySpool memory;
        FrameSpool spool(memory);
        const SpooledNodes nodes = sum_up(clip, repeats, spool);
        expect_exact(repeated(clip, repeats), nodes, spool);
    }
}

TEST(TimeSums, ALongRunCostsItsLogarithm) {
    const RawClip clip = random_clip(8, 8, 2, 22);
    FaultySpool memory;
    FrameSpool spool(memory);
    const std::int64_t run = (std::int64_t{1} << 28) - 3;
    const SpooledNodes nodes = sum_up(clip, {1, run}, spool);
    // Two frames, and the nodes on the way from the first one to the root that have both.
    EXPECT_EQ(memory.appends(), kAppends * (2 + 28));
    EXPECT_LE(nodes.size(), 2U * 28 + 1);
    EXPECT_TRUE(nodes.at(27, 1).uniform);
    EXPECT_FALSE(nodes.at(27, 0).uniform);
}

TEST(TimeSums, EqualFramesOfDifferentShapeAreOneFrame) {
    // A flat picture as a complete tree, and as a root alone.
    RawClip clip;
    clip.format = {16, 16, {25, 1}};
    Picture flat(16, 16);
    for (Rgba& pixel : flat.pixels) pixel = {9, 8, 7, 255};
    clip.frames.push_back(flat);
    ImageTree root_alone;
    root_alone.root = 0;
    root_alone.nodes.emplace_back().brick = 0;
    root_alone.bricks.emplace_back().fill({9, 8, 7, 255});
    FaultySpool memory;
    FrameSpool spool(memory);
    TimeSums sums(clip.format, spool);
    ASSERT_TRUE(sums.add(complete_tree(flat, clip.format), 1).has_value());
    ASSERT_TRUE(sums.add(root_alone, 1).has_value());
    const Result<SpooledNodes> nodes = sums.finish();
    ASSERT_TRUE(nodes.has_value());
    EXPECT_EQ(memory.appends(), kAppends);
    EXPECT_TRUE((*nodes).at(1, 0).uniform);
}

TEST(TimeSums, PassesOnWhatTheSpoolMeetsAtEveryCall) {
    const RawClip clip = random_clip(8, 8, 5, 23);
    const auto run = [&clip](FaultySpool& memory) -> Result<void> {
        FrameSpool spool(memory);
        TimeSums sums(clip.format, spool);
        for (const Picture& frame : clip.frames) {
            const Result<void> added = sums.add(complete_tree(frame, clip.format), 1);
            if (!added) return added;
        }
        const Result<SpooledNodes> nodes = sums.finish();
        if (!nodes) return nodes.error();
        return {};
    };
    testing::expect_failures_passed_on(kAppends * (5 + 2 + 1 + 1), run);
}

}  // namespace
}  // namespace haarmony::video
