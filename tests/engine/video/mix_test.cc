#include "engine/video/mix.h"

#include <gtest/gtest.h>

#include <random>

namespace haarmony::video {
namespace {

Rgba random_pixel(std::mt19937& random) {
    const auto bits = static_cast<std::uint32_t>(random());
    const auto kind = random() % 3;
    return canonical({static_cast<std::uint8_t>(bits),
                      static_cast<std::uint8_t>(bits >> 8),
                      static_cast<std::uint8_t>(bits >> 16),
                      static_cast<std::uint8_t>(kind == 0   ? 255
                                                : kind == 1 ? bits >> 24
                                                            : 0)});
}

TEST(Mix, TwoPixelsAreTheMeanOfAsManySamples) {
    std::mt19937 random(1);
    for (int round = 0; round < 20000; ++round) {
        const int bits = 1 + static_cast<int>(random() % 16);
        const std::uint32_t whole = 1U << bits;
        const std::uint32_t weight = static_cast<std::uint32_t>(random()) % (whole + 1);
        const Rgba p = random_pixel(random), q = random_pixel(random);
        PixelSum sum = sum_of(p, weight);
        sum += sum_of(q, whole - weight);
        ASSERT_EQ(mixed(p, q, weight, bits), mean(sum, whole)) << weight << "/" << whole;
    }
}

TEST(Mix, AWholeWeightIsTheFirstAndNoneTheSecond) {
    const Rgba p{10, 20, 30, 40}, q{50, 60, 70, 255};
    EXPECT_EQ(mixed(p, q, 256, 8), p);
    EXPECT_EQ(mixed(p, q, 0, 8), q);
}

TEST(Mix, FourPixelsAreTheMeanOfAsManySamples) {
    std::mt19937 random(2);
    const std::uint64_t one = std::uint64_t{1} << kWayBits;
    for (int round = 0; round < 20000; ++round) {
        std::array<Rgba, 4> pixels;
        for (Rgba& pixel : pixels) pixel = random_pixel(random);
        if (round % 4 == 0) {
            for (Rgba& pixel : pixels) pixel.a = 255;
        }
        const auto u = static_cast<std::uint32_t>(random() % (one + 1));
        const auto v = static_cast<std::uint32_t>(random() % (one + 1));
        PixelSum sum;
        for (std::size_t i = 0; i < 4; ++i) {
            sum += sum_of(pixels[i],
                          (i % 2 == 0 ? u : one - u) * (i / 2 == 0 ? v : one - v));
        }
        ASSERT_EQ(mixed(pixels, u, v), mean(sum, one * one)) << u << "," << v;
    }
}

TEST(Mix, PicturesAreMixedPixelByPixel) {
    Picture first(2, 1), second(2, 1);
    first.at(1, 0) = {200, 0, 0, 255};
    second.at(0, 0) = {0, 100, 0, 255};
    const Picture half = mixed(first, second, 128, 8);
    EXPECT_EQ(half.at(0, 0), (Rgba{0, 100, 0, 128}));
    EXPECT_EQ(half.at(1, 0), (Rgba{200, 0, 0, 128}));
}

}  // namespace
}  // namespace haarmony::video
