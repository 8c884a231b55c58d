// Bricks against their neighbours, there and back.
#include "engine/video/brick_coder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace haarmony::video {
namespace {

enum class Look { kFlat, kSmooth, kNoise, kHoles, kClear };

Brick brick_of(Look look, std::mt19937& random) {
    const auto byte = [&random] { return static_cast<std::uint8_t>(random()); };
    const Rgba color{byte(), byte(), byte(), 255};
    Brick brick;
    for (int i = 0; i < kBrickPixels; ++i) {
        Rgba pixel = color;
        if (look == Look::kSmooth) {
            pixel.r = static_cast<std::uint8_t>(40 + 3 * (i % 8) + random() % 2);
            pixel.g = static_cast<std::uint8_t>(90 + 2 * (i / 8) + random() % 2);
        }
        if (look == Look::kNoise) pixel = {byte(), byte(), byte(), 255};
        if (look == Look::kHoles)
            pixel = {byte(),
                     byte(),
                     byte(),
                     static_cast<std::uint8_t>(i % 5 < 2 ? 0 : byte())};
        if (look == Look::kClear) pixel = kClear;
        brick[static_cast<std::size_t>(i)] = canonical(pixel);
    }
    return brick;
}

// The same brick, a little different.
Brick near(const Brick& brick, std::mt19937& random) {
    Brick made = brick;
    for (Rgba& pixel : made) {
        if (pixel.a == 0) continue;
        const int moved = pixel.g + static_cast<int>(random() % 3) - 1;
        pixel.g = static_cast<std::uint8_t>(std::clamp(moved, 0, 255));
    }
    return made;
}

struct Case {
    Brick brick;
    std::array<Brick, 5> around;  // parent, first, coarse, parent_coarse, other_edge
    unsigned present;
    int quadrant;

    [[nodiscard]] BrickNeighbors neighbors() const {
        const auto one = [this](unsigned i) {
            return (present >> i & 1) != 0 ? &around[i] : nullptr;
        };
        return {.parent = one(0),
                .first = one(1),
                .coarse = one(2),
                .parent_coarse = one(3),
                .other_edge = one(4),
                .quadrant = quadrant,
                .before = nullptr};
    }
};

std::vector<std::byte> coded(const std::vector<Case>& cases) {
    BrickEncoder encoder;
    for (const Case& one : cases) encoder.put(one.brick, one.neighbors());
    std::vector<std::byte> bytes;
    encoder.finish(bytes);
    return bytes;
}

// Decodes, compares, and says which modes there were.
std::set<std::uint8_t> expect_back(const std::vector<Case>& cases) {
    const std::vector<std::byte> bytes = coded(cases);
    StreamReader streams(bytes);
    Result<BrickDecoder> decoder = BrickDecoder::open(streams, cases.size());
    EXPECT_TRUE(decoder.has_value());
    std::set<std::uint8_t> modes;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const std::uint8_t symbol = (*decoder).next_symbol();
        EXPECT_TRUE(is_mode(symbol)) << i;
        modes.insert(symbol);
        Brick decoded;
        const Result<void> done = (*decoder).next(symbol, cases[i].neighbors(), decoded);
        EXPECT_TRUE(done.has_value()) << i;
        EXPECT_EQ(decoded, cases[i].brick) << i;
    }
    EXPECT_TRUE((*decoder).at_end());
    EXPECT_TRUE(streams.at_end());
    return modes;
}

TEST(BrickCoder, EveryBrickComesBackWhateverIsAroundIt) {
    std::mt19937 random(11);
    std::vector<Case> cases;
    for (int i = 0; i < 2000; ++i) {
        Case one;
        const auto look = [&random] { return static_cast<Look>(random() % 5); };
        one.brick = brick_of(look(), random);
        for (Brick& brick : one.around)
            brick =
                random() % 2 == 0 ? near(one.brick, random) : brick_of(look(), random);
        one.present = static_cast<unsigned>(random() % 32);
        one.quadrant = static_cast<int>(random() % 4);
        cases.push_back(one);
    }
    std::set<int> references;
    std::set<int> alphas;
    std::set<bool> follows;
    std::set<bool> exact;
    for (const std::uint8_t symbol : expect_back(cases)) {
        const BrickMode mode = mode_of(symbol);
        references.insert(static_cast<int>(mode.reference));
        alphas.insert(static_cast<int>(mode.alpha));
        follows.insert(mode.follows_green);
        exact.insert(mode.exact);
    }
    EXPECT_EQ(references.size(), static_cast<std::size_t>(kReferences));
    EXPECT_EQ(alphas.size(), static_cast<std::size_t>(kAlphaModes));
    EXPECT_EQ(follows.size(), 2U);
    EXPECT_EQ(exact.size(), 2U);
}

// The mode that a writer takes.
BrickMode chosen(const Case& one) {
    const std::set<std::uint8_t> modes = expect_back({one});
    return mode_of(*modes.begin());
}

// One case fifty times, by turns with a clear brick that costs nothing: what a reference is
// worth.
std::size_t bytes_of(const Case& one) {
    std::vector<Case> cases;
    const Case clear{Brick{}, {}, 1, 0};
    for (int i = 0; i < 50; ++i) {
        cases.push_back(clear);
        cases.push_back(one);
    }
    return coded(cases).size();
}

TEST(BrickCoder, ABrickThatIsShownAlreadyCostsNothing) {
    std::mt19937 random(12);
    for (const unsigned reference : {0U, 4U}) {
        Case one{brick_of(Look::kHoles, random), {}, 1U << reference, 0};
        one.around[reference] = one.brick;
        EXPECT_TRUE(chosen(one).exact);
        const std::size_t bytes = bytes_of(one);
        one.present = 0;
        EXPECT_FALSE(chosen(one).exact);
        EXPECT_LT(bytes, 60U) << reference;
        EXPECT_GT(coded({one}).size(), 64U) << reference;
    }
}

TEST(BrickCoder, AMeanAndOneHalfTellTheOther) {
    std::mt19937 random(13);
    Case one{brick_of(Look::kNoise, random), {}, 0b11, 0};
    one.around[1] = brick_of(Look::kNoise, random);
    for (std::size_t i = 0; i < kBrickPixels; ++i) {
        const auto half = [&](std::uint8_t Rgba::*channel) {
            return static_cast<std::uint8_t>(
                (one.brick[i].*channel + one.around[1][i].*channel + 1) / 2);
        };
        one.around[0][i] = {half(&Rgba::r), half(&Rgba::g), half(&Rgba::b), 255};
    }
    EXPECT_EQ(chosen(one).reference, Reference::kMirror);
    // About a bit a sample: the mean's rounding.
    EXPECT_LT(bytes_of(one), 50 * 64 * 3 / 8 * 5 / 4U);
}

TEST(BrickCoder, ASmoothBrickFollowsTheCoarseOne) {
    Case one{{}, {}, 0b100, 3};
    for (int i = 0; i < kBrickPixels; ++i) {
        const auto slope = [&](int x, int y) {
            return Rgba{static_cast<std::uint8_t>(20 + 4 * x),
                        static_cast<std::uint8_t>(200 - 3 * y),
                        static_cast<std::uint8_t>(60 + x + 2 * y),
                        255};
        };
        one.brick[i] = slope(8 + i % 8, 8 + i / 8);
        one.around[2][i] = slope(2 * (i % 8), 2 * (i / 8));
    }
    EXPECT_EQ(chosen(one).reference, Reference::kCoarse);
}

TEST(BrickCoder, WhatMovesTheCoarseBrickMovesTheTimeParent) {
    std::mt19937 random(15);
    Case one{brick_of(Look::kNoise, random), {}, 0b1101, 1};
    for (Rgba& pixel : one.brick) pixel.g = static_cast<std::uint8_t>(pixel.g / 2 + 90);
    one.around[0] = one.brick;
    for (Rgba& pixel : one.around[0]) pixel.g = static_cast<std::uint8_t>(pixel.g - 17);
    one.around[2].fill({90, 117, 90, 255});
    one.around[3].fill({90, 100, 90, 255});
    const BrickMode mode = chosen(one);
    EXPECT_EQ(mode.reference, Reference::kParentCoarse);
    EXPECT_TRUE(mode.exact);
}

TEST(BrickCoder, GreyResidualsAreToldOnce) {
    std::mt19937 random(16);
    Case one{brick_of(Look::kFlat, random), {}, 1, 0};
    one.brick.fill({100, 110, 120, 255});
    one.around[0] = one.brick;
    for (Rgba& pixel : one.brick) {
        const int lighter = static_cast<int>(random() % 40);
        pixel.r = static_cast<std::uint8_t>(pixel.r + lighter);
        pixel.g = static_cast<std::uint8_t>(pixel.g + lighter);
        pixel.b = static_cast<std::uint8_t>(pixel.b + lighter);
    }
    EXPECT_TRUE(chosen(one).follows_green);
    Case green = one;
    for (std::size_t i = 0; i < kBrickPixels; ++i) {
        green.brick[i].r = green.around[0][i].r;
        green.brick[i].b = green.around[0][i].b;
    }
    EXPECT_FALSE(chosen(green).follows_green);
    EXPECT_LT(bytes_of(one), bytes_of(green) + 100);
}

TEST(BrickCoder, WithoutAnyReferenceTheBrickBeforeIsOne) {
    std::mt19937 random(17);
    const Case one{brick_of(Look::kHoles, random), {}, 0, 0};
    EXPECT_EQ(chosen(one).reference, Reference::kBefore);
    EXPECT_LT(coded(std::vector<Case>(1000, one)).size(), coded({one}).size() + 40);
}

TEST(BrickCoder, ModesThatABrickCannotHaveAreRefused) {
    BrickEncoder encoder;
    const Case one{Brick{}, {}, 0, 0};
    encoder.put(one.brick, {});
    std::vector<std::byte> bytes;
    encoder.finish(bytes);
    for (int symbol = 0; symbol < 256; ++symbol) {
        StreamReader streams(bytes);
        Result<BrickDecoder> decoder = BrickDecoder::open(streams, 1);
        ASSERT_TRUE(decoder.has_value());
        Brick brick;
        const Result<void> done =
            (*decoder).next(static_cast<std::uint8_t>(symbol), {}, brick);
        const bool alone =
            is_mode(symbol) && mode_of(symbol).reference == Reference::kBefore;
        EXPECT_EQ(done.has_value(), alone) << symbol;
        if (!done) {
            EXPECT_EQ(done.error().message, "mode " + std::to_string(symbol));
        }
    }
}

TEST(BrickCoder, ModesAreTheirSymbols) {
    for (int symbol = 0; symbol < kModeSymbols; ++symbol)
        EXPECT_EQ(mode_of(symbol).symbol(), symbol);
}

}  // namespace
}  // namespace haarmony::video
