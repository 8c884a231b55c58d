#include "engine/video/clip_shape.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace haarmony::video {
namespace {

ClipShape shape(std::int32_t width, std::int32_t height, std::int64_t frames) {
    return *ClipShape::make({width, height, {25, 1}}, frames);
}

// Levels by doubling.
int levels_for(std::int64_t count) {
    int levels = 0;
    for (std::int64_t reached = 1; reached < count; reached *= 2) ++levels;
    return levels;
}

TEST(ClipShape, HasLevelsEnoughForItsLongerSideAndItsFrames) {
    for (const std::int32_t side : {1, 2, 3, 4, 5, 70, 768, 1024, 1025, 65'535, 65'536}) {
        EXPECT_EQ(shape(side, 1, 1).space_levels(), levels_for(side)) << side;
        EXPECT_EQ(shape(1, side, 1).space_levels(), levels_for(side)) << side;
    }
    for (const std::int64_t frames : {1, 2, 3, 4, 5, 13, 2000, 65'537, 1 << 30}) {
        EXPECT_EQ(shape(1, 1, frames).time_levels(), levels_for(frames)) << frames;
    }
}

TEST(ClipShape, NodesOfALevelCoverEveryFrameOnce) {
    for (const std::int64_t frames : {1, 2, 3, 5, 7, 8, 13, 64, 100}) {
        const ClipShape clip = shape(3, 2, frames);
        std::int64_t nodes = 0;
        for (int k = 0; k <= clip.time_levels(); ++k) {
            std::int64_t covered = 0;
            for (std::int64_t i = 0; i < clip.nodes_at(k); ++i) {
                ASSERT_TRUE(clip.contains({k, i}));
                const FrameRange range = clip.frames_of({k, i});
                ASSERT_EQ(range.first, covered) << frames << ": " << k << ", " << i;
                ASSERT_GE(range.count(), 1);
                ASSERT_LE(range.count(), std::int64_t{1} << (clip.time_levels() - k));
                covered = range.end;
            }
            EXPECT_EQ(covered, frames);
            EXPECT_FALSE(clip.contains({k, clip.nodes_at(k)}));
            EXPECT_FALSE(clip.contains({k, -1}));
            nodes += clip.nodes_at(k);
        }
        EXPECT_EQ(clip.time_nodes(), nodes);
        EXPECT_EQ(clip.nodes_at(0), 1);
        EXPECT_EQ(clip.nodes_at(clip.time_levels()), frames);
        EXPECT_FALSE(clip.contains({clip.time_levels() + 1, 0}));
        EXPECT_FALSE(clip.contains({-1, 0}));
    }
}

TEST(ClipShape, ANodeCoversWhatItsHalvesCover) {
    const ClipShape clip = shape(1, 1, 13);
    for (int k = 0; k < clip.time_levels(); ++k) {
        for (std::int64_t i = 0; i < clip.nodes_at(k); ++i) {
            const FrameRange range = clip.frames_of({k, i});
            EXPECT_EQ(clip.frames_of({k + 1, 2 * i}).first, range.first);
            const bool has_second = clip.contains({k + 1, 2 * i + 1});
            EXPECT_EQ(clip.frames_of({k + 1, 2 * i + (has_second ? 1 : 0)}).end,
                      range.end);
        }
    }
}

TEST(ClipShape, PicturesHaveEveryPixelThatShowsAPartOfTheFrame) {
    const ClipShape clip = shape(100, 5, 1);
    for (int level = 0; level <= clip.space_levels(); ++level) {
        const int side = 1 << (clip.space_levels() - level);
        int width = 0, height = 0;
        while (width * side < 100) ++width;
        while (height * side < 5) ++height;
        EXPECT_EQ(clip.width_at(level), width) << level;
        EXPECT_EQ(clip.height_at(level), height) << level;
    }
}

TEST(ClipShape, NamesTheValueOutsideItsLimits) {
    struct Case {
        FrameFormat format;
        std::int64_t frames;
        const char* param;
        const char* message;
    };
    const Case cases[] = {
        {{0, 1, {}}, 1, "width", "width is 0; want 1 to 65536"},
        {{65'537, 1, {}}, 1, "width", "width is 65537; want 1 to 65536"},
        {{1, -3, {}}, 1, "height", "height is -3; want 1 to 65536"},
        {{1, 65'537, {}}, 1, "height", "height is 65537; want 1 to 65536"},
        {{1, 1, {0, 1}}, 1, "rate", "rate is 0/1; want a positive fraction"},
        {{1, 1, {25, 0}}, 1, "rate", "rate is 25/0; want a positive fraction"},
        {{1, 1, {-25, -1}}, 1, "rate", "rate is -25/-1; want a positive fraction"},
        {{1, 1, {}}, 0, "frames", "frames is 0; want 1 to 1073741824"},
        {{1, 1, {}}, -1, "frames", "frames is -1; want 1 to 1073741824"},
        {{1, 1, {}},
         (std::int64_t{1} << 30) + 1,
         "frames",
         "frames is 1073741825; want 1 to 1073741824"},
        {{40'000, 2, {}}, 32'769, "frames", "frames is 32769; want 1 to 32768"},
    };
    for (const auto& [format, frames, param, message] : cases) {
        const Result<ClipShape> made = ClipShape::make(format, frames);
        ASSERT_FALSE(made.has_value()) << message;
        EXPECT_EQ(made.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(made.error().param, param);
        EXPECT_EQ(made.error().message, message);
    }
    EXPECT_EQ(shape(65'536, 65'536, 32'768).time_levels(), 15);
    EXPECT_EQ(shape(1, 1, std::int64_t{1} << 30).time_levels(), 30);
}

}  // namespace
}  // namespace haarmony::video
