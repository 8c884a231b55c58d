#include "ingest/gallery/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace haarmony::gallery {
namespace {

double largest_difference(const Color& a, const Color& b) {
    return std::max({std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b)});
}

// OKLab's hue of a colour in turns, by the library's functions.
double hue_of(const Color& c) {
    const double l =
        std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
    const double m =
        std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
    const double s =
        std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    const double a = 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s;
    const double b = 0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s;
    const double turns = std::atan2(b, a) / (2 * M_PI);
    return turns < 0 ? turns + 1 : turns;
}

TEST(Palette, WithoutChromaEveryLightnessIsGrey) {
    for (double lightness = 0; lightness <= 1; lightness += 0.05) {
        const Color c = oklch(lightness, 0, 0.3);
        const double grey = lightness * lightness * lightness;
        EXPECT_LT(largest_difference(c, {grey, grey, grey}), 1e-5) << lightness;
    }
}

TEST(Palette, EveryColourFitsTheDisplayAndKeepsItsHue) {
    for (int step = 1; step < 10; ++step) {
        const double lightness = step / 10.0;
        for (int turn = 0; turn < 100; ++turn) {
            const double hue = turn / 100.0;
            const Color c = oklch(lightness, 0.4, hue);
            for (const double part : {c.r, c.g, c.b}) {
                ASSERT_GE(part, 0);
                ASSERT_LE(part, 1);
            }
            const double off = std::fabs(hue_of(c) - hue);
            ASSERT_LT(std::min(off, 1 - off), 0.01) << lightness << " " << hue;
        }
    }
}

TEST(Palette, PrimariesLieAtTheirNames) {
    EXPECT_NEAR(hue_of({1, 0, 0}), kRed, 0.02);
    EXPECT_NEAR(hue_of({1, 1, 0}), kYellow, 0.02);
    EXPECT_NEAR(hue_of({0, 1, 0}), kGreen, 0.02);
    EXPECT_NEAR(hue_of({0, 1, 1}), kCyan, 0.04);
    EXPECT_NEAR(hue_of({0, 0, 1}), kBlue, 0.02);
    EXPECT_NEAR(hue_of({1, 0, 1}), kMagenta, 0.04);
}

TEST(Palette, RampPassesThroughItsStops) {
    const Color stops[] = {{0.1, 0.2, 0.7}, {0.9, 0.3, 0.1}, {0.95, 0.9, 0.8}};
    const Ramp ramp{stops[0], stops[1], stops[2]};
    for (int i = 0; i < 3; ++i)
        EXPECT_LT(largest_difference(ramp.at(i / 2.0), stops[i]), 1e-6) << i;
    EXPECT_LT(largest_difference(ramp.at(-3), stops[0]), 1e-6);
    EXPECT_LT(largest_difference(ramp.at(7), stops[2]), 1e-6);
}

TEST(Palette, RampHasNoSteps) {
    const Ramp ramp{{0, 0, 0}, {1, 0.1, 0}, {0.2, 1, 1}};
    for (int i = 0; i < 5000; ++i)
        ASSERT_LT(largest_difference(ramp.at(i / 5000.0), ramp.at((i + 1) / 5000.0)),
                  0.01);
}

TEST(Palette, RampWithUnevenStopsHoldsItsEnds) {
    const Ramp ramp(std::vector<Ramp::Stop>{{0.25, {1, 0, 0}}, {0.5, {0, 0, 1}}});
    EXPECT_LT(largest_difference(ramp.at(0.1), {1, 0, 0}), 1e-6);
    EXPECT_LT(largest_difference(ramp.at(0.9), {0, 0, 1}), 1e-6);
}

TEST(Palette, ShadeOfOneIsTheColourItself) {
    const Color c{0.3, 0.6, 0.1};
    EXPECT_LT(largest_difference(shade_of(c, 1), c), 1e-6);
    EXPECT_LT(luminance(shade_of(c, 0.7)), luminance(c));
    EXPECT_GT(luminance(shade_of(c, 1.2)), luminance(c));
}

TEST(Palette, HarmonyBeginsWithItsBase) {
    Random random(3);
    for (int i = 0; i < 50; ++i) {
        const double base = random.unit();
        const auto hues = harmony(random, base);
        ASSERT_EQ(hues.size(), 5U);
        const double off = std::fabs(hues[0] - base);
        EXPECT_LT(std::min(off, 1 - off), 0.02);
        for (const double hue : hues) {
            EXPECT_GE(hue, 0);
            EXPECT_LT(hue, 1);
        }
    }
}

}  // namespace
}  // namespace haarmony::gallery
