#include "engine/video/pixel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

namespace haarmony::video {
namespace {

Rgba random_pixel(std::mt19937& random) {
    const auto bits = static_cast<std::uint32_t>(random());
    return canonical({static_cast<std::uint8_t>(bits),
                      static_cast<std::uint8_t>(bits >> 8),
                      static_cast<std::uint8_t>(bits >> 16),
                      static_cast<std::uint8_t>(bits >> 24)});
}

TEST(Pixel, AClearOneHasNoColour) {
    EXPECT_EQ(canonical({1, 2, 3, 0}), kClear);
    EXPECT_EQ(canonical({1, 2, 3, 1}), (Rgba{1, 2, 3, 1}));
}

TEST(Mean, OfEqualPixelsIsThePixel) {
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Rgba pixel = random_pixel(random);
        const std::uint64_t samples = 1 + random() % 1'000'000;
        ASSERT_EQ(mean(sum_of(pixel, samples), samples), pixel);
    }
}

// By what rounding means: no other level is nearer, and of two as near the higher is taken.
bool is_nearest(std::uint8_t level, std::uint64_t total, std::uint64_t count) {
    __extension__ using Wide = __int128;
    const Wide twice_off = 2 * (Wide{total} - Wide{level} * count);
    return -static_cast<Wide>(count) <= twice_off && twice_off < Wide{count};
}

TEST(Mean, IsRoundedOnceHalfUp) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20'000; ++i) {
        const std::uint64_t samples = 1 + random() % (1ULL << (1 + random() % 47));
        const std::uint64_t alpha = random() % (255 * samples + 1);
        PixelSum sum{0, 0, 0, alpha};
        for (std::uint64_t* const channel : {&sum.r, &sum.g, &sum.b}) {
            *channel = alpha == 0 ? 0 : random() % (255 * alpha + 1);
        }
        const Rgba pixel = mean(sum, samples);
        ASSERT_TRUE(is_nearest(pixel.a, sum.a, samples)) << sum.a << " of " << samples;
        if (pixel.a == 0) {
            ASSERT_EQ(pixel, kClear);
            continue;
        }
        ASSERT_TRUE(is_nearest(pixel.r, sum.r, sum.a)) << sum.r << " of " << sum.a;
        ASSERT_TRUE(is_nearest(pixel.g, sum.g, sum.a));
        ASSERT_TRUE(is_nearest(pixel.b, sum.b, sum.a));
    }
}

TEST(Mean, OfTheMostSamplesDoesNotOverflow) {
    const std::uint64_t samples = std::uint64_t{1} << 47;
    EXPECT_EQ(mean(sum_of({255, 128, 1, 255}, samples), samples),
              (Rgba{255, 128, 1, 255}));
    EXPECT_EQ(mean({0, 0, 0, samples / 2}, samples), (Rgba{0, 0, 0, 1}));
    EXPECT_EQ(mean({0, 0, 0, samples / 2 - 1}, samples), kClear);
}

// The weighted difference of both pixels laid over a grey background.
double seen_over(double background, Rgba p, Rgba q) {
    const auto over = [background](std::uint8_t channel, std::uint8_t alpha) {
        return channel * (alpha / 255.0) + background * (1 - alpha / 255.0);
    };
    const auto off = [&](std::uint8_t a, std::uint8_t b) {
        return std::abs(over(a, p.a) - over(b, q.a));
    };
    return 0.299 * off(p.r, q.r) + 0.587 * off(p.g, q.g) + 0.114 * off(p.b, q.b);
}

TEST(Difference, IsTheLargestOverAnyBackground) {
    std::mt19937 random(3);
    for (int i = 0; i < 20'000; ++i) {
        const Rgba p = random_pixel(random), q = random_pixel(random);
        const double want = std::max(seen_over(0, p, q), seen_over(255, p, q));
        // The sum of six terms below 255, in doubles.
        ASSERT_NEAR(difference(p, q) / double(kDifferenceOne), want, 1e-9);
        ASSERT_EQ(difference(p, q), difference(q, p));
        for (const double grey : {1.0, 64.0, 127.5, 250.0}) {
            ASSERT_LE(seen_over(grey, p, q), want + 1e-9);
        }
    }
}

TEST(Difference, IsNoneOnlyOfEqualPixels) {
    std::mt19937 random(4);
    for (int i = 0; i < 20'000; ++i) {
        const Rgba p = random_pixel(random);
        Rgba q = p;
        EXPECT_EQ(difference(p, q), 0U);
        const std::array<std::uint8_t*, 4> channels = {&q.r, &q.g, &q.b, &q.a};
        *channels[random() % 4] ^= static_cast<std::uint8_t>(1U << random() % 8);
        q = canonical(q);
        EXPECT_EQ(difference(p, q) == 0, p == q);
    }
}

// The traps of the printed ColorDiff, to which all of these are equal.
TEST(Difference, SeesAlpha) {
    EXPECT_EQ(difference({0, 0, 0, 255}, kClear), 255 * kDifferenceOne);
    EXPECT_GT(difference({255, 255, 255, 128}, {128, 128, 128, 255}), 0U);
    EXPECT_EQ(difference({10, 10, 10, 255}, {11, 11, 11, 255}), kDifferenceOne);
}

}  // namespace
}  // namespace haarmony::video
