#include "engine/video/advance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

namespace haarmony::video {
namespace {

constexpr Direction kForwards = Direction::kForwards;
constexpr Direction kBackwards = Direction::kBackwards;

ClipShape shape_of(std::int64_t frames) {
    return *ClipShape::make({4, 4, {25, 1}}, frames);
}

TEST(FurthestNode, GoesAsFarAsOneNodeCanWithinTheLimit) {
    const ClipShape shape = shape_of(16);
    EXPECT_EQ(furthest_node(shape, 0, kForwards, 16), (NodeAddress{0, 0}));
    EXPECT_EQ(furthest_node(shape, 0, kForwards, 15.9), (NodeAddress{1, 0}));
    EXPECT_EQ(furthest_node(shape, 4, kForwards, 7), (NodeAddress{3, 2}));
    EXPECT_EQ(furthest_node(shape, 16, kBackwards, 0), (NodeAddress{0, 0}));
    EXPECT_EQ(furthest_node(shape, 12, kBackwards, 9), (NodeAddress{3, 5}));
}

TEST(FurthestNode, IsTheFinestOfThoseThatGoAsFar) {
    const ClipShape shape = shape_of(16);
    // [6, 8), [4, 8) and [0, 8) all end at 8.
    EXPECT_EQ(furthest_node(shape, 6, kForwards, 9), (NodeAddress{3, 3}));
    // Of a clip that ends early the last nodes all end with it.
    EXPECT_EQ(furthest_node(shape_of(9), 8, kForwards, 9), (NodeAddress{4, 8}));
}

TEST(FurthestNode, OneFrameIsShownEvenBeyondTheLimit) {
    EXPECT_EQ(furthest_node(shape_of(16), 7, kForwards, 7.2), (NodeAddress{4, 7}));
    EXPECT_EQ(furthest_node(shape_of(16), 7, kBackwards, 6.9), (NodeAddress{4, 6}));
}

struct Walk {
    std::set<int> levels;
    double furthest_off = 0;
    bool overlaps = false;
};

// A target that moves by `step` each time, followed from where it starts.
Walk walk(const ClipShape& shape, double start, double step, Direction direction) {
    const double sign = direction == kForwards ? 1 : -1;
    Walk walk;
    auto front = static_cast<std::int64_t>(start);
    const auto rest_of = [&](double target) {
        return direction == kForwards ? static_cast<double>(shape.frames()) - target
                                      : target;
    };
    for (double target = start + sign * step; rest_of(target) > step;
         target += sign * step) {
        if (sign * (target - static_cast<double>(front)) < 0.5) continue;
        const NodeAddress node = steady_node(shape, front, direction, target, step);
        const FrameRange frames = shape.frames_of(node);
        const std::int64_t near = direction == kForwards ? frames.first : frames.end;
        // What is odd at the start is the alignment of the first node.
        if (front != static_cast<std::int64_t>(start) && near != front) {
            walk.overlaps = true;
        }
        EXPECT_TRUE(direction == kForwards ? near <= front : near >= front)
            << "a frame is left out at " << front;
        front = front_of(frames, direction);
        walk.levels.insert(node.time_level);
        walk.furthest_off =
            std::max(walk.furthest_off, std::abs(static_cast<double>(front) - target));
    }
    return walk;
}

TEST(SteadyNode, StaysWithinAStepByTwoAdjacentLevelsWithoutShowingAFrameTwice) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> steps(1, 40);
    for (int round = 0; round < 300; ++round) {
        const double step = round % 3 == 0 ? 1 + steps(random) / 40 : steps(random);
        const ClipShape shape =
            shape_of(2000 + static_cast<std::int64_t>(random() % 900));
        for (const Direction direction : {kForwards, kBackwards}) {
            const double start =
                direction == kForwards ? 0 : static_cast<double>(shape.frames());
            const Walk got = walk(shape, start, step, direction);
            EXPECT_LT(got.furthest_off, step) << step;
            EXPECT_FALSE(got.overlaps) << step;
            ASSERT_FALSE(got.levels.empty());
            ASSERT_LE(got.levels.size(), 2U) << step;
            EXPECT_LE(*got.levels.rbegin() - *got.levels.begin(), 1) << step;
            // The sizes on both sides of the step.
            const int exact = shape.time_levels() - static_cast<int>(std::log2(step));
            EXPECT_TRUE(got.levels.contains(exact) || got.levels.contains(exact - 1));
        }
    }
}

TEST(SteadyNode, APowerOfTwoUsesOneLevel) {
    for (const double step : {1, 2, 8, 64}) {
        const Walk got = walk(shape_of(1 << 12), 0, step, kForwards);
        EXPECT_EQ(got.levels.size(), 1U) << step;
        EXPECT_EQ(got.furthest_off, 0) << step;
    }
}

TEST(SteadyNode, AnyStartIsCaughtUpWith) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> steps(1, 40);
    for (int round = 0; round < 300; ++round) {
        const double step = steps(random);
        const double start = static_cast<double>(1000 + random() % 300);
        for (const Direction direction : {kForwards, kBackwards}) {
            const Walk got = walk(shape_of(3000), start, step, direction);
            EXPECT_LT(got.furthest_off, 2 * step) << start << " by " << step;
            EXPECT_LE(got.levels.size(), 3U);
        }
    }
}

TEST(SteadyNode, AFrontFarBehindCatchesUpWithoutLeavingAnythingOut) {
    const ClipShape shape = shape_of(1024);
    std::int64_t front = 63;
    double target = 63 + 500;
    int steps = 0;
    while (target - static_cast<double>(front) >= 2) {
        const FrameRange frames =
            shape.frames_of(steady_node(shape, front, kForwards, target, 2));
        EXPECT_LE(frames.first, front);
        EXPECT_LE(static_cast<double>(frames.end), target + 1);
        front = frames.end;
        target += 2;
        ++steps;
    }
    EXPECT_LE(steps, 12);  // about one for each doubling
}

TEST(SteadyNode, FasterThanTheClipIsItsRoot) {
    EXPECT_EQ(steady_node(shape_of(13), 0, kForwards, 1000, 1000), (NodeAddress{0, 0}));
    EXPECT_EQ(steady_node(shape_of(13), 13, kBackwards, -987, 1000), (NodeAddress{0, 0}));
}

}  // namespace
}  // namespace haarmony::video
