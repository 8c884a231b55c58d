#include "engine/video/bricks.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace haarmony::video {
namespace {

Brick random_brick(std::mt19937& random, bool opaque) {
    Brick brick;
    for (Rgba& pixel : brick) {
        const auto bits = static_cast<std::uint32_t>(random());
        pixel = {static_cast<std::uint8_t>(bits),
                 static_cast<std::uint8_t>(bits >> 8),
                 static_cast<std::uint8_t>(bits >> 16),
                 static_cast<std::uint8_t>(opaque ? 255 : bits >> 24 & 0x7F)};
    }
    return brick;
}

// Long runs of either kind and of both.
std::vector<Brick> mixed_bricks(std::mt19937& random) {
    std::vector<Brick> bricks;
    for (const unsigned opaque_of_four : {4U, 0U, 3U, 4U, 1U, 2U}) {
        for (int i = 0; i < 100; ++i)
            bricks.push_back(random_brick(random, random() % 4 < opaque_of_four));
    }
    return bricks;
}

TEST(Bricks, AreGivenBackAsTheyCame) {
    std::mt19937 random(1);
    const std::vector<Brick> plain = mixed_bricks(random);
    Bricks bricks;
    for (std::size_t n = 0; n < plain.size(); ++n) {
        bricks.push_back(plain[n]);
        ASSERT_EQ(bricks.size(), n + 1);
        ASSERT_EQ(bricks[n], plain[n]) << n;
    }
    for (std::size_t i = 0; i < plain.size(); ++i) {
        Brick brick;
        bricks.get(i, brick);
        ASSERT_EQ(brick, plain[i]) << i;
        ASSERT_TRUE(bricks.equals(i, plain[i])) << i;
        ASSERT_FALSE(bricks.equals(i, plain[(i + 1) % plain.size()])) << i;
    }
}

TEST(Bricks, OpaqueOnesTakeThreeBytesAPixel) {
    std::mt19937 random(2);
    Bricks bricks;
    for (int i = 0; i < 1000; ++i) bricks.push_back(random_brick(random, true));
    EXPECT_EQ(bricks.memory_bytes(), 1000U * 3 * kBrickPixels);
}

TEST(Bricks, AlphaTakesAByteAPixelWhereThereIsSome) {
    std::mt19937 random(3);
    Bricks bricks;
    std::size_t with_alpha = 0;
    for (int i = 0; i < 320; ++i) {
        const bool opaque = random() % 3 != 0;
        bricks.push_back(random_brick(random, opaque));
        with_alpha += opaque ? 0 : 1;
    }
    bricks.push_back(random_brick(random, false));
    // Eleven times 8 bytes say which of 32 have it.
    EXPECT_EQ(bricks.memory_bytes(),
              321 * 3 * kBrickPixels + (with_alpha + 1) * kBrickPixels + 11 * 8);
}

TEST(Bricks, AreEqualWhereTheirBricksAre) {
    std::mt19937 random(4);
    const std::vector<Brick> plain = mixed_bricks(random);
    Bricks a, b, shorter;
    a.reserve(plain.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        a.push_back(plain[i]);
        b.push_back(plain[i]);
        if (i + 1 < plain.size()) shorter.push_back(plain[i]);
    }
    EXPECT_EQ(a, b);
    EXPECT_NE(a, shorter);
    for (const std::size_t changed : {0U, 150U, 599U}) {
        Bricks other;
        for (std::size_t i = 0; i < plain.size(); ++i) {
            Brick brick = plain[i];
            if (i == changed) brick[63].a ^= 1;
            other.push_back(brick);
        }
        EXPECT_NE(a, other) << changed;
    }
}

TEST(Bricks, AreForgottenWhenCleared) {
    std::mt19937 random(5);
    const std::vector<Brick> plain = mixed_bricks(random);
    Bricks bricks;
    for (const Brick& brick : plain) bricks.push_back(brick);
    bricks.clear();
    EXPECT_TRUE(bricks.empty());
    EXPECT_EQ(bricks.memory_bytes(), 0U);
    bricks.push_back(plain[0]);
    bricks.shrink_to_fit();
    EXPECT_EQ(bricks[0], plain[0]);
    Bricks fresh;
    fresh.push_back(plain[0]);
    EXPECT_EQ(bricks, fresh);
}

}  // namespace
}  // namespace haarmony::video
