#include "ingest/gallery/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ingest/gallery/random.h"

namespace haarmony::gallery {
namespace {

TEST(Noise, IsZeroAtLatticePoints) {
    for (int y = -5; y <= 5; ++y)
        for (int x = -5; x <= 5; ++x) EXPECT_EQ(noise(x, y, 7), 0) << x << ", " << y;
}

TEST(Noise, IsContinuousAcrossLatticeLines) {
    Random random(5);
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 2000; ++i) {
        const int line = random.below(40) - 20;
        const double along = random.between(-20, 20);
        EXPECT_NEAR(noise(line - kStep, along, 9), noise(line + kStep, along, 9), 1e-5);
        EXPECT_NEAR(noise(along, line - kStep, 9), noise(along, line + kStep, 9), 1e-5);
    }
}

TEST(Noise, StaysInItsRangeAndUsesIt) {
    double low = 1;
    double high = -1;
    Random random(6);
    for (int i = 0; i < 100'000; ++i) {
        const double value = noise(random.between(-99, 99), random.between(-99, 99), 3);
        low = std::min(low, value);
        high = std::max(high, value);
    }
    EXPECT_GE(low, -1.001);
    EXPECT_LE(high, 1.001);
    EXPECT_LT(low, -0.8);
    EXPECT_GT(high, 0.8);
}

TEST(Noise, AnotherSeedIsAnotherField) {
    // Off the lattice, where every field is zero.
    double difference = 0;
    for (int i = 0; i < 1000; ++i) {
        const double x = i * 0.37 + 0.013;
        difference += std::fabs(noise(x, 0.41, 1) - noise(x, 0.41, 2)) / 1000;
    }
    EXPECT_GT(difference, 0.2);
}

TEST(Noise, RidgedStaysBetweenZeroAndOne) {
    Random random(8);
    for (int i = 0; i < 20'000; ++i) {
        const double value =
            ridged(random.between(-50, 50), random.between(-50, 50), 5, 4);
        ASSERT_GE(value, 0);
        ASSERT_LE(value, 1);
    }
}

// Every feature point of a wide neighbourhood, not only of the nine nearest cells.
Cell slow_cell(double x, double y, std::uint32_t seed) {
    Cell found{std::numeric_limits<double>::max(), std::numeric_limits<double>::max(), 0};
    const int ix = static_cast<int>(std::floor(x));
    const int iy = static_cast<int>(std::floor(y));
    for (int j = iy - 4; j <= iy + 4; ++j) {
        for (int i = ix - 4; i <= ix + 4; ++i) {
            const std::uint32_t id = lattice_hash(i, j, seed);
            const double distance =
                std::hypot(i + (id & 0xFFFF) / 65536.0 - x, j + (id >> 16) / 65536.0 - y);
            if (distance < found.nearest) {
                found = {distance, found.nearest, id};
            } else if (distance < found.second) {
                found.second = distance;
            }
        }
    }
    return found;
}

TEST(Noise, CellFindsTheNearestOfAllPoints) {
    Random random(10);
    for (int i = 0; i < 5000; ++i) {
        const double x = random.between(-30, 30);
        const double y = random.between(-30, 30);
        const Cell fast = cell(x, y, 11);
        const Cell slow = slow_cell(x, y, 11);
        // A point farther than one cell away may hide behind the nine.
        if (slow.nearest < 1) {
            EXPECT_EQ(fast.id, slow.id) << x << ", " << y;
            EXPECT_NEAR(fast.nearest, slow.nearest, 1e-12);
        }
        if (slow.second < 1) {
            EXPECT_NEAR(fast.second, slow.second, 1e-12);
        }
    }
}

}  // namespace
}  // namespace haarmony::gallery
