#include "engine/video/brick_packing.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <vector>

#include "tests/engine/image/each_target.h"

namespace haarmony::video {
namespace {

using image::for_each_target;

enum class Look { kOpaque, kClear, kMixed, kNearlyOpaque };
constexpr std::array<Look, 4> kLooks = {Look::kOpaque,
                                        Look::kClear,
                                        Look::kMixed,
                                        Look::kNearlyOpaque};

Brick brick_of(Look look, std::mt19937& random) {
    Brick brick;
    for (Rgba& pixel : brick) {
        const auto bits = static_cast<std::uint32_t>(random());
        const auto alpha = static_cast<std::uint8_t>(look == Look::kClear   ? 0
                                                     : look == Look::kMixed ? bits >> 24
                                                                            : 255);
        pixel = {static_cast<std::uint8_t>(bits),
                 static_cast<std::uint8_t>(bits >> 8),
                 static_cast<std::uint8_t>(bits >> 16),
                 alpha};
    }
    if (look == Look::kNearlyOpaque) brick[random() % kBrickPixels].a = 254;
    return brick;
}

// Each part alone in its memory, so that a sanitizer sees what is read around it.
struct Held {
    std::unique_ptr<BrickColors> colors = std::make_unique<BrickColors>();
    std::unique_ptr<BrickAlphas> alphas = std::make_unique<BrickAlphas>();
    bool opaque;

    explicit Held(const Brick& brick) : opaque(pack(brick, *colors, *alphas)) {}
    [[nodiscard]] PackedBrick packed() const {
        return {colors.get(), opaque ? nullptr : alphas.get()};
    }
};

TEST(BrickPacking, ColorsAndAlphasStandOneAfterTheOther) {
    for_each_target([](const char* target) {
        std::mt19937 random(1);
        for (const Look look : kLooks) {
            const Brick brick = brick_of(look, random);
            const Held held(brick);
            ASSERT_EQ(held.opaque, look == Look::kOpaque) << target;
            for (std::size_t i = 0; i < brick.size(); ++i) {
                ASSERT_EQ(held.colors->byte[3 * i], brick[i].r) << target << ", " << i;
                ASSERT_EQ(held.colors->byte[3 * i + 1], brick[i].g) << target;
                ASSERT_EQ(held.colors->byte[3 * i + 2], brick[i].b) << target;
                if (!held.opaque) {
                    ASSERT_EQ(held.alphas->byte[i], brick[i].a);
                }
            }
        }
    });
}

TEST(BrickPacking, EachPixelThatIsNotOpaqueIsSeen) {
    for_each_target([](const char* target) {
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            Brick brick;
            brick.fill({1, 2, 3, 255});
            brick[i].a = 127;
            EXPECT_FALSE(Held(brick).opaque) << target << ", " << i;
        }
    });
}

TEST(BrickPacking, BricksArePutAsTheyWereAndNothingBesideThem) {
    constexpr std::ptrdiff_t kStride = 37;
    static constexpr Rgba kPaper{9, 8, 7, 6};
    for_each_target([](const char* target) {
        std::mt19937 random(2);
        for (const Look look : kLooks) {
            const std::vector<Brick> bricks = {brick_of(look, random),
                                               brick_of(Look::kOpaque, random),
                                               brick_of(Look::kMixed, random)};
            std::vector<Rgba> paper(12 * kStride, kPaper);
            std::vector<Rgba> want = paper;
            std::vector<Held> held;
            for (const Brick& brick : bricks) held.emplace_back(brick);
            std::vector<BrickPut> puts;
            for (std::size_t b = 0; b < bricks.size(); ++b) {
                const std::size_t first = (2 + b) * kStride + 11 * b + 1;
                puts.push_back({held[b].packed(), &paper[first]});
                for (std::size_t i = 0; i < kBrickPixels; ++i)
                    want[first + i / 8 * kStride + i % 8] = bricks[b][i];
            }
            put_bricks(puts, kStride);
            ASSERT_EQ(paper, want) << target << ", " << static_cast<int>(look);
        }
    });
}

TEST(BrickPacking, UnpackedIsWhatWasPacked) {
    for_each_target([](const char* target) {
        std::mt19937 random(3);
        for (const Look look : kLooks) {
            const Brick brick = brick_of(look, random);
            Brick back;
            unpack(Held(brick).packed(), back);
            EXPECT_EQ(back, brick) << target << ", " << static_cast<int>(look);
        }
    });
}

TEST(BrickPacking, EachQuadrantIsPutTwiceAsLarge) {
    constexpr std::ptrdiff_t kStride = 11;
    for_each_target([](const char* target) {
        std::mt19937 random(4);
        for (const Look look : kLooks) {
            const Brick brick = brick_of(look, random);
            const Held held(brick);
            for (int q = 0; q < 4; ++q) {
                std::vector<Rgba> paper(8 * kStride);
                std::vector<Rgba> want = paper;
                put_doubled(held.packed(), q, paper.data(), kStride);
                for (std::size_t y = 0; y < 8; ++y) {
                    for (std::size_t x = 0; x < 8; ++x) {
                        const std::size_t row = y / 2 + (q >= 2 ? 4 : 0);
                        const std::size_t column = x / 2 + (q % 2 == 1 ? 4 : 0);
                        want[y * kStride + x] = brick[8 * row + column];
                    }
                }
                ASSERT_EQ(paper, want) << target << ", " << q;
            }
        }
    });
}

// A brick with one channel of one pixel changed, for every one of them.
template <typename Check>
void for_each_change(const Brick& brick, Check check) {
    for (std::size_t i = 0; i < kBrickPixels; ++i) {
        for (std::uint8_t Rgba::*channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a}) {
            Brick other = brick;
            other[i].*channel = static_cast<std::uint8_t>(other[i].*channel ^ 0x81);
            check(other, i);
        }
    }
}

TEST(BrickPacking, OneByteThatDiffersIsEnough) {
    for_each_target([](const char* target) {
        std::mt19937 random(5);
        for (const Look look : kLooks) {
            const Brick brick = brick_of(look, random);
            const Held held(brick);
            EXPECT_TRUE(same_pixels(held.packed(), brick)) << target;
            EXPECT_TRUE(same_pixels(held.packed(), Held(brick).packed())) << target;
            for_each_change(brick, [&](const Brick& other, std::size_t i) {
                const Held changed(other);
                EXPECT_FALSE(same_pixels(held.packed(), other)) << target << ", " << i;
                EXPECT_FALSE(same_pixels(held.packed(), changed.packed())) << i;
            });
        }
    });
}

TEST(BrickPacking, AQuadrantIsTheSameWhateverTheOthersAre) {
    std::mt19937 random(6);
    for (const Look look : kLooks) {
        const Brick brick = brick_of(look, random);
        const Held held(brick);
        for_each_change(brick, [&](const Brick& other, std::size_t i) {
            const Held changed(other);
            const int quadrant = (i % 8 >= 4 ? 1 : 0) + (i >= 32 ? 2 : 0);
            for (int q = 0; q < 4; ++q) {
                EXPECT_EQ(same_quadrant(held.packed(), changed.packed(), q),
                          q != quadrant)
                    << i;
            }
        });
    }
}

}  // namespace
}  // namespace haarmony::video
