#include "engine/video/playback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"

namespace haarmony::video {
namespace {

ClipShape shape_of(std::int64_t frames) {
    return *ClipShape::make({4, 4, {25, 1}}, frames);
}

constexpr double kPeriod = 1.0 / 25;

// All steps of a clip played on time, without those that repeat.
std::vector<FrameRange> played(const ClipShape& shape, const PlaybackOptions& options) {
    Playback playback(shape, options, 0);
    std::vector<FrameRange> shown;
    for (int n = 0; n < 100000; ++n) {
        const auto step = playback.next(n * kPeriod, kPeriod);
        if (!step) return shown;
        if (!step->repeated) shown.push_back(shape.frames_of(step->at));
    }
    ADD_FAILURE() << "the clip does not end";
    return shown;
}

int steps_of(const ClipShape& shape, const PlaybackOptions& options) {
    Playback playback(shape, options, 0);
    int steps = 0;
    while (playback.next(steps * kPeriod, kPeriod)) ++steps;
    return steps;
}

TEST(Playback, AtItsOwnPaceShowsEachFrameOnce) {
    const auto shown = played(shape_of(13), {});
    ASSERT_EQ(shown.size(), 13U);
    for (std::int64_t i = 0; i < 13; ++i) {
        EXPECT_EQ(shown[static_cast<std::size_t>(i)], (FrameRange{i, i + 1}));
    }
}

TEST(Playback, BackwardsShowsEachFrameOnceFromTheEnd) {
    const auto shown = played(shape_of(13), {.position = 13, .speed = -1});
    ASSERT_EQ(shown.size(), 13U);
    for (std::int64_t i = 0; i < 13; ++i) {
        EXPECT_EQ(shown[static_cast<std::size_t>(i)], (FrameRange{12 - i, 13 - i}));
    }
}

TEST(Playback, BetweenTwoSpeedsTwoLevelsAlternate) {
    const auto shown = played(shape_of(12), {.speed = 1.5});
    const std::vector<FrameRange> want = {
        {0, 2}, {2, 3}, {3, 4}, {4, 6}, {6, 8}, {8, 9}, {9, 10}, {10, 12}};
    EXPECT_EQ(shown, want);
}

TEST(Playback, TakesAsLongAsItsSpeedSays) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> speeds(0.05, 30);
    for (int round = 0; round < 60; ++round) {
        const ClipShape shape = shape_of(500 + static_cast<std::int64_t>(random() % 500));
        const double speed = speeds(random) * (random() % 2 == 0 ? 1 : -1);
        const double start = speed < 0 ? static_cast<double>(shape.frames()) : 0;
        const double want = static_cast<double>(shape.frames()) / std::abs(speed);
        EXPECT_NEAR(steps_of(shape, {.position = start, .speed = speed}), want, 2.01)
            << speed;
    }
}

TEST(Playback, SlowMotionHoldsEachFrameForItsTime) {
    Playback playback(shape_of(5), {.speed = 0.25}, 0);
    for (int n = 0; n < 20; ++n) {
        const auto step = playback.next(n * kPeriod, kPeriod);
        ASSERT_TRUE(step.has_value());
        EXPECT_EQ(step->at, (NodeAddress{3, n / 4}));
        EXPECT_EQ(step->repeated, n % 4 != 0);
    }
    EXPECT_FALSE(playback.next(20 * kPeriod, kPeriod).has_value());
}

TEST(Playback, AtSpeedZeroOneFrameStays) {
    Playback playback(shape_of(5), {.position = 2.5, .speed = 0}, 0);
    EXPECT_EQ(playback.next(0, kPeriod)->at, (NodeAddress{3, 2}));
    EXPECT_EQ(playback.next(7, kPeriod), (TimeStep{{3, 2}, std::nullopt, 256, true}));
}

// Every frame on the way is in some step, and each step goes on where the last one ended,
// whatever the load; and the front is never more than a step from where it should be.
TEST(Playback, UnderAnyLoadNothingIsLeftOutAndThePositionHoldsWithinAStep) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 300; ++round) {
        const ClipShape shape =
            shape_of(300 + static_cast<std::int64_t>(random() % 3000));
        const auto frames = static_cast<double>(shape.frames());
        const double speed =
            std::exp2(6 * unit(random) - 3) * (random() % 2 == 0 ? 1 : -1);
        const double start = std::floor(unit(random) * frames);
        Playback playback(shape, {.position = start, .speed = speed}, 0);
        const double sign = speed < 0 ? -1 : 1;
        double now = 0;
        std::int64_t edge = playback.front();
        for (;;) {
            const double lag = sign * (playback.position(now + kPeriod) -
                                       static_cast<double>(playback.front()));
            const auto step = playback.next(now, kPeriod);
            if (!step) break;
            const FrameRange shown = shape.frames_of(step->at);
            if (speed > 0) {
                ASSERT_LE(shown.first, edge) << "left out at " << now;
                edge = std::max(edge, shown.end);
            } else {
                ASSERT_GE(shown.end, edge) << "left out at " << now;
                edge = std::min(edge, shown.first);
            }
            const double off = std::abs(static_cast<double>(playback.front()) -
                                        playback.position(now + kPeriod));
            ASSERT_LE(off, std::max({1.0, std::abs(speed), std::abs(lag)}))
                << "speed " << speed << " at " << now;
            // Mostly on time, sometimes a little and at times much too late.
            const double late = unit(random) < 0.8   ? 0
                                : unit(random) < 0.8 ? unit(random) * kPeriod
                                                     : unit(random) * 20 * kPeriod;
            now += kPeriod + late;
        }
        EXPECT_EQ(edge, speed > 0 ? shape.frames() : 0) << speed;
    }
}

TEST(Playback, BackOnTimeItIsSoonWithinTwoSteps) {
    const ClipShape shape = shape_of(1 << 14);
    for (const double speed : {1.0, 1.9, 3.0, 7.3}) {
        Playback playback(shape, {.speed = speed}, 0);
        double now = 0;
        for (int hiccup = 0; hiccup < 20; ++hiccup) {
            now += (20 + hiccup) * kPeriod;
            for (int n = 0; n < 8; ++n, now += kPeriod) (void)playback.next(now, kPeriod);
            EXPECT_LT(
                std::abs(static_cast<double>(playback.front()) - playback.position(now)),
                2 * speed)
                << speed << " after " << now;
        }
    }
}

TEST(Playback, AChangeOfSpeedGoesOnFromWhereTheClipShouldBe) {
    const ClipShape shape = shape_of(1024);
    Playback playback(shape, {.speed = 32}, 0);
    EXPECT_EQ(shape.frames_of(playback.next(0, kPeriod)->at), (FrameRange{0, 32}));
    // Half of that time later the clip is at frame 16: it turns round there.
    playback.set_speed(-1, kPeriod / 2);
    EXPECT_DOUBLE_EQ(playback.position(kPeriod / 2), 16);
    EXPECT_EQ(playback.next(kPeriod / 2, kPeriod)->at, (NodeAddress{10, 15}));
    playback.set_speed(2, kPeriod * 1.5);
    EXPECT_EQ(shape.frames_of(playback.next(kPeriod * 1.5, kPeriod)->at),
              (FrameRange{14, 16}));
}

TEST(Playback, SmoothedInTimeItMovesBetweenTheFrames) {
    Playback playback(shape_of(3), {.speed = 0.25, .smooth_in_time = true}, 0);
    std::vector<TimeStep> steps;
    for (int n = 0; n < 12; ++n) steps.push_back(*playback.next(n * kPeriod, kPeriod));
    EXPECT_FALSE(playback.next(12 * kPeriod, kPeriod).has_value());
    // The middle of step n is at frame (n + 1/2) / 4, that of frame i at i + 1/2.
    for (int n = 0; n < 12; ++n) {
        const double place = std::clamp((n + 0.5) / 4 - 0.5, 0.0, 2.0);
        const TimeStep& step = steps[static_cast<std::size_t>(n)];
        EXPECT_EQ(step.at, (NodeAddress{2, static_cast<std::int64_t>(place)})) << n;
        EXPECT_EQ(step.weight, 256 - 256 * (place - std::floor(place))) << n;
        EXPECT_EQ(step.next.has_value(), step.weight < 256) << n;
    }
    EXPECT_EQ(steps[3].next, (NodeAddress{2, 1}));
    EXPECT_EQ(steps[3].weight, 160U);
}

TEST(Playback, SmoothedInTimeBackwardsShowsTheSamePictures) {
    Playback forwards(shape_of(4), {.speed = 0.25, .smooth_in_time = true}, 0);
    Playback backwards(
        shape_of(4), {.position = 4, .speed = -0.25, .smooth_in_time = true}, 0);
    std::vector<TimeStep> there, back;
    for (int n = 0; n < 16; ++n) {
        there.push_back(*forwards.next(n * kPeriod, kPeriod));
        back.push_back(*backwards.next(n * kPeriod, kPeriod));
    }
    for (std::size_t n = 0; n < 16; ++n) {
        EXPECT_EQ(there[n].at, back[15 - n].at) << n;
        EXPECT_EQ(there[n].weight, back[15 - n].weight) << n;
    }
}

TEST(ZoomStep, ShowsANodeOrMixesTwoFrames) {
    const auto clip = testing::plain_clip(testing::random_clip(8, 8, 2, 3));
    const PixelBox box{0, 0, 8, 8};
    const Picture first = draw(*clip->frame({1, 0}, 3), 3, Edge::kPad);
    const Picture second = draw(*clip->frame({1, 1}, 3), 3, Edge::kPad);
    const TimeStep single{{1, 0}, std::nullopt, 256, false};
    EXPECT_EQ(*zoom_step(*clip, single, 8, Edge::kPad, box), first);
    const TimeStep between{{1, 0}, NodeAddress{1, 1}, 64, false};
    const Picture mixed = *zoom_step(*clip, between, 8, Edge::kPad, box);
    for (std::size_t i = 0; i < 64; ++i) {
        PixelSum sum = sum_of(first.pixels[i], 1);
        sum += sum_of(second.pixels[i], 3);
        EXPECT_EQ(mixed.pixels[i], mean(sum, 4));
    }
}

TEST(ZoomStep, PassesOnWhatTheStorageMeets) {
    const auto clip = testing::linked_clip(testing::moving_clip(20, 13, 6, 5));
    EXPECT_TRUE(testing::passes_on_every_failure(*clip, [](const TimeTree& failing) {
        const TimeStep between{{3, 0}, NodeAddress{3, 1}, 64, false};
        return zoom_step(failing, between, 20, Edge::kPad, {0, 0, 5, 5});
    }));
}

}  // namespace
}  // namespace haarmony::video
