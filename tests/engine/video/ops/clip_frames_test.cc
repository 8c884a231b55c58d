// Ranges of a clip.
#include "engine/video/ops/clip_frames.h"

#include <gtest/gtest.h>

#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::pictures_of;

TEST(RangeFrames, AreTheClipsOwn) {
    const testing::RawClip raw = testing::random_clip(13, 9, 6, 3);
    const auto clip = testing::plain_clip(raw);
    for (std::int64_t first = 0; first < 6; ++first) {
        for (std::int64_t end = first + 1; end <= 6; ++end) {
            const auto source = range_frames(*clip, {first, end});
            ASSERT_TRUE(source.has_value());
            EXPECT_EQ((*source)->format(), raw.format);
            EXPECT_EQ(pictures_of(**source),
                      std::vector<Picture>(raw.frames.begin() + first,
                                           raw.frames.begin() + end));
        }
    }
}

TEST(RangeFrames, OutsideTheClipAreRefused) {
    const auto clip = testing::plain_clip(testing::random_clip(4, 4, 5, 3));
    for (const FrameRange range : {FrameRange{-1, 2}, {0, 6}, {3, 3}, {4, 2}, {5, 6}}) {
        const auto source = range_frames(*clip, range);
        ASSERT_FALSE(source.has_value());
        EXPECT_EQ(source.error().param, "frames");
        EXPECT_NE(source.error().message.find(std::to_string(range.end)),
                  std::string::npos);
    }
}

TEST(RangeFrames, PassOnWhatTheStorageMeets) {
    const auto clip = testing::plain_clip(testing::random_clip(16, 16, 2, 3));
    const testing::FailingClip failing(*clip, 3);
    const auto source = range_frames(failing, {0, 2});
    ASSERT_TRUE(source.has_value());
    SourceFrame frame;
    const Result<bool> more = (*source)->next(frame);
    ASSERT_FALSE(more.has_value());
    EXPECT_EQ(more.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::video
