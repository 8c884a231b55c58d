// Frames painted as deep as they have detail, against the scene looked up pixel by pixel.
#include "engine/video/generate/refine.h"

#include <gtest/gtest.h>

#include "engine/video/generate/scene.h"
#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

Scene scene() {
    Scene scene({10, 20, 30, 255});
    scene.rectangle(0.1, 0.2, 0.55, 0.6, {200, 0, 0, 255});
    scene.ellipse(0.6, 0.5, 0.3, 0.12, {0, 200, 0, 128});
    scene.line(0.05, 0.9, 0.9, 0.15, 0.03, {0, 0, 200, 255});
    scene.line(0.3, 0.3, 0.3, 0.3, 0.1, kClear);
    return scene;
}

int levels_of(const FrameFormat& format) {
    return ClipShape::make(format, 1).value().space_levels();
}

TEST(Scene, TheLastShapeThatCoversAPointIsSeen) {
    EXPECT_EQ(scene().color_at(0.01, 0.01), (Rgba{10, 20, 30, 255}));
    EXPECT_EQ(scene().color_at(0.12, 0.22), (Rgba{200, 0, 0, 255}));
    EXPECT_EQ(scene().color_at(0.5, 0.5), (Rgba{0, 0, 200, 255}));
    EXPECT_EQ(scene().color_at(0.85, 0.5), (Rgba{0, 200, 0, 128}));
    EXPECT_EQ(scene().color_at(0.33, 0.32), kClear);
}

TEST(Refine, EqualsTheSceneAtEveryPixel) {
    const Scene drawn = scene();
    for (const FrameFormat& format :
         {FrameFormat{256, 256, {}}, {100, 61, {}}, {9, 40, {}}}) {
        const double unit = 1.0 / format.height;
        ImageTree tree;
        refine(*drawn.field(unit), format, levels_of(format), tree);
        const Picture picture = testing::picture_of(tree, format);
        for (std::int32_t y = 0; y < format.height; ++y) {
            for (std::int32_t x = 0; x < format.width; ++x) {
                ASSERT_EQ(picture.at(x, y),
                          drawn.color_at((x + 0.5) * unit, (y + 0.5) * unit))
                    << format.width << " " << x << "," << y;
            }
        }
    }
}

TEST(Refine, WhatLiesBeyondThePictureIsClear) {
    const FrameFormat format{100, 61, {}};
    ImageTree tree;
    refine(*Scene({1, 2, 3, 255}).field(1), format, 7, tree);
    for (int y = 0; y < 128; ++y) {
        for (int x = 0; x < 128; ++x) {
            const Rgba want = x < 100 && y < 61 ? Rgba{1, 2, 3, 255} : kClear;
            ASSERT_EQ(testing::pixel_of(tree, 7, x, y), want) << x << "," << y;
        }
    }
}

TEST(Refine, GoesNoDeeperThanItIsTold) {
    const FrameFormat format{256, 256, {}};
    const Scene drawn = scene();
    for (int depth = 3; depth <= 8; ++depth) {
        ImageTree tree;
        refine(*drawn.field(1.0 / 256), format, depth, tree);
        const int cell = 256 >> depth;
        const Picture picture = testing::picture_of(tree, format);
        for (std::int32_t y = 0; y < 256; ++y) {
            for (std::int32_t x = 0; x < 256; ++x) {
                ASSERT_EQ(picture.at(x, y),
                          drawn.color_at((x / cell + 0.5) * cell / 256,
                                         (y / cell + 0.5) * cell / 256))
                    << depth << " " << x << "," << y;
            }
        }
    }
}

TEST(Refine, TwiceTheSideIsTwiceTheOutline) {
    const Scene drawn = scene();
    std::vector<double> bricks;
    for (int side = 256; side <= 2048; side *= 2) {
        const FrameFormat format{side, side, {}};
        ImageTree tree;
        refine(*drawn.field(1.0 / side), format, levels_of(format), tree);
        bricks.push_back(static_cast<double>(tree.bricks.size()));
    }
    for (std::size_t i = 1; i < bricks.size(); ++i) {
        EXPECT_LT(bricks[i], 2.4 * bricks[i - 1]);
        EXPECT_GT(bricks[i], 1.6 * bricks[i - 1]);
    }
}

// One colour that stays for three frames.
class SlowField final : public Field {
  public:
    explicit SlowField(std::int64_t frame) : shade_(static_cast<std::uint8_t>(frame)) {}
    bool sample(const FieldSquare&, Brick& brick) const override {
        brick.fill({shade_, shade_, shade_, 255});
        return false;
    }
    std::int64_t stays() const override { return 3; }

  private:
    std::uint8_t shade_;
};

TEST(RefinedFrames, StayAsLongAsTheirFieldSays) {
    const auto source = refined_frames({8, 8, {}}, 7, 3, [](std::int64_t frame) {
        return std::make_unique<SlowField>(frame);
    });
    std::vector<int> shades;
    for (const Picture& picture : testing::pictures_of(*source)) {
        shades.push_back(picture.at(0, 0).r);
    }
    EXPECT_EQ(shades, (std::vector<int>{0, 0, 0, 3, 3, 3, 6}));
}

}  // namespace
}  // namespace haarmony::video
