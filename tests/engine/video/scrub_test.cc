#include "engine/video/scrub.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace haarmony::video {
namespace {

ClipShape shape_of(std::int64_t frames) {
    return *ClipShape::make({4, 4, {25, 1}}, frames);
}

constexpr double kPicture = 1.0 / 60;

TEST(Scrub, ShowsNothingBeforeTheHandIsThere) {
    Scrub scrub(shape_of(16));
    EXPECT_FALSE(scrub.next(1).has_value());
    EXPECT_FALSE(scrub.behind());
}

TEST(Scrub, ASlowHandSeesEverySingleFrame) {
    const ClipShape shape = shape_of(100);
    Scrub scrub(shape);
    std::int64_t frame = 0;
    for (int n = 0; n < 400; ++n) {
        scrub.move(n * 0.25, n * kPicture);
        const auto node = scrub.next(n * kPicture);
        if (!node) continue;
        EXPECT_EQ(*node, (NodeAddress{7, frame}));
        ++frame;
    }
    EXPECT_EQ(frame, 100);
}

TEST(Scrub, TheTimeLevelFollowsTheSpeedOfTheHand) {
    const ClipShape shape = shape_of(1 << 14);
    for (const int speed : {1, 2, 4, 16, 64}) {  // frames in the time of a picture
        Scrub scrub(shape);
        for (int n = 0; n < 200; ++n) {
            scrub.move(n * speed + speed - 1, n * kPicture);
            const auto node = scrub.next(n * kPicture);
            ASSERT_TRUE(node.has_value());
            if (n < 20) continue;  // the way there from the first frame shown
            EXPECT_EQ(shape.frames_of(*node).count(), speed) << n;
        }
    }
}

TEST(Scrub, AFastHandIsNeverMoreThanTwoPicturesAhead) {
    const ClipShape shape = shape_of(1 << 14);
    for (const double speed : {1.7, 3.0, 11.3, 50.0}) {
        Scrub scrub(shape);
        for (int n = 0; n < 200; ++n) {
            const double hand = n * speed;
            scrub.move(hand, n * kPicture);
            const auto node = scrub.next(n * kPicture);
            if (!node) continue;
            EXPECT_LE(hand - static_cast<double>(shape.frames_of(*node).end), 2 * speed)
                << n << " at " << speed;
        }
    }
}

// Any hand: every frame that it moved over is in some picture, and each picture touches the
// one before.
TEST(Scrub, NothingThatTheHandMovesOverIsLeftOut) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int round = 0; round < 200; ++round) {
        const ClipShape shape = shape_of(1 + static_cast<std::int64_t>(random() % 500));
        const auto frames = static_cast<double>(shape.frames());
        Scrub scrub(shape);
        std::vector<bool> shown(static_cast<std::size_t>(shape.frames()));
        double hand = unit(random) * frames, now = 0;
        const auto frame_of = [&](double position) {
            return static_cast<std::size_t>(std::clamp(position, 0.0, frames - 1));
        };
        std::size_t lowest = frame_of(hand), highest = lowest;
        FrameRange last;
        bool first = true;
        const auto look = [&] {
            const auto node = scrub.next(now);
            if (!node) return false;
            const FrameRange range = shape.frames_of(*node);
            EXPECT_TRUE(first || (range.first <= last.end && range.end >= last.first))
                << range.first << " after " << last.first;
            first = false;
            last = range;
            std::fill(shown.begin() + range.first, shown.begin() + range.end, true);
            return true;
        };
        for (int n = 0; n < 100; ++n) {
            scrub.move(hand, now);
            lowest = std::min(lowest, frame_of(hand));
            highest = std::max(highest, frame_of(hand));
            // The hand is asked about more often than there is time for a picture.
            if (random() % 3 == 0) look();
            now += 0.005;
            hand += (unit(random) - 0.5) * (random() % 10 == 0 ? frames : 8);
        }
        now += 1;
        int looks = 0;
        while (look() && looks < 100) ++looks;
        EXPECT_LT(looks, 40);
        EXPECT_FALSE(scrub.behind());
        for (std::size_t i = lowest; i <= highest; ++i) EXPECT_TRUE(shown[i]) << i;
        EXPECT_EQ(last.count(), 1) << "a hand at rest sees a single frame";
    }
}

TEST(Scrub, AWayThereAndBackShowsTheTurningPoint) {
    const ClipShape shape = shape_of(128);
    Scrub scrub(shape);
    scrub.move(10, 0);
    EXPECT_EQ(shape.frames_of(*scrub.next(0)), (FrameRange{10, 11}));
    scrub.move(100, 0.01);
    scrub.move(40, 0.02);
    bool turned = false;
    double now = 0.02;
    FrameRange shown;
    while (scrub.behind()) {
        shown = shape.frames_of(*scrub.next(now));
        turned = turned || shown.end > 100;
        now += kPicture;
    }
    EXPECT_TRUE(turned);
    EXPECT_LE(shown.first, 40);
    EXPECT_GT(shown.end, 40);
}

TEST(Scrub, WhatHasBeenShownOnceIsNotGoneBackTo) {
    const ClipShape shape = shape_of(64);
    Scrub scrub(shape);
    scrub.move(9, 0);
    (void)scrub.next(0);
    scrub.move(10, 0.02);
    EXPECT_EQ(shape.frames_of(*scrub.next(0.02)), (FrameRange{10, 11}));
    EXPECT_FALSE(scrub.behind());
    EXPECT_FALSE(scrub.next(5).has_value());
}

TEST(Scrub, AHandAtRestSeesItsFrameSharply) {
    const ClipShape shape = shape_of(64);
    Scrub scrub(shape, 0.1);
    scrub.move(0, 0);
    (void)scrub.next(0);
    scrub.move(63, 0.01);
    double now = 0.01;
    while (scrub.behind()) (void)scrub.next(now);
    EXPECT_FALSE(scrub.next(0.1).has_value());  // not yet
    EXPECT_EQ(scrub.next(0.12), (NodeAddress{6, 63}));
    EXPECT_FALSE(scrub.next(10).has_value());
}

TEST(Scrub, AHandOutsideTheClipIsAtItsEnd) {
    Scrub scrub(shape_of(5));
    scrub.move(-3, 0);
    EXPECT_EQ(scrub.next(0), (NodeAddress{3, 0}));
    Scrub other(shape_of(5));
    other.move(1e300, 0);
    EXPECT_EQ(other.next(0), (NodeAddress{3, 4}));
}

}  // namespace
}  // namespace haarmony::video
