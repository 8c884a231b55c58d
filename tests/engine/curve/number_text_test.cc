#include "engine/curve/number_text.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <random>

namespace haarmony::curve {
namespace {

TEST(NumberText, BringsBackTheSameDouble) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 20000; ++i) {
        const auto value = std::bit_cast<double>(random());
        if (!(std::abs(value) <= 1.7e308)) continue;
        EXPECT_EQ(std::strtod(number_text(value).c_str(), nullptr), value);
    }
}

TEST(NumberText, IsShort) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(-3), "-3");
    EXPECT_EQ(number_text(1e100), "1e+100");
}

}  // namespace
}  // namespace haarmony::curve
