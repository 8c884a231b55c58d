#include "engine/image/area_mean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "tests/engine/image/each_target.h"

namespace haarmony::image {
namespace {

TEST(AreaMean, QuotientsAndBytesAreThoseOfPlainArithmetic) {
    std::mt19937 random(23);
    for (const std::size_t count : {1, 2, 3, 7, 8, 31, 384}) {
        std::vector<std::uint32_t> sums(count);
        for (std::uint32_t& sum : sums) {
            sum = static_cast<std::uint32_t>(random() >> 1);
        }
        sums[0] = 0x7FFFFFFF;
        constexpr double kScale = 255.0 * 481 * 321;
        const float factor = 255.0F / 2147483648.0F;
        std::vector<float> quotients;
        std::vector<std::uint8_t> bytes;
        for (const std::uint32_t sum : sums) {
            quotients.push_back(static_cast<float>(sum / kScale));
            bytes.push_back(static_cast<std::uint8_t>(std::floor(
                static_cast<float>(static_cast<std::int32_t>(sum)) * factor + 0.5F)));
        }
        for_each_target([&](const char* target) {
            std::vector<float> own_quotients(count);
            divide(sums, kScale, own_quotients);
            EXPECT_EQ(own_quotients, quotients) << target << ", " << count;
            std::vector<std::uint8_t> own_bytes(count);
            scale_to_bytes(sums, factor, own_bytes);
            EXPECT_EQ(own_bytes, bytes) << target << ", " << count;
        });
    }
}

TEST(AreaMean, ColorsAreTakenApart) {
    for (const std::size_t count : {1, 5, 8, 33}) {
        std::vector<float> mixed;
        for (std::size_t i = 0; i < 3 * count; ++i) mixed.push_back(float(i));
        for_each_target([&](const char* target) {
            std::vector<float> red(count), green(count), blue(count);
            take_apart(mixed, red, green, blue);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_EQ(red[i], mixed[3 * i]) << target;
                ASSERT_EQ(green[i], mixed[3 * i + 1]) << target;
                ASSERT_EQ(blue[i], mixed[3 * i + 2]) << target;
            }
        });
    }
}

}  // namespace
}  // namespace haarmony::image
