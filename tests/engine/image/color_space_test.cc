#include "engine/image/color_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "tests/engine/image/all_kinds.h"
#include "tests/engine/image/color_cube.h"

namespace haarmony::image {
namespace {

TEST(ColorSpace, YiqIsTheMatrixTimesTheColor) {
    const auto rgb = color_cube();
    const auto yiq = std::make_unique<ColorPlanes>(*rgb);
    convert(ColorSpace::kYiq, *yiq);
    for (int i = 0; i < kCoefficientCount; ++i) {
        const double r = (*rgb)[0][i];
        const double g = (*rgb)[1][i];
        const double b = (*rgb)[2][i];
        // Three roundings of numbers below 1, and of the constants.
        constexpr double kTolerance = 2e-7;
        ASSERT_NEAR((*yiq)[0][i], 0.299 * r + 0.587 * g + 0.114 * b, kTolerance);
        ASSERT_NEAR((*yiq)[1][i], 0.595716 * r - 0.274453 * g - 0.321263 * b, kTolerance);
        ASSERT_NEAR((*yiq)[2][i], 0.211456 * r - 0.522591 * g + 0.311135 * b, kTolerance);
    }
}

TEST(ColorSpace, RgbIsWhatThePictureHas) {
    const auto rgb = color_cube();
    const auto same = std::make_unique<ColorPlanes>(*rgb);
    convert(ColorSpace::kRgb, *same);
    EXPECT_EQ(*same, *rgb);
}

// The usual definition: a hexagon of six cases, H in degrees.
TEST(ColorSpace, HsvIsTheHueOfTheHexagonOnACircle) {
    const auto rgb = color_cube();
    const auto hsv = std::make_unique<ColorPlanes>(*rgb);
    convert(ColorSpace::kHsv, *hsv);
    for (int i = 0; i < kCoefficientCount; ++i) {
        const double r = (*rgb)[0][i];
        const double g = (*rgb)[1][i];
        const double b = (*rgb)[2][i];
        const double v = std::max({r, g, b});
        const double c = v - std::min({r, g, b});
        double degrees = 0;
        if (c > 0) {
            if (v == r) {
                degrees = 60 * std::fmod((g - b) / c + 6, 6);
            } else if (v == g) {
                degrees = 60 * ((b - r) / c + 2);
            } else {
                degrees = 60 * ((r - g) / c + 4);
            }
        }
        const double s = v > 0 ? c / v : 0;
        const double angle = degrees * std::acos(-1.0) / 180;
        // A quotient, a series and a rotation, each rounded to 2^-24 a few times.
        constexpr double kTolerance = 1e-6;
        ASSERT_EQ((*hsv)[0][i], static_cast<float>(v));
        ASSERT_NEAR((*hsv)[1][i], s * std::cos(angle), kTolerance) << degrees;
        ASSERT_NEAR((*hsv)[2][i], s * std::sin(angle), kTolerance) << degrees;
    }
}

// Red with a trace of blue or of green is nearly the same red, although the hue is
// 360 - x or x degrees.
TEST(ColorSpace, HsvDoesNotJumpAtRed) {
    const auto planes = std::make_unique<ColorPlanes>();
    for (Plane& plane : *planes) plane.fill(0.0F);
    constexpr float kTrace = 1e-3F;
    (*planes)[0][0] = (*planes)[0][1] = 1.0F;
    (*planes)[1][0] = kTrace;
    (*planes)[2][1] = kTrace;
    convert(ColorSpace::kHsv, *planes);
    for (const int c : {1, 2}) {
        EXPECT_NEAR((*planes)[c][0], (*planes)[c][1], 3 * kTrace);
    }
}

TEST(ColorSpace, GreyHasExactlyNoChroma) {
    const auto grey = std::make_unique<ColorPlanes>();
    std::mt19937 random(71);
    for (int i = 0; i < kCoefficientCount; ++i) {
        const float value = i < 256 ? static_cast<float>(i) / 255.0F
                                    : static_cast<float>(random() >> 8) / (1 << 24);
        for (Plane& plane : *grey) plane[i] = value;
    }
    for (const ColorSpace space :
         {ColorSpace::kYiq, ColorSpace::kHsv, ColorSpace::kLab, ColorSpace::kLuv}) {
        const auto planes = std::make_unique<ColorPlanes>(*grey);
        convert(space, *planes);
        for (int i = 0; i < kCoefficientCount; ++i) {
            ASSERT_EQ((*planes)[1][i], 0.0F)
                << color_space_name(space) << " of " << (*grey)[0][i];
            ASSERT_EQ((*planes)[2][i], 0.0F)
                << color_space_name(space) << " of " << (*grey)[0][i];
        }
        EXPECT_EQ((*planes)[0][0], 0.0F) << color_space_name(space) << " of black";
        EXPECT_EQ((*planes)[0][255], 1.0F) << color_space_name(space) << " of white";
        if (space == ColorSpace::kYiq || space == ColorSpace::kHsv) {
            EXPECT_EQ((*planes)[0], (*grey)[0]) << color_space_name(space);
        }
    }
}

// The cube has all its corners and edges in fine steps, and that is where the ends lie.
TEST(ColorSpace, StaysInTheRangesAndReachesTheirEnds) {
    for (const ColorSpace space : kAllColorSpaces) {
        for (int c = 0; c < kChannels; ++c) {
            const ChannelRange range = channel_range(space, c);
            double lowest = 9;
            double highest = -9;
            for (const auto& rgb : {color_cube(), color_cube_edges()}) {
                convert(space, *rgb);
                const auto [low, high] = std::ranges::minmax((*rgb)[c]);
                lowest = std::min(lowest, double{low});
                highest = std::max(highest, double{high});
            }
            // The last printed digit, and roundings of numbers below 2.
            constexpr double kTolerance = 2e-6;
            EXPECT_NEAR(lowest, range.lowest, kTolerance)
                << color_space_name(space) << ' ' << channel_name(space, c);
            EXPECT_NEAR(highest, range.highest, kTolerance)
                << color_space_name(space) << ' ' << channel_name(space, c);
        }
    }
}

TEST(ColorSpace, ChannelsHaveTheirNames) {
    std::string names;
    for (const ColorSpace space : kAllColorSpaces) {
        for (int c = 0; c < kChannels; ++c) {
            names += std::string(channel_name(space, c)) + (c < 2 ? ", " : "; ");
        }
    }
    EXPECT_EQ(names, "Y, I, Q; R, G, B; V, S cos H, S sin H; L*, a*, b*; L*, u*, v*; ");
}

}  // namespace
}  // namespace haarmony::image
