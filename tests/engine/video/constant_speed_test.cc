#include "engine/video/constant_speed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace haarmony::video {
namespace {

constexpr QualityOptions kQuality{.fps = 32,
                                  .slowest_fps = 4,
                                  .finest_level = 9,
                                  .coarsest_level = 7,
                                  .budget = 1};

// What a picture of a level costs when one of level 9 costs `finest_s`.
double cost(double finest_s, int level) { return std::ldexp(finest_s, 2 * (level - 9)); }

// `pictures` of a constant cost; returns how often the quality changed.
int run(Quality& quality, double finest_s, int pictures) {
    int changes = 0;
    for (int n = 0; n < pictures; ++n) {
        const int level = quality.space_level();
        const double fps = quality.fps();
        quality.drawn(cost(finest_s, level));
        changes += level != quality.space_level() || fps != quality.fps() ? 1 : 0;
    }
    return changes;
}

TEST(Quality, StaysFullWhileItCanBeAfforded) {
    Quality quality(kQuality);
    EXPECT_EQ(run(quality, 1.0 / 32, 100), 0);
    EXPECT_TRUE(quality.full());
}

TEST(Quality, TheSpaceLevelGivesWayFirst) {
    Quality quality(kQuality);
    EXPECT_EQ(run(quality, 4.0 / 32, 100), 1);
    EXPECT_EQ(quality.space_level(), 8);
    EXPECT_EQ(quality.fps(), 32);
}

TEST(Quality, ThenTheFrameRateIsHalved) {
    Quality quality(kQuality);
    EXPECT_EQ(run(quality, 32.0 / 32, 100), 3);
    EXPECT_EQ(quality.space_level(), 7);
    EXPECT_EQ(quality.fps(), 16);
}

TEST(Quality, HasItsLimits) {
    Quality quality(kQuality);
    EXPECT_EQ(run(quality, 1e6, 100), 5);
    EXPECT_EQ(quality.space_level(), 7);
    EXPECT_EQ(quality.fps(), 4);
}

TEST(Quality, AtAConstantCostItSettles) {
    for (double finest_s = 1e-3; finest_s < 100; finest_s *= 1.07) {
        Quality quality(kQuality);
        run(quality, finest_s, 100);
        EXPECT_EQ(run(quality, finest_s, 1000), 0) << finest_s;
        const bool lowest = quality.space_level() == 7 && quality.fps() == 4;
        EXPECT_TRUE(cost(finest_s, quality.space_level()) <= 1 / quality.fps() || lowest);
    }
}

TEST(Quality, ReturnsToFullWhenCostsFall) {
    Quality quality(kQuality);
    run(quality, 1e6, 100);
    EXPECT_EQ(run(quality, 0.1 / 32, 200), 5);
    EXPECT_TRUE(quality.full());
}

TEST(Quality, TheFrameRateComesBackBeforeTheSpaceLevel) {
    Quality quality(kQuality);
    run(quality, 1e6, 100);
    bool was_finer = false;
    for (int n = 0; n < 200; ++n) {
        quality.drawn(cost(0.1 / 32, quality.space_level()));
        was_finer = was_finer || quality.space_level() > 7;
        EXPECT_TRUE(!was_finer || quality.fps() == 32) << n;
    }
    EXPECT_TRUE(was_finer);
}

TEST(Quality, FollowsAChangingBudget) {
    Quality quality(kQuality);
    run(quality, 0.5 / 32, 20);
    EXPECT_TRUE(quality.full());
    quality.set_budget(0.1);
    run(quality, 0.5 / 32, 50);
    EXPECT_EQ(quality.space_level(), 7);
    quality.set_budget(1);
    run(quality, 0.5 / 32, 100);
    EXPECT_TRUE(quality.full());
}

TEST(Quality, OneSlowPictureChangesNothing) {
    Quality quality(kQuality);
    for (int n = 0; n < 100; ++n) quality.drawn(n % 10 == 9 ? 2.0 / 32 : 0.5 / 32);
    EXPECT_TRUE(quality.full());
}

// A player with a virtual clock: each picture takes what it costs, and the next one begins
// when it is due or, late, at once.
struct Session {
    explicit Session(double speed, std::int64_t frames = 1 << 15)
        : shape(*ClipShape::make({512, 512, {32, 1}}, frames)),
          player(
              shape,
              {.position = speed < 0 ? static_cast<double>(frames) : 0, .speed = speed},
              kQuality,
              0) {}

    // Plays one step; false at the end of the clip.
    bool step(double finest_s) {
        const std::int64_t front = player.playback().front();
        const double target =
            player.playback().position(now + 1 / player.quality().fps());
        const auto next = player.next(now);
        if (!next) return false;
        step_frames =
            std::max({1.0,
                      std::abs(player.playback().speed()) * 32 / player.quality().fps(),
                      std::abs(target - static_cast<double>(front))});
        off = std::abs(target - static_cast<double>(player.playback().front()));
        time_level = next->time.at.time_level;
        const double spent = next->time.repeated ? 0 : cost(finest_s, next->space_level);
        player.drawn(spent);
        now = std::max(next->until_s, now + spent);
        return true;
    }

    ClipShape shape;
    ConstantSpeed player;
    double now = 0;
    double off = 0;
    double step_frames = 0;
    int time_level = 0;
};

TEST(ConstantSpeed, UnderRandomLoadThePositionHoldsWithinAStepAtAllTimes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (const double speed : {1.0, -1.0, 0.3, 2.7, -5.5}) {
        Session session(speed);
        double load = 0.5 / 32;
        for (int n = 0; n < 3000; ++n) {
            if (random() % 50 == 0) load = std::exp2(16 * unit(random) - 10) / 32;
            if (!session.step(load * (0.5 + unit(random)))) break;
            ASSERT_LE(session.off, session.step_frames) << speed << " at " << session.now;
        }
        EXPECT_GT(session.now, 10) << speed;
    }
}

TEST(ConstantSpeed, TakesTheSameTimeUnderAnyLoadThatItCanCarry) {
    for (const double load : {0.1, 3.0, 20.0, 60.0}) {
        Session session(1.0, 1 << 12);
        while (session.step(load / 32)) {
        }
        // 4096 frames at 32 a second, and no more than a step of the slowest rate off.
        EXPECT_NEAR(session.now, 128, 0.5) << load;
    }
}

TEST(ConstantSpeed, AHalvedFrameRateGoesUpOneTimeLevel) {
    Session session(1.0);
    for (int n = 0; n < 20; ++n) session.step(0.1 / 32);
    EXPECT_EQ(session.player.quality().fps(), 32);
    EXPECT_EQ(session.time_level, 15);
    for (int n = 0; n < 200; ++n) session.step(30.0 / 32);
    EXPECT_EQ(session.player.quality().fps(), 16);
    EXPECT_EQ(session.time_level, 14);
    for (int n = 0; n < 200; ++n) session.step(0.1 / 32);
    EXPECT_TRUE(session.player.quality().full());
    EXPECT_EQ(session.time_level, 15);
}

TEST(ConstantSpeed, StepsKeepTheirBeat) {
    Session session(1.0);
    for (int n = 1; n <= 1000; ++n) {
        session.step(0.9 / 32);
        ASSERT_DOUBLE_EQ(session.now, n / 32.0);
    }
}

TEST(ConstantSpeed, RepeatedStepsSayNothingAboutCosts) {
    Session session(0.1);
    // One picture in ten is drawn: its cost counts, not the mean over all steps.
    for (int n = 0; n < 200; ++n) session.step(4.0 / 32);
    EXPECT_EQ(session.player.quality().space_level(), 8);
}

TEST(ConstantSpeed, PassesSpeedAndBudgetOn) {
    Session session(1.0);
    session.step(0.1 / 32);
    session.player.set_speed(2, session.now);
    session.player.set_budget(0);
    for (int n = 0; n < 100; ++n) session.step(0.1 / 32);
    EXPECT_EQ(session.player.playback().speed(), 2);
    EXPECT_EQ(session.player.quality().fps(), 4);
}

}  // namespace
}  // namespace haarmony::video
