#include "engine/video/brick_match.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace haarmony::video {
namespace {

Brick random_brick(std::mt19937& random) {
    Brick brick;
    for (Rgba& pixel : brick) {
        const auto bits = static_cast<std::uint32_t>(random());
        pixel = canonical({static_cast<std::uint8_t>(bits),
                           static_cast<std::uint8_t>(bits >> 8),
                           static_cast<std::uint8_t>(bits >> 16),
                           static_cast<std::uint8_t>(bits >> 24)});
    }
    return brick;
}

TEST(BrickMatch, WithinIsTheLargestDifferenceOfAnyPixel) {
    std::mt19937 random(1);
    for (int round = 0; round < 100; ++round) {
        const Brick a = random_brick(random);
        Brick b = a;
        for (int changes = 0; changes < 3; ++changes) {
            Rgba& pixel = b[random() % b.size()];
            const auto more_alpha = round % 2 == 0 ? random() % 3 : 0;
            pixel = canonical({static_cast<std::uint8_t>(pixel.r + random() % 3),
                               pixel.g,
                               static_cast<std::uint8_t>(pixel.b + random() % 3),
                               static_cast<std::uint8_t>(pixel.a + more_alpha)});
        }
        std::uint32_t largest = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            largest = std::max(largest, difference(a[i], b[i]));
        }
        EXPECT_TRUE(within(a, b, largest));
        if (largest > 0) {
            EXPECT_FALSE(within(a, b, largest - 1));
        }
        EXPECT_EQ(within(a, b, 0), same_bytes(a, b));
    }
}

TEST(BrickMatch, EveryPixelCountsInWithin) {
    const Brick flat{};
    for (std::size_t i = 0; i < flat.size(); ++i) {
        Brick other = flat;
        other[i] = {200, 0, 0, 255};
        EXPECT_FALSE(within(flat, other, kDifferenceOne)) << i;
    }
}

TEST(BrickMatch, EveryByteCountsInTheHash) {
    std::mt19937 random(2);
    const Brick brick = random_brick(random);
    std::set<std::uint64_t> hashes = {hash_of(brick)};
    for (std::size_t i = 0; i < brick.size(); ++i) {
        for (int channel = 0; channel < 4; ++channel) {
            Brick other = brick;
            Rgba& pixel = other[i];
            std::uint8_t* const byte = channel == 0   ? &pixel.r
                                       : channel == 1 ? &pixel.g
                                       : channel == 2 ? &pixel.b
                                                      : &pixel.a;
            *byte = static_cast<std::uint8_t>(*byte + 1);
            hashes.insert(hash_of(other));
        }
    }
    EXPECT_EQ(hashes.size(), 1U + 4 * kBrickPixels);
    const Brick copy = brick;
    EXPECT_EQ(hash_of(copy), hash_of(brick));
}

TEST(BrickMatch, AnEnlargedQuadrantRepeatsItsPixels) {
    std::mt19937 random(3);
    const Brick brick = random_brick(random);
    for (int q = 0; q < 4; ++q) {
        const Brick large = enlarged_quadrant(brick, q);
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 8; ++x) {
                const int u = (q % 2) * 4 + x / 2, v = (q / 2) * 4 + y / 2;
                EXPECT_EQ(large[static_cast<std::size_t>(8 * y + x)],
                          brick[static_cast<std::size_t>(8 * v + u)]);
            }
        }
    }
}

TEST(BrickMatch, APixelIsRepeatedIfAllFourBelowAreIt) {
    std::mt19937 random(5);
    const Brick brick = random_brick(random);
    for (int q = 0; q < 4; ++q) {
        EXPECT_EQ(repeated_pixels(brick, q, enlarged_quadrant(brick, q)), 0xFFFF);
        for (std::size_t i = 0; i < brick.size(); ++i) {
            Brick below = enlarged_quadrant(brick, q);
            below[i].b = static_cast<std::uint8_t>(below[i].b + 1);
            const std::size_t above = i / 16 * 4 + i % 8 / 2;
            EXPECT_EQ(repeated_pixels(brick, q, below), 0xFFFF & ~(1 << above));
        }
    }
}

TEST(BrickMatch, EqualPixelsAreBits) {
    std::mt19937 random(4);
    const Brick a = random_brick(random);
    EXPECT_EQ(equal_pixels(a, a), ~PixelMask{0});
    Brick b = a;
    PixelMask expected = ~PixelMask{0};
    for (std::size_t step = 0; step < 40; ++step) {
        const std::size_t i = 37 * step % 64;
        b[i].g = static_cast<std::uint8_t>(b[i].g + 1);
        expected &= ~(PixelMask{1} << i);
        EXPECT_EQ(equal_pixels(a, b), expected);
    }
}

}  // namespace
}  // namespace haarmony::video
