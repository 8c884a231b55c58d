// Pieces of clip-art: how they are to be made, where they end up, and what is passed on.
#include "engine/video/generate/clip_art.h"

#include <gtest/gtest.h>

#include "tests/engine/video/ops/source_pictures.h"

namespace haarmony::video {
namespace {

using testing::GreyFrames;

TEST(ClipArt, PiecesHaveTheirOwnDepth) {
    // Painted to level 7 of 9: the finest detail is 4 pixels wide.
    const ClipArt art({{512, 256, {}}, 6, 7, 3});
    EXPECT_EQ(art.unit(1), 4.0 / 256);
    EXPECT_EQ(art.unit(2), 8.0 / 256);
    const Recipe piece = art.piece(0.5, 0.25, 1);
    EXPECT_EQ(piece.format, (FrameFormat{32, 16, {}}));
    EXPECT_EQ(piece.depth, 5);
    EXPECT_EQ(piece.frames, 6);
    EXPECT_EQ(piece.seed, 3U);
    // No less than a brick.
    EXPECT_EQ(art.piece(0.01, 0.5, 4).format, (FrameFormat{8, 8, {}}));
}

TEST(ClipArt, LayersLieOnWholePixelsOfTheirOwn) {
    ClipArt art({{64, 64, {}}, 3, 6, 1});
    GreyFrames below({64, 64, {}}, 1, false), above({8, 8, {}}, 3, false);
    ASSERT_TRUE(art.add(below, 0, 0, 1).has_value());
    // 0.3 of 64 is pixel 19, in pixels of 4 the fifth: 16.
    ASSERT_TRUE(art.add(above, 0.3, 0.5, 4).has_value());
    const auto source = art.composed();
    ASSERT_TRUE(source.has_value());
    const std::vector<Picture> pictures = testing::pictures_of(**source);
    ASSERT_EQ(pictures.size(), 3U);
    for (std::size_t t = 0; t < 3; ++t) {
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const bool covered = x >= 16 && x < 48 && y >= 32;
                ASSERT_EQ(pictures[t].at(x, y).r, covered ? 10 * t : 0) << x << "," << y;
            }
        }
    }
}

TEST(ClipArt, PassesOnWhatBuildingAndComposingMeet) {
    ClipArt art({{64, 64, {}}, 3, 6, 1});
    GreyFrames failing({8, 8, {}}, 1, true);
    const Result<void> added = art.add(failing, 0, 0, 1);
    ASSERT_FALSE(added.has_value());
    EXPECT_EQ(added.error().code, ErrorCode::kIo);
    const auto source = art.composed();
    ASSERT_FALSE(source.has_value());
    EXPECT_EQ(source.error().param, "layers");
}

}  // namespace
}  // namespace haarmony::video
