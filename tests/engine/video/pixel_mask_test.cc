#include "engine/video/pixel_mask.h"

#include <gtest/gtest.h>

#include <random>

namespace haarmony::video {
namespace {

bool bit(std::uint64_t mask, int x, int y, int side) {
    return (mask >> (side * y + x) & 1) != 0;
}

TEST(PixelMask, QuadrantsAreTakenOutAndPutBack) {
    std::mt19937_64 random(1);
    for (int round = 0; round < 50; ++round) {
        const PixelMask mask = random();
        PixelMask together = 0;
        for (int q = 0; q < 4; ++q) {
            const QuadrantMask quadrant = quadrant_of(mask, q);
            for (int y = 0; y < 4; ++y) {
                for (int x = 0; x < 4; ++x) {
                    EXPECT_EQ(bit(quadrant, x, y, 4),
                              bit(mask, x + 4 * (q % 2), y + 4 * (q / 2), 8));
                }
            }
            together |= in_quadrant(quadrant, q);
        }
        EXPECT_EQ(together, mask);
    }
}

TEST(PixelMask, AParentHasWhatAllFourBelowHave) {
    std::mt19937_64 random(2);
    for (int round = 0; round < 50; ++round) {
        const PixelMask below = random() | random() | random();
        const QuadrantMask above = all_of_four(below);
        for (int y = 0; y < 4; ++y) {
            for (int x = 0; x < 4; ++x) {
                EXPECT_EQ(bit(above, x, y, 4),
                          bit(below, 2 * x, 2 * y, 8) &&
                              bit(below, 2 * x + 1, 2 * y, 8) &&
                              bit(below, 2 * x, 2 * y + 1, 8) &&
                              bit(below, 2 * x + 1, 2 * y + 1, 8));
                EXPECT_EQ(bit(any_of_four(~below), x, y, 4), !bit(above, x, y, 4));
            }
        }
    }
}

TEST(PixelMask, WhatIsAboveIsBelowFourTimes) {
    std::mt19937_64 random(3);
    for (int round = 0; round < 50; ++round) {
        const auto above = static_cast<QuadrantMask>(random());
        const PixelMask below = four_of_each(above);
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 8; ++x) {
                EXPECT_EQ(bit(below, x, y, 8), bit(above, x / 2, y / 2, 4));
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::video
