#include "engine/image/cie.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace haarmony::image {
namespace {

// The sRGB curve at equal steps, read with linear interpolation: the error is at most an
// eighth of the second derivative (below 3.4) times the square of a step, 3e-8.
constexpr int kCurveSteps = 4096;
using Curve = std::array<float, kCurveSteps + 1>;

Curve make_curve() {
    Curve curve{};
    for (int i = 0; i <= kCurveSteps; ++i) {
        const double value = static_cast<double>(i) / kCurveSteps;
        curve[i] = static_cast<float>(
            value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
    }
    return curve;
}

const Curve& srgb_curve() {
    static const Curve curve = make_curve();
    return curve;
}

float linear(const Curve& curve, float value) {
    const float position = value * kCurveSteps;
    // A rounding above 1 reads no further than the last step.
    const int step = std::clamp(static_cast<int>(position), 0, kCurveSteps - 1);
    const float share = position - static_cast<float>(step);
    return curve[step] + share * (curve[step + 1] - curve[step]);
}

// X, Y and Z, each divided by that of white.
struct Tristimulus {
    float x;
    float y;
    float z;
};

constexpr float kWhiteX = 0.9505F;
constexpr float kWhiteZ = 1.0890F;

//   X = 0.4124 R + 0.3576 G + 0.1805 B
//   Y = 0.2126 R + 0.7152 G + 0.0722 B
//   Z = 0.0193 R + 0.1192 G + 0.9505 B
// The rows add up to the white, which is what lets G be taken out of each.
Tristimulus tristimulus(const Curve& curve, const ColorPlanes& rgb, int i) {
    const float green = linear(curve, rgb[1][i]);
    const float red = linear(curve, rgb[0][i]) - green;
    const float blue = linear(curve, rgb[2][i]) - green;
    return {green + (0.4124F / kWhiteX * red + 0.1805F / kWhiteX * blue),
            green + (0.2126F * red + 0.0722F * blue),
            green + (0.0193F / kWhiteZ * red + 0.9505F / kWhiteZ * blue)};
}

// From a third of the exponent, which is off by at most 4 %, Halley's method cubes the error
// twice. Requires: value > 0.
float cube_root(float value) {
    constexpr std::uint32_t kTwoThirdsOfBias = 0x2A517D3D;
    float root =
        std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) / 3 + kTwoThirdsOfBias);
    for (int i = 0; i < 2; ++i) {
        const float cube = root * root * root;
        root += root * (value - cube) / (2.0F * cube + value);
    }
    return root;
}

// Below it the cube root gives way to a line.
constexpr float kBend = 216.0F / 24389;  // (6 / 29)^3

// The cube root, or the line that continues it.
float bent_root(float ratio) {
    constexpr float kSlope = 841.0F / 108;  // (29 / 6)^2 / 3
    return ratio > kBend ? cube_root(ratio) : kSlope * ratio + 4.0F / 29;
}

// L* / 100 of a relative luminance and its bent root: exactly 0 of black.
float lightness(float y, float root) {
    constexpr float kSlope = 24389.0F / 2700;  // (29 / 3)^3 / 100
    return y > kBend ? 1.16F * root - 0.16F : kSlope * y;
}

}  // namespace

void rgb_to_lab(ColorPlanes& planes) {
    const Curve& curve = srgb_curve();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const Tristimulus color = tristimulus(curve, planes, i);
        const float x = bent_root(color.x);
        const float y = bent_root(color.y);
        const float z = bent_root(color.z);
        planes[0][i] = lightness(color.y, y);
        planes[1][i] = 5.0F * (x - y);
        planes[2][i] = 2.0F * (y - z);
    }
}

// u' - u'n and v' - v'n over the common denominator, where what grey has in common cancels:
//   u' = 4 X / D, v' = 9 Y / D, D = X + 15 Y + 3 Z.
void rgb_to_luv(ColorPlanes& planes) {
    constexpr float kWhiteSum = kWhiteX + 15.0F + 3.0F * kWhiteZ;
    const Curve& curve = srgb_curve();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const auto [x, y, z] = tristimulus(curve, planes, i);
        const float light = lightness(y, bent_root(y));
        const float sum = kWhiteX * x + 15.0F * y + 3.0F * kWhiteZ * z;
        const float scale = sum > 0.0F ? 13.0F * light / (kWhiteSum * sum) : 0.0F;
        planes[0][i] = light;
        planes[1][i] =
            scale * 4.0F * kWhiteX * (15.0F * (x - y) + 3.0F * kWhiteZ * (x - z));
        planes[2][i] = scale * 9.0F * (kWhiteX * (y - x) + 3.0F * kWhiteZ * (y - z));
    }
}

}  // namespace haarmony::image
