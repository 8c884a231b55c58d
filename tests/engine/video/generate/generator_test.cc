// What the generated examples promise: that they are the same on every run, and what each
// of them is an example of.
#include "engine/video/generate/generator.h"

#include <gtest/gtest.h>

#include <array>
#include <complex>
#include <cstdlib>
#include <set>
#include <tuple>

#include "engine/video/create_frame.h"
#include "tests/engine/video/ops/source_pictures.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

GeneratorParameters parameters(std::int32_t width,
                               std::int32_t height,
                               std::int64_t frames) {
    GeneratorParameters wanted;
    wanted.width = width;
    wanted.height = height;
    wanted.frames = frames;
    return wanted;
}

std::unique_ptr<FrameSource> made(std::string_view name,
                                  const GeneratorParameters& wanted) {
    Result<std::unique_ptr<FrameSource>> source = make_generator(name, wanted);
    EXPECT_TRUE(source.has_value()) << name;
    return *std::move(source);
}

std::vector<Picture> shown(std::string_view name, const GeneratorParameters& wanted) {
    return testing::pictures_of(*made(name, wanted));
}

// Bricks of the first frame, as a part of those that a complete tree has at its finest
// level.
double bricks_of(std::string_view name, std::int32_t side) {
    SourceFrame frame;
    EXPECT_TRUE(*made(name, parameters(side, side, 2))->next(frame));
    return 64.0 * static_cast<double>(frame.tree.bricks.size()) / side / side;
}

int far(Rgba p, Rgba q) {
    return std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
}

TEST(Generator, IsTheSameOnEveryRunAndAnotherWithAnotherSeed) {
    for (const std::string_view name : kGeneratorNames) {
        GeneratorParameters wanted = parameters(96, 40, 5);
        const std::vector<Picture> first = shown(name, wanted);
        ASSERT_EQ(first.size(), 5U) << name;
        EXPECT_EQ(first[0].width, 96) << name;
        EXPECT_EQ(first[0].height, 40) << name;
        EXPECT_EQ(shown(name, wanted), first) << name;
        wanted.seed = 2;
        EXPECT_NE(shown(name, wanted), first) << name;
        for (const Picture& picture : first) {
            for (const Rgba& pixel : picture.pixels) ASSERT_EQ(pixel.a, 255) << name;
        }
    }
}

TEST(Generator, SmallestAndShallowestAreMadeToo) {
    for (const std::string_view name : kGeneratorNames) {
        for (const auto& [width, height, depth] :
             {std::tuple{16, 16, 3}, {16, 16, 4}, {200, 17, 3}, {17, 130, 5}}) {
            GeneratorParameters wanted = parameters(width, height, 1);
            wanted.depth = depth;
            EXPECT_EQ(shown(name, wanted).size(), 1U) << name << " " << width;
        }
    }
}

TEST(Generator, SizesThatAreNotAskedForKeepTheProportion) {
    EXPECT_EQ(made("wind", {})->format(), (FrameFormat{64, 64, {}}));
    GeneratorParameters wanted;
    wanted.height = 20;
    EXPECT_EQ(made("panorama", wanted)->format(), (FrameFormat{80, 20, {}}));
    wanted = {};
    wanted.width = 80;
    wanted.rate = {30'000, 1001};
    EXPECT_EQ(made("panorama", wanted)->format(), (FrameFormat{80, 20, {30'000, 1001}}));
}

TEST(Generator, WhatCannotBeMadeIsNamed) {
    const auto refused = [](std::string_view name, const GeneratorParameters& wanted) {
        const auto source = make_generator(name, wanted);
        return source ? std::string("made") : source.error().param;
    };
    EXPECT_EQ(refused("mandelbrot", {}), "generate");
    EXPECT_NE(make_generator("mandelbrot", {}).error().message.find("panorama"),
              std::string::npos);
    for (const std::string_view name : kGeneratorNames) {
        EXPECT_EQ(refused(name, parameters(15, 64, 1)), "width") << name;
        EXPECT_EQ(refused(name, parameters(-1, 64, 1)), "width") << name;
        EXPECT_EQ(refused(name, parameters(70'000, 64, 1)), "width") << name;
        EXPECT_EQ(refused(name, parameters(64, 15, 1)), "height") << name;
        EXPECT_EQ(refused(name, parameters(64, 1 << 17, 1)), "height") << name;
        EXPECT_EQ(refused(name, parameters(64, 64, -1)), "frames") << name;
        EXPECT_EQ(refused(name, parameters(64, 64, kMaxGeneratedFrames + 1)), "frames");
        GeneratorParameters wanted = parameters(64, 64, 1);
        wanted.depth = 7;
        EXPECT_EQ(refused(name, wanted), "depth") << name;
        wanted.depth = 2;
        EXPECT_EQ(refused(name, wanted), "depth") << name;
        wanted.depth = 3;
        wanted.rate = {0, 1};
        EXPECT_EQ(refused(name, wanted), "rate") << name;
    }
    // All of it is detail: a larger one would be more than memory holds.
    EXPECT_EQ(refused("wind", parameters(4096, 64, 1)), "width");
}

TEST(Julia, IsDeepOnlyNearItsBoundary) {
    EXPECT_LT(bricks_of("julia", 512), 0.5 * bricks_of("julia", 64));
}

TEST(Julia, EscapesAsPlainIterationDoes) {
    const int side = 96;
    GeneratorParameters wanted = parameters(side, side, 1);
    wanted.seed = 2;  // a set that has an inside
    const Picture picture = shown("julia", wanted)[0];
    const std::complex<double> c = std::polar(0.7885, 2.8 + 0.37);
    int differ = 0, inside = 0;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            std::complex<double> z((x + 0.5 - side / 2) * 3.3 / side,
                                   (y + 0.5 - side / 2) * 3.3 / side);
            int steps = 0;
            while (steps < 192 && std::norm(z) <= 1e4) {
                z = z * z + c;
                ++steps;
            }
            inside += steps == 192 ? 1 : 0;
            differ += (steps == 192) != (picture.at(x, y) == Rgba{0, 0, 0, 255}) ? 1 : 0;
        }
    }
    EXPECT_GT(inside, side * side / 20);
    EXPECT_LE(differ, side * side / 200);
}

TEST(Galaxy, IsBlackButForFewColors) {
    const std::vector<Picture> pictures = shown("galaxy", parameters(256, 256, 12));
    std::set<std::tuple<int, int, int>> colors;
    for (const Picture& picture : pictures) {
        std::size_t black = 0;
        for (const Rgba& p : picture.pixels) {
            colors.insert({p.r, p.g, p.b});
            black += p == Rgba{0, 0, 0, 255} ? 1 : 0;
        }
        EXPECT_GT(black, picture.pixels.size() * 9 / 10);
        EXPECT_LT(black, picture.pixels.size() - 500);
    }
    EXPECT_LE(colors.size(), 8U);
    EXPECT_NE(pictures.front(), pictures.back());
}

TEST(Galaxy, CostsItsStarsWhateverItsSize) {
    SourceFrame frame;
    ASSERT_TRUE(*made("galaxy", parameters(65'536, 65'536, 1))->next(frame));
    // 2,400 stars, each with its way from the root: 13 levels at most.
    EXPECT_LT(frame.tree.nodes.size(), 2400U * 13);
    EXPECT_GT(frame.tree.nodes.size(), 2400U);
}

TEST(Fluid, KeepsAsMuchOfEitherAndIsCoarseInTimeAtFirst) {
    const auto source = made("fluid", parameters(64, 64, 64));
    SourceFrame frame;
    std::vector<std::int64_t> stays;
    while (*source->next(frame)) {
        stays.push_back(frame.repeats);
        const Picture picture = testing::picture_of(frame.tree, source->format());
        int heavy = 0;
        for (const Rgba& p : picture.pixels) heavy += p.b > p.r ? 1 : 0;
        EXPECT_NEAR(heavy, 64 * 64 / 2, 64 * 64 / 20) << stays.size();
    }
    EXPECT_EQ(std::vector<std::int64_t>(stays.begin(), stays.begin() + 4),
              std::vector<std::int64_t>(4, 4));
    EXPECT_EQ(stays[4], 2);
    EXPECT_EQ(stays.back(), 1);
    EXPECT_EQ(stays.size(), 4U + 8U + 32U);
}

TEST(Fluid, IsFineWhereTheFluidsMeet) {
    EXPECT_LT(bricks_of("fluid", 512), 0.3 * bricks_of("fluid", 64));
}

TEST(Wind, HasDetailEverywhere) { EXPECT_EQ(bricks_of("wind", 64), 1.0); }

TEST(Wind, ContinentsAreDarkWhenAllDaysAreAveraged) {
    testing::RawClip days;
    days.format = {32, 32, {25, 1}};
    days.frames = shown("wind", parameters(32, 32, 32));
    const Picture mean = testing::exact_picture(days, {0, 0}, 5, Edge::kPad);
    int dark = 0, bright = 0;
    for (const Rgba& p : mean.pixels) {
        const int value = std::max({p.r, p.g, p.b});
        dark += value < 60 ? 1 : 0;
        bright += value > 120 ? 1 : 0;
    }
    EXPECT_GT(dark, 32 * 32 / 10);
    EXPECT_GT(bright, 32 * 32 / 10);
}

TEST(Room, MovesWhereItsClipArtDoes) {
    const std::vector<Picture> pictures = shown("room", parameters(256, 256, 12));
    std::size_t still = 0;
    const auto in =
        [](int x, int y, double left, double top, double right, double bottom) {
            return x >= 256 * left && x < 256 * right && y >= 256 * top &&
                   y < 256 * bottom;
        };
    std::array<int, 2> moving{};  // on the clock, on the screen
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 256; ++x) {
            bool moves = false;
            for (const Picture& picture : pictures) {
                moves = moves || picture.at(x, y) != pictures[0].at(x, y);
            }
            still += moves ? 0 : 1;
            if (moves && in(x, y, 0.15, 0.07, 0.37, 0.29)) ++moving[0];
            if (moves && in(x, y, 0.64, 0.45, 0.92, 0.67)) ++moving[1];
        }
    }
    EXPECT_GT(still, 256U * 256U * 8 / 10);
    EXPECT_GT(moving[0], 20);
    EXPECT_GT(moving[1], 200);
    EXPECT_LT(bricks_of("room", 512), 0.2);
}

TEST(Panorama, ComesAroundWithoutASeam) {
    const Picture picture = shown("panorama", parameters(512, 128, 1))[0];
    const auto step = [&](int x) {
        int sum = 0;
        for (int y = 0; y < 128; ++y) {
            sum += far(picture.at(x, y), picture.at((x + 1) % 512, y));
        }
        return sum;
    };
    int largest = 0;
    for (int x = 0; x < 511; ++x) largest = std::max(largest, step(x));
    EXPECT_LT(step(511), largest / 4);
}

TEST(Panorama, VerticalsAreVertical) {
    const Picture picture = shown("panorama", parameters(512, 128, 1))[0];
    // The corners of the room: an eighth of the way around, and every quarter from there.
    for (const int corner : {64, 192, 320, 448}) {
        for (int y = 50; y < 80; ++y) {
            EXPECT_GT(far(picture.at(corner - 1, y), picture.at(corner, y)), 10)
                << corner << " " << y;
        }
    }
}

TEST(Panorama, CloudsAndThePictureMove) {
    const std::vector<Picture> pictures = shown("panorama", parameters(512, 128, 8));
    int moving = 0;
    for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i) {
        moving += pictures[0].pixels[i] != pictures[7].pixels[i] ? 1 : 0;
    }
    EXPECT_GT(moving, 200);
    EXPECT_LT(moving, 512 * 128 / 8);
}

}  // namespace
}  // namespace haarmony::video
