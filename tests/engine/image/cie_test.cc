#include "engine/image/cie.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "tests/engine/image/color_cube.h"

namespace haarmony::image {
namespace {

using Triple = std::array<double, 3>;

double linear(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

Triple xyz(const Triple& rgb) {
    constexpr double kMatrix[3][3] = {
        {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
    Triple result{};
    for (int row = 0; row < 3; ++row) {
        for (int c = 0; c < 3; ++c) result[row] += kMatrix[row][c] * linear(rgb[c]);
    }
    return result;
}

const Triple kWhite = xyz({1, 1, 1});

double bent_root(double ratio) {
    const double d = 6.0 / 29;
    return ratio > d * d * d ? std::cbrt(ratio) : ratio / (3 * d * d) + 4.0 / 29;
}

// As the standard prints them, in double precision.
Triple lab(const Triple& rgb) {
    const Triple color = xyz(rgb);
    const double x = bent_root(color[0] / kWhite[0]);
    const double y = bent_root(color[1] / kWhite[1]);
    const double z = bent_root(color[2] / kWhite[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

std::pair<double, double> uv(const Triple& color) {
    const double sum = color[0] + 15 * color[1] + 3 * color[2];
    return {4 * color[0] / sum, 9 * color[1] / sum};
}

Triple luv(const Triple& rgb) {
    const Triple color = xyz(rgb);
    if (color[1] == 0) return {0, 0, 0};
    const double light = lab(rgb)[0];
    const auto [u, v] = uv(color);
    const auto [white_u, white_v] = uv(kWhite);
    return {light, 13 * light * (u - white_u), 13 * light * (v - white_v)};
}

// a* is five times a difference of roots and u* some ten times a quotient, each of several
// roundings to 6e-8; the table of the curve adds less. Measured over a million colours: 1.2e-6.
constexpr double kTolerance = 2e-6;

void expect_near(const ColorPlanes& rgb,
                 const ColorPlanes& converted,
                 Triple (*exact)(const Triple&)) {
    for (int i = 0; i < kCoefficientCount; ++i) {
        const Triple expected = exact({rgb[0][i], rgb[1][i], rgb[2][i]});
        for (int c = 0; c < kChannels; ++c) {
            ASSERT_NEAR(converted[c][i], expected[c] / 100, kTolerance)
                << "channel " << c << " of " << rgb[0][i] << ' ' << rgb[1][i] << ' '
                << rgb[2][i];
        }
    }
}

TEST(Cie, LabIsTheStandardsDividedBy100) {
    for (const auto& rgb : {color_cube(), color_cube_edges()}) {
        const auto planes = std::make_unique<ColorPlanes>(*rgb);
        rgb_to_lab(*planes);
        expect_near(*rgb, *planes, lab);
    }
}

TEST(Cie, LuvIsTheStandardsDividedBy100) {
    for (const auto& rgb : {color_cube(), color_cube_edges()}) {
        const auto planes = std::make_unique<ColorPlanes>(*rgb);
        rgb_to_luv(*planes);
        expect_near(*rgb, *planes, luv);
    }
}

// Near black the denominators and the line count, down to what one sample of a huge picture
// leaves in a cell.
TEST(Cie, HoldsNearBlack) {
    const auto rgb = std::make_unique<ColorPlanes>();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const double size = std::exp2(-40.0 * i / kCoefficientCount);
        for (int c = 0; c < kChannels; ++c) {
            (*rgb)[c][i] = static_cast<float>(size * ((i >> c) % 2 == 0 ? 1.0 : 0.1));
        }
    }
    const auto planes = std::make_unique<ColorPlanes>(*rgb);
    rgb_to_lab(*planes);
    expect_near(*rgb, *planes, lab);
    *planes = *rgb;
    rgb_to_luv(*planes);
    expect_near(*rgb, *planes, luv);
}

// Published values of the primaries under D65, to their digits.
TEST(Cie, OfThePrimariesAsPublished) {
    const auto planes = std::make_unique<ColorPlanes>();
    for (int c = 0; c < kChannels; ++c) (*planes)[c][c] = 1.0F;
    const auto luv_planes = std::make_unique<ColorPlanes>(*planes);
    rgb_to_lab(*planes);
    rgb_to_luv(*luv_planes);
    constexpr double kLab[3][3] = {
        {53.24, 80.09, 67.20}, {87.73, -86.18, 83.18}, {32.30, 79.19, -107.86}};
    constexpr double kLuv[3][3] = {
        {53.24, 175.01, 37.75}, {87.73, -83.08, 107.40}, {32.30, -9.40, -130.34}};
    for (int color = 0; color < 3; ++color) {
        for (int c = 0; c < kChannels; ++c) {
            // The primaries of the tables have more digits than ours.
            EXPECT_NEAR(100 * (*planes)[c][color], kLab[color][c], 0.06);
            EXPECT_NEAR(100 * (*luv_planes)[c][color], kLuv[color][c], 0.06);
        }
    }
}

TEST(Cie, LightnessRisesWithEveryStepOfGrey) {
    const auto planes = std::make_unique<ColorPlanes>();
    for (int i = 0; i < kCoefficientCount; ++i) {
        for (Plane& plane : *planes) {
            plane[i] = static_cast<float>(i) / (kCoefficientCount - 1);
        }
    }
    rgb_to_lab(*planes);
    for (int i = 1; i < kCoefficientCount; ++i) {
        ASSERT_GT((*planes)[0][i], (*planes)[0][i - 1]) << i;
    }
}

}  // namespace
}  // namespace haarmony::image
