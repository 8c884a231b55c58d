#include "engine/image/color_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace haarmony::image {
namespace {

// All combinations of 25 levels of R, G and B, which is 15,625 of the 16,384 places.
std::unique_ptr<ColorPlanes> all_colors() {
    constexpr int kLevels = 25;
    auto planes = std::make_unique<ColorPlanes>();
    for (int i = 0; i < kLevels * kLevels * kLevels; ++i) {
        (*planes)[0][i] = static_cast<float>(i % kLevels) / (kLevels - 1);
        (*planes)[1][i] = static_cast<float>(i / kLevels % kLevels) / (kLevels - 1);
        (*planes)[2][i] = static_cast<float>(i / kLevels / kLevels) / (kLevels - 1);
    }
    return planes;
}

TEST(Yiq, IsTheMatrixTimesTheColor) {
    const auto rgb = all_colors();
    const auto yiq = std::make_unique<ColorPlanes>(*rgb);
    rgb_to_yiq(*yiq);
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

TEST(Yiq, OfGreyHasThatLuminanceAndExactlyNoChroma) {
    const auto planes = std::make_unique<ColorPlanes>();
    for (int i = 0; i < kCoefficientCount; ++i) {
        const float grey = static_cast<float>(i) / (kCoefficientCount - 1);
        for (Plane& plane : *planes) plane[i] = grey;
    }
    const Plane grey = (*planes)[0];
    rgb_to_yiq(*planes);
    EXPECT_EQ((*planes)[0], grey);
    for (int i = 0; i < kCoefficientCount; ++i) {
        ASSERT_EQ((*planes)[1][i], 0.0F) << grey[i];
        ASSERT_EQ((*planes)[2][i], 0.0F) << grey[i];
    }
}

TEST(Yiq, StaysInTheRangesAndReachesTheirEnds) {
    const auto planes = all_colors();
    rgb_to_yiq(*planes);
    const auto [y_low, y_high] = std::ranges::minmax((*planes)[0]);
    const auto [i_low, i_high] = std::ranges::minmax((*planes)[1]);
    const auto [q_low, q_high] = std::ranges::minmax((*planes)[2]);
    EXPECT_EQ(y_low, 0.0F);
    EXPECT_EQ(y_high, 1.0F);
    constexpr double kRounding = 1e-7;
    EXPECT_NEAR(i_low, -kMaxI, kRounding);
    EXPECT_NEAR(i_high, kMaxI, kRounding);
    EXPECT_NEAR(q_low, -kMaxQ, kRounding);
    EXPECT_NEAR(q_high, kMaxQ, kRounding);
}

}  // namespace
}  // namespace haarmony::image
