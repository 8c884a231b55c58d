#include "engine/video/sum_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <vector>

#include "tests/engine/image/each_target.h"

namespace haarmony::video {
namespace {

using image::for_each_target;

Brick random_pixels(std::mt19937& random, bool opaque) {
    Brick pixels;
    for (Rgba& pixel : pixels) {
        const auto bits = static_cast<std::uint32_t>(random());
        pixel = {static_cast<std::uint8_t>(bits),
                 static_cast<std::uint8_t>(bits >> 8),
                 static_cast<std::uint8_t>(bits >> 16),
                 static_cast<std::uint8_t>(opaque ? 255 : bits >> 24)};
    }
    return pixels;
}

PixelSum narrow_at(const NarrowSums& sums, std::size_t i) {
    return {sums[0][i], sums[1][i], sums[2][i], sums[3][i]};
}

TEST(SumKernel, PixelsAreAddedAsThePlainSumsAre) {
    for_each_target([](const char* target) {
        std::mt19937 random(1);
        NarrowSums sums{};
        std::array<PixelSum, kBrickPixels> want{};
        for (const std::uint32_t repeats : {1U, 3U, 1000U, 1U, 31'763U}) {
            const Brick pixels = random_pixels(random, false);
            add_pixels(pixels, repeats, sums);
            for (std::size_t i = 0; i < kBrickPixels; ++i) {
                want[i] += sum_of(pixels[i], repeats);
                ASSERT_EQ(narrow_at(sums, i), want[i]) << target << ", " << repeats;
            }
        }
    });
}

TEST(SumKernel, OpaquePixelsAreAddedAndWidened) {
    for_each_target([](const char* target) {
        std::mt19937 random(2);
        ShortSums sums{};
        Brick white;
        white.fill({255, 255, 255, 255});
        add_opaque(white, 200, sums);
        add_opaque(white, 1, sums);
        const Brick pixels = random_pixels(random, true);
        add_opaque(pixels, 56, sums);
        NarrowSums wider{};
        widen(sums, wider);
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            const Rgba pixel = pixels[i];
            ASSERT_EQ(sums[0][i], 201 * 255 + 56 * pixel.r) << target;
            ASSERT_EQ(sums[1][i], 201 * 255 + 56 * pixel.g) << target;
            ASSERT_EQ(sums[2][i], 201 * 255 + 56 * pixel.b) << target;
            for (std::size_t plane = 0; plane < 3; ++plane) {
                ASSERT_EQ(wider[plane][i], sums[plane][i]) << target;
            }
        }
    });
}

TEST(SumKernel, EachQuadrantIsTheSumsOfFour) {
    for_each_target([](const char* target) {
        std::mt19937 random(3);
        NarrowSums sums;
        for (auto& plane : sums) {
            for (std::uint32_t& sum : plane) {
                sum = static_cast<std::uint32_t>(random()) >> 2;
            }
        }
        NarrowSums above{};
        for (std::size_t q = 0; q < 4; ++q) {
            const std::size_t planes = q == 3 ? 4 : 3;
            const std::size_t corner = q / 2 * 32 + q % 2 * 4;
            const NarrowSums before = above;
            halve(sums, planes, corner, above);
            NarrowSums want = before;
            for (std::size_t plane = 0; plane < planes; ++plane) {
                for (std::size_t y = 0; y < 4; ++y) {
                    for (std::size_t x = 0; x < 4; ++x)
                        want[plane][corner + y * 8 + x] = 0;
                }
                for (std::size_t i = 0; i < kBrickPixels; ++i) {
                    want[plane][corner + i / 16 * 8 + i % 8 / 2] += sums[plane][i];
                }
            }
            ASSERT_EQ(above, want) << target << ", quadrant " << q;
        }
    });
}

// Sums of as many samples, among them the largest, those just below and at half a level, and
// none at all.
NarrowSums sums_of(std::mt19937& random, std::uint32_t samples, bool opaque) {
    NarrowSums sums{};
    for (std::size_t i = 0; i < kBrickPixels; ++i) {
        const auto kind = random() % 4;
        const std::uint32_t most = 255 * samples;
        std::uint32_t alpha = static_cast<std::uint32_t>(random()) % (most + 1);
        if (kind == 0) alpha = most;
        if (kind == 1) alpha = static_cast<std::uint32_t>(random()) % (samples + 1);
        if (i == 0) alpha = 0;
        const std::uint32_t per = opaque ? samples : alpha;
        sums[3][i] = alpha;
        for (std::size_t plane = 0; plane < 3; ++plane) {
            const auto level = static_cast<std::uint32_t>(random() % 255);
            const std::uint32_t near = static_cast<std::uint32_t>(random() % 3) + per / 2;
            const std::uint32_t sum = level * per + (near == 0 ? 0 : near - 1);
            sums[plane][i] = kind == 2 ? 255 * per : std::min(sum, 255 * per);
        }
    }
    return sums;
}

constexpr std::uint32_t kSamples[] = {1,
                                      2,
                                      3,
                                      4,
                                      5,
                                      7,
                                      16,
                                      25,
                                      255,
                                      256,
                                      257,
                                      1000,
                                      4095,
                                      4096,
                                      8191,
                                      12'345,
                                      32'767,
                                      32'768};

TEST(SumKernel, MeansAreRoundedAsThePlainOnesAre) {
    for (const std::uint32_t samples : kSamples) {
        std::mt19937 random(samples);
        const NarrowSums sums = sums_of(random, samples, false);
        for_each_target([&](const char* target) {
            PixelWords means;
            mean_of(sums, samples, means);
            const auto pixels = std::bit_cast<Brick>(means);
            for (std::size_t i = 0; i < kBrickPixels; ++i) {
                ASSERT_EQ(pixels[i], mean(narrow_at(sums, i), samples))
                    << target << ", " << samples << " samples, sum " << i;
            }
        });
    }
}

TEST(SumKernel, MeansOfOpaquePixelsAreRoundedAsThePlainOnesAre) {
    std::vector<std::uint32_t> all(std::begin(kSamples), std::end(kSamples));
    all.insert(all.end(), {65'537, 1'000'003, 4'194'304, 8'388'607, 8'388'608});
    for (const std::uint32_t samples : all) {
        std::mt19937 random(samples);
        const NarrowSums sums = sums_of(random, samples, true);
        for_each_target([&](const char* target) {
            PixelWords means;
            mean_of_opaque(sums, samples, means);
            const auto pixels = std::bit_cast<Brick>(means);
            for (std::size_t i = 0; i < kBrickPixels; ++i) {
                const auto weighed = [&](std::size_t plane) {
                    return std::uint64_t{255} * sums[plane][i];
                };
                const PixelSum sum{
                    weighed(0), weighed(1), weighed(2), std::uint64_t{255} * samples};
                ASSERT_EQ(pixels[i], mean(sum, samples))
                    << target << ", " << samples << " samples, sum " << i;
            }
        });
    }
}

// Every sum of a few frames, and so every way to round.
TEST(SumKernel, MeansOfAFewOpaqueFramesAreRoundedRight) {
    for (const std::uint32_t samples :
         {1U, 2U, 3U, 4U, 5U, 6U, 7U, 12U, 13U, 16U, 100U}) {
        for (std::uint32_t first = 0; first <= 255 * samples; first += kBrickPixels) {
            NarrowSums sums{};
            for (std::uint32_t i = 0; i < kBrickPixels; ++i) {
                sums[0][i] = sums[1][i] = sums[2][i] = std::min(first + i, 255 * samples);
            }
            PixelWords means;
            mean_of_opaque(sums, samples, means);
            const auto pixels = std::bit_cast<Brick>(means);
            for (std::size_t i = 0; i < kBrickPixels; ++i) {
                const std::uint32_t want = (2 * sums[0][i] + samples) / (2 * samples);
                const auto level = static_cast<std::uint8_t>(want);
                ASSERT_EQ(pixels[i], (Rgba{level, level, level, 255}))
                    << sums[0][i] << " of " << samples;
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::video
