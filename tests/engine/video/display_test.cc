#include "engine/video/display.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::exact_picture;
using testing::linked_clip;
using testing::moving_clip;
using testing::plain_clip;
using testing::random_clip;
using testing::RawClip;

constexpr std::array kBothEdges = {Edge::kPad, Edge::kNormalize};

void expect_exact_pictures(const RawClip& raw, const TimeTree& clip) {
    const ClipShape& shape = clip.shape();
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const Frame frame = *clip.frame({k, i}, shape.space_levels());
            for (int level = 0; level <= shape.space_levels(); ++level) {
                for (const Edge edge : kBothEdges) {
                    ASSERT_EQ(draw(frame, level, edge),
                              exact_picture(raw, {k, i}, level, edge))
                        << k << "/" << i << "/" << level << " edge " << int(edge);
                }
            }
        }
    }
}

TEST(Display, EveryAddressShowsItsExactMean) {
    for (const auto& [width, height, frames] : {std::array{1, 1, 1},
                                                {3, 2, 3},
                                                {8, 8, 2},
                                                {13, 9, 3},
                                                {5, 40, 2},
                                                {33, 20, 5}}) {
        const RawClip raw = random_clip(width, height, frames, 1);
        expect_exact_pictures(raw, *plain_clip(raw));
    }
}

TEST(Display, LinksAndMissingChildrenShowTheSame) {
    for (const auto& [width, height, frames] :
         {std::array{4, 3, 3}, {13, 9, 3}, {32, 32, 8}, {50, 21, 5}}) {
        const RawClip moving = moving_clip(width, height, frames, 2);
        expect_exact_pictures(moving, *linked_clip(moving));
        const RawClip coherent = random_clip(width, height, frames, 3, true);
        expect_exact_pictures(coherent, *linked_clip(coherent));
    }
}

TEST(Display, AFlatPictureHasOneBrickAndIsDrawnAtAnyLevel) {
    RawClip raw{{64, 64, {25, 1}}, {Picture(64, 64)}};
    raw.frames[0].pixels.assign(64 * 64, Rgba{9, 8, 7, 255});
    const auto clip = linked_clip(raw);
    EXPECT_TRUE((*clip->layer({0, 0}, 4))->nodes.empty());
    expect_exact_pictures(raw, *clip);
}

TEST(Display, ABoxIsThatPartOfThePictureAndNothingElseIsWritten) {
    std::mt19937 random(4);
    const RawClip raw = moving_clip(45, 30, 1, 5);
    const auto clip = linked_clip(raw);
    const Frame frame = *clip->frame({0, 0}, 6);
    const Rgba untouched{1, 2, 3, 4};
    for (int round = 0; round < 400; ++round) {
        const int level = static_cast<int>(random() % 7);
        const Picture whole = draw(frame, level, Edge::kNormalize);
        const auto below = [&random](std::int32_t n) {
            return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
        };
        const std::int32_t x = below(whole.width), y = below(whole.height);
        const PixelBox box{x, y, below(whole.width - x + 1), below(whole.height - y + 1)};
        Picture canvas(box.width + 3, box.height + 2);
        canvas.pixels.assign(canvas.pixels.size(), untouched);
        draw(frame, level, Edge::kNormalize, box, &canvas.at(1, 1), canvas.width);
        for (std::int32_t v = 0; v < canvas.height; ++v) {
            for (std::int32_t u = 0; u < canvas.width; ++u) {
                const bool inside = u >= 1 && v >= 1 && u <= box.width && v <= box.height;
                ASSERT_EQ(canvas.at(u, v),
                          inside ? whole.at(x + u - 1, y + v - 1) : untouched)
                    << level << ": " << x << "," << y << " " << box.width << "x"
                    << box.height << " at " << u << "," << v;
            }
        }
    }
}

TEST(Display, TheBoundingBoxHoldsAllThatIsNotClear) {
    RawClip raw{{40, 25, {25, 1}}, {Picture(40, 25), Picture(40, 25)}};
    raw.frames[0].at(7, 20) = {1, 2, 3, 255};
    raw.frames[1].at(30, 22) = {1, 2, 3, 255};
    const auto clip = plain_clip(raw);
    EXPECT_EQ(bounding_box(*clip->frame({1, 0}, 6), 6), (PixelBox{7, 20, 1, 1}));
    EXPECT_EQ(bounding_box(*clip->frame({0, 0}, 6), 6), (PixelBox{7, 20, 24, 3}));
    EXPECT_EQ(bounding_box(*clip->frame({0, 0}, 6), 4), (PixelBox{1, 5, 7, 1}));
    EXPECT_EQ(bounding_box(*clip->frame({0, 0}, 6), 0), (PixelBox{0, 0, 1, 1}));
}

TEST(Display, AClearFrameHasAnEmptyBoundingBox) {
    const RawClip raw{{9, 9, {25, 1}}, {Picture(9, 9)}};
    EXPECT_EQ(bounding_box(*plain_clip(raw)->frame({0, 0}, 4), 4), PixelBox{});
}

}  // namespace
}  // namespace haarmony::video
