// Compositions, frame by frame against pixels placed and composited on their own.
#include "engine/video/ops/compose.h"

#include <gtest/gtest.h>

#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/ops/plain_trees.h"
#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::pictures_of;
using testing::plain_clip;
using testing::RawClip;

struct Layer {
    RawClip raw;
    CompositionLayer layer;
};

std::vector<Picture> by_pixels(const std::vector<Layer>& layers,
                               const FrameFormat& canvas) {
    std::int64_t frames = 0;
    for (const Layer& each : layers) {
        const auto own = static_cast<std::int64_t>(each.raw.frames.size());
        frames = std::max(
            frames,
            each.layer.start + (each.layer.frames == 0 ? own : each.layer.frames));
    }
    std::vector<Picture> all;
    for (std::int64_t t = 0; t < frames; ++t) {
        Picture below(canvas.width, canvas.height);
        for (const auto& [raw, layer] : layers) {
            const ClipShape shape = testing::shape_of(raw);
            const std::int64_t own = shape.frames();
            const std::int64_t at = t - layer.start;
            Picture placed(canvas.width, canvas.height);
            if (at >= 0 && at < (layer.frames == 0 ? own : layer.frames)) {
                const Placement& where = layer.placement;
                const int unit = 1 << (shape.space_levels() -
                                       where.at_level.value_or(shape.space_levels()));
                placed = testing::placed_pixels(
                    testing::exact_picture(raw,
                                           {shape.time_levels(), std::min(at, own - 1)},
                                           shape.space_levels() - where.scale.shrink,
                                           Edge::kPad),
                    where.scale.x,
                    where.scale.y,
                    where.dx * unit,
                    where.dy * unit,
                    canvas);
            }
            for (std::size_t i = 0; i < below.pixels.size(); ++i) {
                below.pixels[i] = composite(placed.pixels[i], below.pixels[i], layer.op);
            }
        }
        all.push_back(below);
    }
    return all;
}

// The clips of layers, built without sharing, which the layers then name.
std::vector<std::unique_ptr<MemoryClip>> attach(std::vector<Layer>& layers) {
    std::vector<std::unique_ptr<MemoryClip>> clips;
    for (Layer& each : layers) {
        clips.push_back(plain_clip(each.raw));
        each.layer.clip = clips.back().get();
    }
    return clips;
}

std::vector<CompositionLayer> composition_of(const std::vector<Layer>& layers) {
    std::vector<CompositionLayer> all;
    for (const Layer& each : layers) all.push_back(each.layer);
    return all;
}

TEST(Composition, EqualsPixelsForEveryOperator) {
    const FrameFormat canvas{40, 30, {25, 1}};
    for (std::size_t op = 0; op < kOperatorNames.size(); ++op) {
        std::vector<Layer> layers(3);
        layers[0].raw = testing::random_clip(33, 20, 4, 1, true);
        layers[1].raw = testing::random_clip(9, 14, 3, 2, true);
        layers[1].layer.placement = {{3, 2, 0}, -4, 1, 3};
        layers[1].layer.start = 2;
        layers[1].layer.op = static_cast<Operator>(op);
        layers[2].raw = testing::random_clip(20, 20, 1, 3);
        layers[2].layer.placement = {{3, 1, 1}, 7, -2, {}};
        layers[2].layer.frames = 6;
        const auto clips = attach(layers);
        const auto composition = Composition::make(composition_of(layers), canvas);
        ASSERT_TRUE(composition.has_value());
        EXPECT_EQ((*composition)->shape().frames(), 6);
        EXPECT_EQ(pictures_of(**composition), by_pixels(layers, canvas))
            << kOperatorNames[op];
    }
}

TEST(Composition, OfATinyCanvasEqualsPixels) {
    for (const int side : {1, 2, 3, 5}) {
        const FrameFormat canvas{side, 4, {25, 1}};
        std::vector<Layer> layers(2);
        layers[0].raw = testing::random_clip(3, 2, 2, 1);
        layers[1].raw = testing::random_clip(2, 5, 2, 9);
        layers[1].layer.placement = {{3, 1, 1}, -1, 1, {}};
        const auto clips = attach(layers);
        const auto composition = Composition::make(composition_of(layers), canvas);
        ASSERT_TRUE(composition.has_value());
        EXPECT_EQ(pictures_of(**composition), by_pixels(layers, canvas)) << side;
    }
}

TEST(Composition, AStillPictureIsOneFrameThatStays) {
    std::vector<Layer> layers(1);
    layers[0].raw = testing::random_clip(8, 8, 1, 1);
    layers[0].layer.start = 3;
    layers[0].layer.frames = 1'000'000;
    const auto clips = attach(layers);
    const auto composition =
        Composition::make(composition_of(layers), layers[0].raw.format);
    ASSERT_TRUE(composition.has_value());
    SourceFrame frame;
    ASSERT_TRUE(*(*composition)->next(frame));
    EXPECT_EQ(frame.repeats, 3);
    ASSERT_TRUE(*(*composition)->next(frame));
    EXPECT_EQ(frame.repeats, 1'000'000);
    EXPECT_FALSE(*(*composition)->next(frame));
}

TEST(Composition, LayersThatStayAreNotVisitedAgain) {
    std::vector<std::int64_t> visits;
    for (const int frames : {1, 5}) {
        std::vector<Layer> layers(2);
        layers[0].raw = testing::random_clip(64, 64, 1, 1);
        layers[0].layer.frames = frames;
        layers[1].raw = testing::random_clip(4, 4, frames, 2);
        const auto clips = attach(layers);
        const auto composition =
            Composition::make(composition_of(layers), layers[0].raw.format);
        ASSERT_TRUE(composition.has_value());
        (void)pictures_of(**composition);
        visits.push_back((*composition)->visited().read);
    }
    // Once all; then, for each of four frames, the small layer, placed and composited
    // with the 64 bricks below: their own nodes and those of the layer, twice at most.
    EXPECT_LE(visits[1] - visits[0], 4 * 2 * (64 + 16 + 4 + 1 + 4));
    EXPECT_GT(visits[1], visits[0]);
}

TEST(Composition, GrowsToWhatIsOnIt) {
    std::vector<Layer> layers(2);
    layers[0].raw = testing::random_clip(10, 6, 1, 1);
    layers[0].layer.placement = {{1, 1, 0}, -7, 2, {}};
    layers[1].raw = testing::random_clip(4, 4, 1, 2);
    layers[1].layer.placement = {{2, 2, 0}, 1, -1, 1};
    const auto clips = attach(layers);
    const Result<CanvasBox> box = composed_box(composition_of(layers));
    ASSERT_TRUE(box.has_value());
    EXPECT_EQ(*box, (CanvasBox{-7, -2, 17, 10}));
    std::vector<CompositionLayer> moved = composition_of(layers);
    for (CompositionLayer& layer : moved) {
        layer.placement =
            moved_by(layer.placement, layer.clip->shape(), -(*box).left, -(*box).top);
    }
    EXPECT_EQ(composed_box(moved).value(), (CanvasBox{0, 0, 17, 10}));
}

void expect_refused(const std::vector<CompositionLayer>& layers,
                    const FrameFormat& canvas,
                    const std::string& param) {
    const auto composition = Composition::make(layers, canvas);
    ASSERT_FALSE(composition.has_value()) << param;
    EXPECT_EQ(composition.error().param, param);
    EXPECT_EQ(composition.error().code, ErrorCode::kInvalidArgument);
}

TEST(Composition, WhatCannotBeIsRefusedAtOnce) {
    const auto clip = plain_clip(testing::random_clip(8, 8, 2, 1));
    const FrameFormat canvas{8, 8, {25, 1}};
    CompositionLayer layer;
    layer.clip = clip.get();
    expect_refused({}, canvas, "layers");
    expect_refused(
        std::vector<CompositionLayer>(kMaxLayers + 1, layer), canvas, "layers");
    expect_refused({layer}, {0, 8, {25, 1}}, "width");
    expect_refused({layer}, {8, 70'000, {25, 1}}, "height");
    expect_refused({layer}, {8, 8, {0, 1}}, "rate");
    CompositionLayer bad = layer;
    bad.start = -1;
    expect_refused({layer, bad}, canvas, "start");
    bad = layer;
    bad.frames = -2;
    expect_refused({bad}, canvas, "frames");
    bad = layer;
    bad.start = (std::int64_t{1} << kMaxTimeLevels);
    expect_refused({bad}, canvas, "frames");
    bad = layer;
    bad.placement.at_level = 9;
    expect_refused({bad}, canvas, "at_level");
    bad = layer;
    bad.placement.scale.shrink = 4;
    expect_refused({layer, bad}, canvas, "scale");
    EXPECT_NE(Composition::make({layer, bad}, canvas).error().message.find("layer 1"),
              std::string::npos);
    EXPECT_FALSE(composed_box({}).has_value());
    EXPECT_FALSE(composed_box({{bad}}).has_value());
}

TEST(Composition, PassesOnWhatTheStorageMeets) {
    const auto clip = plain_clip(testing::random_clip(8, 8, 2, 1));
    const testing::FailingClip failing(*clip, 3);
    CompositionLayer layer;
    layer.clip = &failing;
    const auto composition = Composition::make({layer}, {8, 8, {25, 1}});
    ASSERT_TRUE(composition.has_value());
    SourceFrame frame;
    EXPECT_TRUE((*composition)->next(frame).has_value());
    const Result<bool> more = (*composition)->next(frame);
    ASSERT_FALSE(more.has_value());
    EXPECT_EQ(more.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::video
