// Edited clips, built: they are what their frames average to, and up-links survive.
#include <gtest/gtest.h>

#include "engine/video/accounting.h"
#include "engine/video/build.h"
#include "engine/video/memory_clip.h"
#include "engine/video/ops/compose.h"
#include "engine/video/ops/leaf_tree.h"
#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

using testing::RawClip;

std::unique_ptr<MemoryClip> built(FrameSource& source) {
    MemorySpool spool;
    MemoryClip::Sink sink;
    EXPECT_TRUE(build(source, spool, sink).has_value());
    return sink.take();
}

std::unique_ptr<MemoryClip> edited(const TimeTree& clip, const Placement& placement) {
    const auto composition = Composition::make(
        {{&clip, placement, 0, 0, Operator::kAOverB}}, clip.shape().format());
    EXPECT_TRUE(composition.has_value());
    return built(**composition);
}

TEST(EditedClip, IsTheAverageOfItsFramesAtEveryLevel) {
    const RawClip raw = testing::random_clip(24, 17, 5, 4, true);
    const auto clip = testing::plain_clip(raw);
    const CompositionLayer layer{
        clip.get(), {{3, 2, 1}, 3, -2, {}}, 1, 0, Operator::kAOverB};
    RawClip want;
    want.format = raw.format;
    want.frames = testing::pictures_of(**Composition::make({layer}, raw.format));
    const auto result = built(**Composition::make({layer}, raw.format));
    const ClipShape shape = result->shape();
    EXPECT_EQ(shape, testing::shape_of(want));
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            for (int level = 0; level <= shape.space_levels(); ++level) {
                ImageTree tree;
                leaf_tree(*result->frame({k, i}, level), tree);
                EXPECT_EQ(testing::picture_of(
                              tree, {shape.width_at(level), shape.height_at(level), {}}),
                          testing::exact_picture(want, {k, i}, level, Edge::kPad))
                    << k << "/" << i << "/" << level;
            }
        }
    }
}

TEST(EditedClip, UpLinksSurviveATranslation) {
    // A still photograph with something moving in its corner.
    const RawClip raw = testing::random_clip(64, 64, 16, 4, true);
    const auto clip = testing::plain_clip(raw);
    const auto original = edited(*clip, {});
    const auto moved = edited(*original, {{1, 1, 0}, 5, 3, {}});
    const StorageCounts before = count_storage(*original).value();
    const StorageCounts after = count_storage(*moved).value();
    // Most of what there is hangs from links.
    EXPECT_LT(before.own_subtrees, before.pruned_subtrees / 4);
    EXPECT_LT(after.own_subtrees, after.pruned_subtrees / 4);
    // Squares of what moves are cut differently, but not more than along its outline.
    EXPECT_LT(after.own_subtrees, before.own_subtrees * 3 / 2);
    EXPECT_LT(moved->memory_bytes(), original->memory_bytes() * 2);
}

TEST(EditedClip, ThereAndBackIsTheSameClip) {
    const RawClip raw = testing::random_clip(64, 64, 7, 4, true);
    RawClip framed = raw;
    for (Picture& frame : framed.frames) {
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                if (x >= 56 || y >= 60) frame.at(x, y) = kClear;
            }
        }
    }
    const auto clip = testing::plain_clip(framed);
    const auto original = edited(*clip, {});
    const auto there = edited(*original, {{1, 1, 0}, 4, 2, 5});
    const auto back = edited(*there, {{1, 1, 0}, -8, -4, {}});
    EXPECT_EQ(count_storage(*back).value(), count_storage(*original).value());
    EXPECT_EQ(back->memory_bytes(), original->memory_bytes());
    EXPECT_NE(count_storage(*there).value(), count_storage(*original).value());
}

}  // namespace
}  // namespace haarmony::video
