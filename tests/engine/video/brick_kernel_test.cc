// Vector loops over bricks, against the same by single pixels.
#include "engine/video/brick_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/engine/image/each_target.h"

namespace haarmony::video {
namespace {

using image::for_each_target;
using Channel = std::uint8_t Rgba::*;
constexpr std::array<Channel, 4> kChannels = {&Rgba::g, &Rgba::r, &Rgba::b, &Rgba::a};

// Bytes of any value, or about `middle`, by at most `most`.
Brick random_brick(std::mt19937& random, int most = 0, int middle = 100) {
    Brick brick;
    for (Rgba& pixel : brick) {
        for (const Channel channel : kChannels) {
            const int value = static_cast<int>(random() % 65'536);
            pixel.*channel = static_cast<std::uint8_t>(
                most == 0 ? value : middle + value % (2 * most + 1) - most);
        }
    }
    return brick;
}

TEST(BrickKernel, DeviationAddsUpMagnitudesModulo256) {
    for_each_target([](const char* target) {
        std::mt19937 random(1);
        for (int i = 0; i < 50; ++i) {
            const Brick a = random_brick(random);
            const Brick b = random_brick(random, i % 3);
            std::uint32_t want = 0;
            for (std::size_t p = 0; p < kBrickPixels; ++p) {
                for (const Channel channel : kChannels) {
                    const int off = std::abs(a[p].*channel - b[p].*channel);
                    want += static_cast<std::uint32_t>(std::min(off, 256 - off));
                }
            }
            EXPECT_EQ(deviation(a, b), want) << target;
        }
    });
}

TEST(BrickKernel, MovingStaysWithinBytes) {
    for_each_target([](const char* target) {
        std::mt19937 random(2);
        for (int i = 0; i < 50; ++i) {
            const Brick base = random_brick(random);
            const Brick to = random_brick(random);
            const Brick from = random_brick(random);
            Brick moved;
            shift(base, to, from, moved);
            for (std::size_t p = 0; p < kBrickPixels; ++p) {
                for (const Channel channel : kChannels) {
                    const int want = base[p].*channel + to[p].*channel - from[p].*channel;
                    ASSERT_EQ(moved[p].*channel, std::clamp(want, 0, 255)) << target;
                }
            }
        }
    });
}

TEST(BrickKernel, SmoothPixelsAreNearTheirWeightedMeans) {
    for_each_target([](const char* target) {
        std::mt19937 random(3);
        const Brick coarse = random_brick(random);
        const auto at = [&](int x, int y, Channel channel) {
            const int u = std::clamp(x, 0, 7);
            const int v = std::clamp(y, 0, 7);
            return static_cast<double>(coarse[v * kBrickSide + u].*channel);
        };
        for (int quadrant = 0; quadrant < 4; ++quadrant) {
            Brick out;
            smooth(coarse, quadrant, out);
            for (int y = 0; y < kBrickSide; ++y) {
                for (int x = 0; x < kBrickSide; ++x) {
                    const int u = quadrant % 2 * 4 + x / 2;
                    const int v = quadrant / 2 * 4 + y / 2;
                    const int beside = x % 2 == 0 ? u - 1 : u + 1;
                    const int next = y % 2 == 0 ? v - 1 : v + 1;
                    for (const Channel channel : kChannels) {
                        const double want =
                            (9 * at(u, v, channel) + 3 * at(beside, v, channel) +
                             3 * at(u, next, channel) + at(beside, next, channel)) /
                            16;
                        // Four roundings upwards: two across, two down.
                        const double off = out[y * kBrickSide + x].*channel - want;
                        ASSERT_GE(off, 0) << target;
                        ASSERT_LE(off, 1.5) << target;
                    }
                }
            }
        }
    });
}

TEST(BrickKernel, EveryTargetSmoothsAlike) {
    std::mt19937 random(4);
    const Brick coarse = random_brick(random);
    std::vector<std::array<Brick, 4>> found;
    for_each_target([&](const char*) {
        std::array<Brick, 4>& all = found.emplace_back();
        for (int quadrant = 0; quadrant < 4; ++quadrant)
            smooth(coarse, quadrant, all[static_cast<std::size_t>(quadrant)]);
    });
    ASSERT_GE(found.size(), 2U);
    for (const auto& all : found) EXPECT_EQ(all, found.front());
}

int class_of(int residual) {
    return residual == 0                    ? 0
           : residual == -1                 ? 1
           : residual >= -2 && residual < 2 ? 2
           : residual >= -4 && residual < 4 ? 3
           : residual >= -8 && residual < 8 ? 4
                                            : 5;
}

// Packs, and compares every row with the residuals from the definition.
Left checked_pack(const Brick& brick, const Brick& predicted, const char* target) {
    PackedRows rows;
    const Left left = pack_residuals(brick, predicted, rows);
    Left want;
    want.follows_green = left.follows_green;
    want.opaque = true;
    std::array<long, 2> sums{};
    for (int plane = 0; plane < kPlanes; ++plane) {
        for (int y = 0; y < kBrickSide; ++y) {
            std::array<int, kBrickSide> residual{};
            int row_class = 0;
            for (int x = 0; x < kBrickSide; ++x) {
                const Rgba is = brick[y * kBrickSide + x];
                const Rgba was = predicted[y * kBrickSide + x];
                if (is.a != 255) want.opaque = false;
                const bool clear = is.a == 0 && plane < 3;
                const Channel channel = kChannels[static_cast<std::size_t>(plane)];
                const int off = is.*channel - was.*channel;
                const int green = plane == 1 || plane == 2 ? is.g - was.g : 0;
                const auto residual_of = [&](bool follows) {
                    return clear ? 0
                                 : static_cast<std::int8_t>(follows ? off - green : off);
                };
                for (const bool follows : {false, true})
                    sums[follows] += std::abs(residual_of(follows));
                residual[x] = residual_of(left.follows_green);
                row_class = std::max(row_class, class_of(residual[x]));
            }
            const auto row = static_cast<std::size_t>(plane * kBrickSide + y);
            EXPECT_EQ(rows.row_class[row], static_cast<std::uint64_t>(row_class))
                << target;
            if (row_class > 0) (plane < 3 ? want.colors : want.alpha) = true;
            const unsigned bits = kRowBytes[static_cast<std::size_t>(row_class)];
            for (unsigned x = 0; x < kBrickSide && bits > 0; ++x) {
                const std::uint64_t got =
                    rows.bytes[row] >> bits * x & ((1U << bits) - 1);
                EXPECT_EQ(got, static_cast<unsigned>(residual[x]) & ((1U << bits) - 1))
                    << target << ", row " << row << ", pixel " << x;
            }
        }
    }
    EXPECT_EQ(left.follows_green, sums[1] < sums[0]) << target;
    EXPECT_EQ(left.opaque, want.opaque) << target;
    EXPECT_EQ(left.colors, want.colors) << target;
    EXPECT_EQ(left.alpha, want.alpha) << target;
    return left;
}

// The planes of rows, as a reader has them.
Residuals residuals_of(const PackedRows& rows) {
    Residuals made{};
    for (std::size_t row = 0; row < kRows; ++row) {
        const unsigned bits = kRowBytes[rows.row_class[row]];
        for (unsigned x = 0; x < kBrickSide && bits > 0; ++x) {
            std::uint64_t value = rows.bytes[row] >> bits * x & ((1U << bits) - 1);
            if ((value >> (bits - 1)) != 0) value |= ~std::uint64_t{0} << bits;
            made[row * kBrickSide + x] = static_cast<std::uint8_t>(value);
        }
    }
    return made;
}

TEST(BrickKernel, WhatIsPackedIsWhatIsLeftAndUnpacksToTheBrick) {
    for_each_target([](const char* target) {
        std::mt19937 random(5);
        int following = 0;
        for (int i = 0; i < 200; ++i) {
            Brick brick = random_brick(random, 1 << i % 8);
            const Brick predicted = random_brick(random, 1 << i / 8 % 8);
            for (Rgba& pixel : brick) {
                if (i % 3 == 0) pixel.a = 255;
                if (i % 5 == 0 && random() % 4 == 0) pixel.a = 0;
                if (i % 2 == 0)
                    pixel.r = static_cast<std::uint8_t>(pixel.g + pixel.r % 3);
                pixel = canonical(pixel);
            }
            const Left left = checked_pack(brick, predicted, target);
            following += left.follows_green ? 1 : 0;
            PackedRows rows;
            (void)pack_residuals(brick, predicted, rows);
            Residuals residuals = residuals_of(rows);
            Brick back;
            add_residuals(residuals, predicted, left.follows_green, false, back);
            ASSERT_EQ(back, brick) << target << ", " << i;
            if (!left.opaque) continue;
            std::fill(residuals.begin() + 3 * kBrickPixels, residuals.end(), 7);
            add_residuals(residuals, predicted, left.follows_green, true, back);
            ASSERT_EQ(back, brick) << target << ", " << i;
        }
        EXPECT_GT(following, 20) << target;
        EXPECT_LT(following, 180) << target;
    });
}

TEST(BrickKernel, RowsAtTheEdgesOfTheirClasses) {
    for_each_target([](const char* target) {
        for (const int off :
             {0, -1, 1, -2, 2, -3, 3, -4, 4, -5, 7, -8, 8, -9, 127, -128}) {
            Brick predicted;
            predicted.fill({128, 128, 128, 255});
            Brick brick = predicted;
            brick[13].g = static_cast<std::uint8_t>(128 + off);
            PackedRows rows;
            const Left left = pack_residuals(brick, predicted, rows);
            EXPECT_EQ(rows.row_class[1], static_cast<std::uint64_t>(class_of(off)))
                << target << ", " << off;
            EXPECT_EQ(left.colors, off != 0) << target;
            checked_pack(brick, predicted, target);
        }
    });
}

TEST(BrickKernel, DamagedResidualsStillGiveCanonicalPixels) {
    for_each_target([](const char* target) {
        std::mt19937 random(6);
        Residuals residuals;
        for (std::uint8_t& byte : residuals) byte = static_cast<std::uint8_t>(random());
        const Brick predicted = random_brick(random);
        for (std::size_t i = 0; i < kBrickPixels; i += 3) {
            residuals[3 * kBrickPixels + i] = static_cast<std::uint8_t>(-predicted[i].a);
        }
        Brick brick;
        add_residuals(residuals, predicted, true, false, brick);
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            EXPECT_EQ(brick[i], canonical(brick[i])) << target;
            if (i % 3 == 0) {
                EXPECT_EQ(brick[i], kClear) << target;
            }
        }
    });
}

}  // namespace
}  // namespace haarmony::video
