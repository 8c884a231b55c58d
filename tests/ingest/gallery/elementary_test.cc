#include "ingest/gallery/elementary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace haarmony::gallery {
namespace {

// The library's functions are the oracle, and only here.

TEST(Elementary, SineAndCosineAgreeWithTheLibrary) {
    for (int i = -40000; i <= 40000; ++i) {
        const double x = i * 0.0137;
        ASSERT_NEAR(sine(x), std::sin(x), 1e-8) << "x = " << x;
        ASSERT_NEAR(cosine(x), std::cos(x), 1e-8) << "x = " << x;
    }
}

TEST(Elementary, ExponentialAgreesWithTheLibrary) {
    for (double x = -680; x < 689; x += 0.0931) {
        const double expected = std::exp(x);
        ASSERT_NEAR(exponential(x), expected, 1e-8 * expected) << "x = " << x;
    }
}

TEST(Elementary, ExponentialOfAVeryNegativeNumberIsZero) {
    EXPECT_EQ(exponential(-691), 0);
    EXPECT_EQ(exponential(-1e300), 0);
}

TEST(Elementary, LogarithmAgreesWithTheLibrary) {
    for (double x = 1e-300; x < 1e300; x *= 1.37)
        ASSERT_NEAR(logarithm(x), std::log(x), 1e-11 * std::fabs(std::log(x)) + 1e-14)
            << "x = " << x;
    EXPECT_EQ(logarithm(1), 0);
}

TEST(Elementary, PowerAgreesWithTheLibrary) {
    for (double base = 1e-6; base < 1e4; base *= 1.7) {
        for (double exponent = -4; exponent <= 9; exponent += 0.37) {
            const double expected = std::pow(base, exponent);
            ASSERT_NEAR(power(base, exponent), expected, 1e-8 * expected)
                << base << " to the power of " << exponent;
        }
    }
    EXPECT_EQ(power(0, 2.5), 0);
}

TEST(Elementary, ArcTangentAgreesWithTheLibraryInEveryQuadrant) {
    for (int i = 0; i < 5000; ++i) {
        const double angle = -kPi + (i + 0.5) * kTurn / 5000;
        const double y = 3.7 * std::sin(angle);
        const double x = 3.7 * std::cos(angle);
        ASSERT_NEAR(arc_tangent(y, x), std::atan2(y, x), 1e-8) << "angle = " << angle;
    }
}

TEST(Elementary, ArcTangentOnTheAxes) {
    EXPECT_EQ(arc_tangent(0, 0), 0);
    EXPECT_EQ(arc_tangent(0, 2), 0);
    EXPECT_NEAR(arc_tangent(0, -2), kPi, 1e-12);
    EXPECT_NEAR(arc_tangent(2, 0), kPi / 2, 1e-12);
    EXPECT_NEAR(arc_tangent(-2, 0), -kPi / 2, 1e-12);
}

TEST(Elementary, FloorIsBelowNegativeNumbersToo) {
    for (int i = -1000; i <= 1000; ++i) {
        const double x = i * 0.125;
        ASSERT_EQ(floor_int(x), static_cast<int>(std::floor(x))) << "x = " << x;
    }
}

TEST(Elementary, SmoothstepRunsBothWays) {
    EXPECT_EQ(smoothstep(0, 1, -1), 0);
    EXPECT_EQ(smoothstep(0, 1, 2), 1);
    EXPECT_EQ(smoothstep(0, 1, 0.5), 0.5);
    EXPECT_EQ(smoothstep(1, 0, 2), 0);
    EXPECT_EQ(smoothstep(1, 0, -1), 1);
}

}  // namespace
}  // namespace haarmony::gallery
