// The oracle itself, on clips small enough to reckon by hand.
#include "tests/engine/video/plain_clip.h"

#include <gtest/gtest.h>

namespace haarmony::video::testing {
namespace {

RawClip two_frames() {
    RawClip clip;
    clip.format = {2, 1, {25, 1}};
    for (int t = 0; t < 2; ++t) {
        Picture frame(2, 1);
        frame.at(0, 0) = {static_cast<std::uint8_t>(10 * t), 0, 0, 255};
        frame.at(1, 0) = {200, 0, 0, static_cast<std::uint8_t>(t == 0 ? 255 : 0)};
        if (t == 1) frame.at(1, 0) = kClear;
        clip.frames.push_back(frame);
    }
    return clip;
}

TEST(PlainClip, APixelIsTheMeanOfItsFrames) {
    const Picture blurred = exact_picture(two_frames(), {0, 0}, 1, Edge::kPad);
    EXPECT_EQ(blurred.at(0, 0), (Rgba{5, 0, 0, 255}));
    EXPECT_EQ(blurred.at(1, 0), (Rgba{200, 0, 0, 128}));
}

TEST(PlainClip, PaddingCountsOnlyWhereItIsAskedFor) {
    const Picture padded = exact_picture(two_frames(), {1, 0}, 0, Edge::kPad);
    const Picture normalized = exact_picture(two_frames(), {1, 0}, 0, Edge::kNormalize);
    EXPECT_EQ(padded.at(0, 0), (Rgba{100, 0, 0, 128}));
    EXPECT_EQ(normalized.at(0, 0), (Rgba{100, 0, 0, 255}));
}

TEST(PlainClip, BricksHoldTheExactPictures) {
    const RawClip raw = random_clip(13, 9, 3, 7);
    const std::unique_ptr<MemoryClip> clip = plain_clip(raw);
    const ClipShape& shape = clip->shape();
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const Result<Frame> frame = clip->frame({k, i}, 4);
            ASSERT_TRUE(frame.has_value());
            for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
                const Picture want = exact_picture(raw, {k, i}, 3, edge);
                const LinkedNode& root = (*frame).node(3, (*frame).root(edge));
                const Brick& brick = (*frame).brick(3, root.brick);
                for (int y = 0; y < want.height; ++y) {
                    for (int x = 0; x < want.width; ++x) {
                        EXPECT_EQ(brick[static_cast<std::size_t>(y * kBrickSide + x)],
                                  want.at(x, y));
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::video::testing
