#include "ingest/transfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace haarmony::ingest {
namespace {

// The formula of IEC 61966-2-1, forwards; the code searches in its inverse.
double formula(double linear) {
    const double encoded =
        linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return 255 * encoded;
}

TEST(Transfer, RoundsTheFormula) {
    for (int i = 0; i <= 100'000; ++i) {
        const float linear = static_cast<float>(i) / 100'000;
        // Half a step for rounding, and what two constants of four digits differ by.
        EXPECT_NEAR(linear_to_srgb(linear), formula(linear), 0.501) << linear;
    }
}

TEST(Transfer, LightOutsideTheRangeIsClamped) {
    EXPECT_EQ(linear_to_srgb(-1), 0);
    EXPECT_EQ(linear_to_srgb(1), 255);
    EXPECT_EQ(linear_to_srgb(1000), 255);
    EXPECT_EQ(linear_to_srgb(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(linear_to_srgb(-std::numeric_limits<float>::infinity()), 0);
    EXPECT_EQ(linear_to_srgb(std::numeric_limits<float>::quiet_NaN()), 0);
}

}  // namespace
}  // namespace haarmony::ingest
