#include "ingest/key_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

namespace haarmony::ingest {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// Pictures whose red says which one it is.
class PretendedSource final : public PictureSource {
  public:
    explicit PretendedSource(std::vector<std::int64_t> times_us)
        : times_us_(std::move(times_us)) {}

    const video::FrameFormat& format() const override { return format_; }
    Result<bool> next(TimedPicture& shown) override {
        if (next_ == fails_at) return Error{ErrorCode::kUndecodable, "forced"};
        if (next_ == times_us_.size()) return false;
        shown.picture = video::Picture(1, 1);
        shown.picture.at(0, 0).r = static_cast<std::uint8_t>(next_);
        shown.time_us = times_us_[next_++];
        return true;
    }

    std::size_t fails_at = static_cast<std::size_t>(-1);

  private:
    video::FrameFormat format_{1, 1, {30'000, 1'001}};
    std::vector<std::int64_t> times_us_;
    std::size_t next_ = 0;
};

Result<schema::NewImage> red_as_width(const ImageView& picture) {
    schema::NewImage image;
    image.width = picture.row(0)[0];
    return image;
}

bool always() { return true; }

std::vector<std::int64_t> every_second(std::size_t count) {
    std::vector<std::int64_t> times(count);
    for (std::size_t i = 0; i < count; ++i)
        times[i] = static_cast<std::int64_t>(i) * 1'000'000;
    return times;
}

// Which pictures are kept of `count`.
std::vector<int> kept_of(std::size_t count, std::size_t most) {
    PretendedSource source(every_second(count));
    const auto frames = describe_key_frames(source, most, red_as_width, always);
    EXPECT_TRUE(frames);
    std::vector<int> kept;
    for (const KeyFrame& frame : *frames) {
        kept.push_back(frame.image.width);
        EXPECT_EQ(frame.time_us, std::int64_t{1'000'000} * frame.image.width);
    }
    return kept;
}

TEST(KeyFrames, AreAllThereWhileTheyAreFew) {
    EXPECT_THAT(kept_of(0, 3), IsEmpty());
    EXPECT_THAT(kept_of(1, 1), ElementsAre(0));
    EXPECT_THAT(kept_of(3, 3), ElementsAre(0, 1, 2));
}

TEST(KeyFrames, OfManyAreEvenlySpacedAndAtLeastHalfAsManyAsWanted) {
    EXPECT_THAT(kept_of(4, 3), ElementsAre(0, 2));
    EXPECT_THAT(kept_of(5, 3), ElementsAre(0, 2, 4));
    EXPECT_THAT(kept_of(9, 2), ElementsAre(0, 8));
    EXPECT_THAT(kept_of(200, 1), ElementsAre(0));
    for (std::size_t count = 1; count <= 60; ++count) {
        for (std::size_t most = 1; most <= count; ++most) {
            const std::vector<int> kept = kept_of(count, most);
            ASSERT_LE(kept.size(), most) << count;
            ASSERT_GE(2 * kept.size(), most) << count;
            const int step = kept.size() > 1 ? kept[1] : static_cast<int>(count);
            for (std::size_t i = 0; i < kept.size(); ++i)
                ASSERT_EQ(kept[i], static_cast<int>(i) * step) << count << ' ' << most;
            // None is missing at the end.
            ASSERT_GE(kept.back() + step, static_cast<int>(count)) << most;
        }
    }
}

TEST(KeyFrames, AreNumberedByTheRateOfTheFilm) {
    PretendedSource source({0, 33'367, 8'341'667});
    const auto frames = describe_key_frames(source, 10, red_as_width, always);
    ASSERT_TRUE(frames);
    EXPECT_EQ((*frames)[0].number, 0);
    EXPECT_EQ((*frames)[1].number, 1);
    EXPECT_EQ((*frames)[2].number, 250);
}

TEST(KeyFrames, WithinOneMillisecondAreOneAndNoneIsBeforeTheBeginning) {
    PretendedSource source({-40'000, 100, 1'600, 2'400, 2'600});
    const auto frames = describe_key_frames(source, 10, red_as_width, always);
    ASSERT_TRUE(frames);
    std::vector<std::int64_t> times;
    for (const KeyFrame& frame : *frames) times.push_back(frame.time_us);
    EXPECT_THAT(times, ElementsAre(0, 1'600, 2'600));
}

TEST(KeyFrames, FailAsTheSourceAndTheDescriptionDo) {
    for (std::size_t step = 0; step < 3; ++step) {
        PretendedSource source(every_second(3));
        source.fails_at = step;
        const auto frames = describe_key_frames(source, 2, red_as_width, always);
        ASSERT_FALSE(frames);
        EXPECT_EQ(frames.error().message, "forced");
        PretendedSource whole(every_second(3));
        const auto described = describe_key_frames(
            whole,
            10,
            [step](const ImageView& picture) -> Result<schema::NewImage> {
                if (picture.row(0)[0] == step)
                    return Error{ErrorCode::kTooLarge, "forced too"};
                return schema::NewImage{};
            },
            always);
        ASSERT_FALSE(described);
        EXPECT_EQ(described.error().code, ErrorCode::kTooLarge);
    }
}

TEST(KeyFrames, StopWhenTheyAreToldTo) {
    for (int steps = 0; steps < 4; ++steps) {
        PretendedSource source(every_second(3));
        int left = steps;
        const auto frames =
            describe_key_frames(source, 10, red_as_width, [&left] { return left-- > 0; });
        ASSERT_FALSE(frames) << steps;
        EXPECT_EQ(frames.error().code, ErrorCode::kUnavailable);
    }
}

}  // namespace
}  // namespace haarmony::ingest
