// Previews: composites of averages, and where they are what the final clip shows.
#include "engine/video/ops/preview.h"

#include <gtest/gtest.h>

#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/ops/plain_trees.h"
#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::exact_picture;
using testing::plain_clip;
using testing::RawClip;

TEST(Preview, CompositesTheAveragesOfItsClips) {
    const RawClip a = testing::random_clip(32, 20, 6, 1);
    const RawClip b = testing::random_clip(32, 20, 6, 2);
    const auto clip_a = plain_clip(a), clip_b = plain_clip(b);
    const std::vector<CompositionLayer> layers = {
        {clip_b.get(), {}, 0, 0, Operator::kAOverB},
        {clip_a.get(), {}, 0, 0, Operator::kAAtopB}};
    const ClipShape shape = testing::shape_of(a);
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            for (int level = 0; level <= shape.space_levels(); ++level) {
                const Result<Picture> shown = preview(layers, a.format, {k, i}, level);
                ASSERT_TRUE(shown.has_value());
                const Picture pa = exact_picture(a, {k, i}, level, Edge::kPad);
                Picture want = exact_picture(b, {k, i}, level, Edge::kPad);
                for (std::size_t p = 0; p < want.pixels.size(); ++p) {
                    want.pixels[p] =
                        composite(pa.pixels[p], want.pixels[p], Operator::kAAtopB);
                }
                ASSERT_EQ(*shown, want) << k << "/" << i << "/" << level;
            }
        }
    }
}

TEST(Preview, OfSingleFramesIsFinal) {
    const auto below = plain_clip(testing::random_clip(30, 30, 3, 1));
    const auto above = plain_clip(testing::random_clip(9, 7, 4, 2));
    const FrameFormat canvas{30, 26, {25, 1}};
    const std::vector<CompositionLayer> layers = {
        {below.get(), {}, 0, 0, Operator::kAOverB},
        {above.get(), {{3, 2, 1}, 5, 3, {}}, 2, 0, Operator::kXor}};
    const auto composition = Composition::make(layers, canvas);
    ASSERT_TRUE(composition.has_value());
    const std::vector<Picture> final = testing::pictures_of(**composition);
    const ClipShape& shape = (*composition)->shape();
    for (std::int64_t t = 0; t < shape.frames(); ++t) {
        EXPECT_EQ(preview(layers, canvas, {shape.time_levels(), t}, 5).value(),
                  final[static_cast<std::size_t>(t)])
            << t;
    }
}

// A layer that begins late does not share the composition's time nodes.
TEST(Preview, AveragesFramesThatNoTimeNodeHas) {
    const RawClip raw = testing::random_clip(8, 8, 5, 4);
    const auto clip = plain_clip(raw);
    // The frames 3 .. 7 move, 8 and 9 repeat the last; the others are clear.
    const std::vector<CompositionLayer> layers = {
        {clip.get(), {}, 3, 7, Operator::kAOverB}, {clip.get(), {}, 12, 1, Operator::kB}};
    RawClip all;
    all.format = raw.format;
    for (int t = 0; t < 13; ++t) {
        all.frames.push_back(
            t < 3 || t >= 10 ? Picture(8, 8)
                             : raw.frames[static_cast<std::size_t>(std::min(t - 3, 4))]);
    }
    const ClipShape shape = testing::shape_of(all);
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const Picture shown = preview(layers, all.format, {k, i}, 3).value();
            const Picture want = exact_picture(all, {k, i}, 3, Edge::kPad);
            for (std::size_t p = 0; p < want.pixels.size(); ++p) {
                // The means of the nodes are rounded before they are averaged.
                ASSERT_NEAR(shown.pixels[p].a, want.pixels[p].a, 1)
                    << k << "/" << i << " " << p;
                ASSERT_NEAR(shown.pixels[p].r * shown.pixels[p].a,
                            want.pixels[p].r * want.pixels[p].a,
                            2 * 255)
                    << k << "/" << i << " " << p;
            }
        }
    }
}

TEST(Preview, OfAScaledLayerTakesTheLevelThatFits) {
    const RawClip raw = testing::random_clip(16, 16, 1, 4);
    const auto clip = plain_clip(raw);
    const std::vector<CompositionLayer> layers = {
        {clip.get(), {{4, 4, 0}, 8, 8, {}}, 0, 0, Operator::kAOverB}};
    const FrameFormat canvas{128, 128, {25, 1}};
    // Eight pixels of the canvas are two of the clip: its level 3.
    EXPECT_EQ(
        preview(layers, canvas, {0, 0}, 4).value(),
        testing::placed_pixels(
            exact_picture(raw, {0, 0}, 3, Edge::kPad), 1, 1, 1, 1, {16, 16, {25, 1}}));
    // Smaller than a pixel of the preview it is one pixel, or none.
    EXPECT_EQ(preview(layers, canvas, {0, 0}, 0).value().at(0, 0),
              exact_picture(raw, {0, 0}, 0, Edge::kPad).at(0, 0));
}

TEST(Preview, WhatCannotBeIsNamed) {
    const auto clip = plain_clip(testing::random_clip(8, 8, 3, 4));
    const std::vector<CompositionLayer> layers = {
        {clip.get(), {}, 0, 0, Operator::kAOverB}};
    const FrameFormat canvas{8, 8, {25, 1}};
    const auto refused = [&](const NodeAddress& at, int level) {
        const Result<Picture> shown = preview(layers, canvas, at, level);
        return shown ? std::string("shown") : shown.error().param;
    };
    EXPECT_EQ(refused({3, 0}, 3), "time_level");
    EXPECT_EQ(refused({-1, 0}, 3), "time_level");
    EXPECT_EQ(refused({2, 3}, 3), "index");
    EXPECT_EQ(refused({2, -1}, 3), "index");
    EXPECT_EQ(refused({2, 0}, 4), "level");
    EXPECT_EQ(refused({2, 0}, -1), "level");
    EXPECT_EQ(preview({}, canvas, {0, 0}, 0).error().param, "layers");
}

TEST(Preview, PassesOnWhatTheStorageMeets) {
    const auto clip = plain_clip(testing::random_clip(8, 8, 3, 4));
    EXPECT_TRUE(testing::passes_on_every_failure(*clip, [&](const TimeTree& failing) {
        // The root, and then the last frame, which stays.
        const std::vector<CompositionLayer> layers = {
            {clip.get(), {}, 0, 4, Operator::kAOverB},
            {&failing, {}, 0, 4, Operator::kAOverB}};
        return preview(layers, {8, 8, {25, 1}}, {0, 0}, 3);
    }));
}

}  // namespace
}  // namespace haarmony::video
