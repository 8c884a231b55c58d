// Bricks against their neighbours, there and back.
#include "engine/video/brick_coder.h"

#include <gtest/gtest.h>

#include <random>

#include "engine/video/brick_prediction.h"

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
        pixel.g = static_cast<std::uint8_t>(
            clamped(pixel.g + static_cast<int>(random() % 3) - 1));
    }
    return made;
}

struct Case {
    Brick brick;
    std::array<Brick, 7> around;
    unsigned present;
    int quadrant;

    [[nodiscard]] BrickNeighbors neighbors() const {
        const auto one = [this](unsigned i) {
            return (present >> i & 1) != 0 ? &around[i] : nullptr;
        };
        return {one(0), one(1), one(2), one(3), one(4), one(5), one(6), quadrant};
    }
};

std::vector<std::byte> coded(const std::vector<Case>& cases) {
    SymbolWriter symbols;
    SymbolCosts costs = first_costs();
    BrickEncoder encoder(symbols, costs);
    for (const Case& one : cases) encoder.put(one.brick, one.neighbors());
    std::vector<std::byte> bytes;
    symbols.finish(bytes, costs);
    return bytes;
}

TEST(BrickCoder, EveryBrickComesBackWhateverIsAroundIt) {
    std::mt19937 random(11);
    std::vector<Case> cases;
    for (int i = 0; i < 600; ++i) {
        Case one;
        const auto look = [&random] { return static_cast<Look>(random() % 5); };
        one.brick = brick_of(look(), random);
        for (Brick& brick : one.around)
            brick =
                random() % 2 == 0 ? near(one.brick, random) : brick_of(look(), random);
        one.present = static_cast<unsigned>(random() % 128);
        one.quadrant = static_cast<int>(random() % 4);
        cases.push_back(one);
    }
    const std::vector<std::byte> bytes = coded(cases);
    Result<SymbolReader> reader = SymbolReader::open(bytes);
    ASSERT_TRUE(reader.has_value());
    BrickDecoder decoder((*reader).cursor());
    for (std::size_t i = 0; i < cases.size(); ++i) {
        Brick decoded;
        ASSERT_TRUE(decoder.next(decoded, cases[i].neighbors()).has_value()) << i;
        ASSERT_EQ(decoded, cases[i].brick) << i;
    }
    EXPECT_TRUE((*reader).at_end());
}

// One case a hundred times: what a reference is worth.
std::size_t bytes_of(Case one) { return coded(std::vector<Case>(100, one)).size(); }

TEST(BrickCoder, ABrickThatIsShownAlreadyCostsNothing) {
    std::mt19937 random(12);
    for (const unsigned reference : {0U, 4U}) {
        Case one{brick_of(Look::kHoles, random), {}, 1U << reference, 0};
        one.around[reference] = one.brick;
        const std::size_t bytes = bytes_of(one);
        one.present = 0;
        EXPECT_LT(bytes, 40U) << reference;
        EXPECT_GT(bytes_of(one), 100 * 64U) << reference;
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
    // About a bit a sample: the mean's rounding.
    EXPECT_LT(bytes_of(one), 100 * 64 * 3 / 8 * 3 / 2U);
}

TEST(BrickCoder, ThreeSquaresAndTheirMeanTellTheFourth) {
    std::mt19937 random(14);
    Case one{brick_of(Look::kNoise, random), {}, 0b100, 3};
    one.around[2] = brick_of(Look::kNoise, random);
    const std::size_t unrelated = bytes_of(one);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            const auto mean = [&](std::uint8_t Rgba::*channel) {
                int sum = 2;
                for (int q = 0; q < 4; ++q) {
                    const int at = (2 * y + q / 2) * kBrickSide + 2 * x + q % 2;
                    sum += one.brick[static_cast<std::size_t>(at)].*channel;
                }
                return static_cast<std::uint8_t>(sum / 4);
            };
            one.around[2][static_cast<std::size_t>((y + 4) * kBrickSide + x + 4)] = {
                mean(&Rgba::r), mean(&Rgba::g), mean(&Rgba::b), 255};
        }
    }
    EXPECT_LT(bytes_of(one), unrelated * 9 / 10);
}

TEST(BrickCoder, ModesWithoutTheirReferencesAreRefused) {
    for (int symbol = 0; symbol < 256; ++symbol) {
        SymbolWriter symbols;
        symbols.put(0, kModeContext, static_cast<std::uint8_t>(symbol));
        symbols.put(0, kAlphaModeContext, 0);
        std::vector<std::byte> bytes;
        SymbolCosts costs = first_costs();
        symbols.finish(bytes, costs);
        Result<SymbolReader> reader = SymbolReader::open(bytes);
        ASSERT_TRUE(reader.has_value());
        BrickDecoder decoder((*reader).cursor());
        Brick brick;
        const bool plain_or_median = symbol / 2 % 4 < 3;
        const bool alone = symbol < 8 && plain_or_median;
        const Result<void> decoded = decoder.next(brick, {});
        EXPECT_EQ(decoded.has_value(), alone) << symbol;
        if (!decoded) {
            EXPECT_NE(decoded.error().message.find(std::to_string(symbol)),
                      std::string::npos);
        }
    }
}

TEST(BrickCoder, AlphaModesThatAreNoneAreRefused) {
    SymbolWriter symbols;
    symbols.put(0, kModeContext, BrickMode{}.symbol());
    symbols.put(0, kAlphaModeContext, kAlphaModes);
    std::vector<std::byte> bytes;
    SymbolCosts costs = first_costs();
    symbols.finish(bytes, costs);
    Result<SymbolReader> reader = SymbolReader::open(bytes);
    ASSERT_TRUE(reader.has_value());
    BrickDecoder decoder((*reader).cursor());
    Brick brick;
    const Result<void> decoded = decoder.next(brick, {});
    ASSERT_FALSE(decoded.has_value());
    EXPECT_NE(decoded.error().message.find("alpha mode 3"), std::string::npos);
}

TEST(BrickPrediction, AThirdIsRoundedToNearest) {
    for (int value = -3000; value <= 3000; ++value) {
        const int twice = 2 * value - 6 * third(value);  // 2/3 of a third off, at most
        EXPECT_LE(std::abs(twice), 2) << value;
    }
}

TEST(BrickPrediction, ResidualsComeBackModulo256) {
    for (int residual = -255; residual <= 255; ++residual)
        EXPECT_EQ(residual_of(residual_symbol(residual)),
                  static_cast<std::int8_t>(residual));
}

}  // namespace
}  // namespace haarmony::video
