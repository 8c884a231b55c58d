// Clips at other speeds, against the frames that each moment should show.
#include "engine/video/ops/retime.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

using testing::exact_picture;

TEST(Retime, EveryMomentShowsItsFrameOrItsBlur) {
    const testing::RawClip raw = testing::random_clip(9, 5, 13, 3);
    const auto clip = testing::plain_clip(raw);
    const int finest = clip->shape().time_levels();
    for (const Speed speed : {Speed{1, 1},
                              {2, 1},
                              {4, 1},
                              {64, 1},
                              {1, 2},
                              {1, 3},
                              {3, 2},
                              {5, 2},
                              {7, 1},
                              {2, 7},
                              {13, 1},
                              {6, 4}}) {
        const auto source = retime(*clip, speed);
        ASSERT_TRUE(source.has_value());
        const std::vector<Picture> shown = testing::pictures_of(**source);
        const double ratio =
            static_cast<double>(speed.numerator) / static_cast<double>(speed.denominator);
        ASSERT_EQ(shown.size(), static_cast<std::size_t>(std::ceil(13 / ratio)));
        const int blur = std::min(
            finest, static_cast<int>(std::floor(std::log2(std::max(1.0, ratio)))));
        for (std::size_t j = 0; j < shown.size(); ++j) {
            const auto moment =
                static_cast<std::int64_t>(j) * speed.numerator / speed.denominator;
            EXPECT_EQ(shown[j],
                      exact_picture(raw, {finest - blur, moment >> blur}, 4, Edge::kPad))
                << speed.numerator << "/" << speed.denominator << " " << j;
        }
    }
}

TEST(Retime, SlowFramesAreGivenOnce) {
    const auto clip = testing::plain_clip(testing::random_clip(9, 5, 3, 3));
    const auto source = retime(*clip, {1, 7});
    ASSERT_TRUE(source.has_value());
    SourceFrame frame;
    for (int t = 0; t < 3; ++t) {
        ASSERT_TRUE(*(*source)->next(frame));
        EXPECT_EQ(frame.repeats, 7);
    }
    EXPECT_FALSE(*(*source)->next(frame));
}

TEST(Retime, ImpossibleSpeedsAreNamed) {
    const auto clip = testing::plain_clip(testing::random_clip(9, 5, 3, 3));
    for (const Speed speed : {Speed{0, 1}, {1, 0}, {-1, 2}, {65'537, 1}, {1, 65'537}}) {
        const auto source = retime(*clip, speed);
        ASSERT_FALSE(source.has_value());
        EXPECT_EQ(source.error().param, "speed");
        EXPECT_NE(source.error().message.find(std::to_string(speed.numerator) + "/"),
                  std::string::npos);
    }
}

// 30 time levels less what the largest frames take: slowed down it would be too long.
class LongClip final : public TimeTree {
  public:
    LongClip() : TimeTree(ClipShape::make({8, 8, {25, 1}}, 1 << 20).value(), 0) {}
    bool stored(const SiblingAddress&) const override { return false; }
    Result<Frame::Nodes> nodes(const SiblingAddress&) const override {
        return Error{ErrorCode::kIo, "not here"};
    }
    Result<Frame::LayerPtr> layer(const SiblingAddress&, int) const override {
        return Error{ErrorCode::kIo, "not here"};
    }
};

TEST(Retime, AResultLongerThanAnyClipIsRefused) {
    const auto source = retime(LongClip(), {1, 65'536});
    ASSERT_FALSE(source.has_value());
    EXPECT_EQ(source.error().param, "speed");
    EXPECT_NE(source.error().message.find("too long"), std::string::npos);
}

TEST(Retime, PassesOnWhatTheStorageMeets) {
    const LongClip clip;
    const auto source = retime(clip, {1, 1});
    ASSERT_TRUE(source.has_value());
    SourceFrame frame;
    const Result<bool> more = (*source)->next(frame);
    ASSERT_FALSE(more.has_value());
    EXPECT_EQ(more.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace haarmony::video
