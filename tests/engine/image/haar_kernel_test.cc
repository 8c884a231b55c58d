#include "engine/image/haar_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "engine/image/haar.h"
#include "engine/image/signature.h"
#include "tests/engine/image/each_target.h"
#include "tests/engine/image/pictures.h"

namespace haarmony::image {
namespace {

std::vector<float> random_values(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(random() >> 8) / (1 << 23) - 1;
    return values;
}

// Means and half differences, one value after the other.
std::vector<float> one_by_one(std::vector<float> values) {
    std::vector<float> result(values.size());
    while (values.size() > 1) {
        const std::size_t half = values.size() / 2;
        std::vector<float> means;
        for (std::size_t i = 0; i < half; ++i) {
            means.push_back((values[2 * i] + values[2 * i + 1]) * 0.5F);
            result[half + i] = (values[2 * i] - values[2 * i + 1]) * 0.5F;
        }
        values = means;
    }
    result[0] = values[0];
    return result;
}

constexpr int kSides[] = {1, 2, 4, 8, 16, 32, 64, 128};

TEST(HaarKernel, RowsAreThoseOfPlainArithmeticBitForBit) {
    for (const int side : kSides) {
        const auto plane = random_values(std::size_t(side) * side, 31);
        std::vector<float> expected;
        for (int y = 0; y < side; ++y) {
            const auto row =
                one_by_one({plane.begin() + y * side, plane.begin() + (y + 1) * side});
            expected.insert(expected.end(), row.begin(), row.end());
        }
        for_each_target([&](const char* target) {
            std::vector<float> own = plane;
            decompose_rows(own, side);
            ASSERT_EQ(own, expected) << target << ", side " << side;
        });
    }
}

TEST(HaarKernel, ColumnsAreThoseOfPlainArithmeticBitForBit) {
    const auto scales = random_values(std::size_t{7} * kMaxSide, 32);
    for (const int side : kSides) {
        const auto plane = random_values(std::size_t(side) * side, 33);
        std::vector<float> expected(plane.size());
        for (int x = 0; x < side; ++x) {
            std::vector<float> column;
            for (int y = 0; y < side; ++y) column.push_back(plane[y * side + x]);
            column = one_by_one(column);
            for (int y = 0; y < side; ++y) {
                int level = 0;
                while (2 << level <= y) ++level;
                expected[y * side + x] = column[y] * scales[level * kMaxSide + x];
            }
        }
        for_each_target([&](const char* target) {
            std::vector<float> own = plane;
            decompose_columns(own, side, scales.data());
            ASSERT_EQ(own, expected) << target << ", side " << side;
        });
    }
}

TEST(HaarKernel, PlacesAboveAreStrictlyAbove) {
    for (const std::size_t count : {0, 1, 3, 8, 13, 128, 255, 256}) {
        auto values = random_values(count, 34);
        for (std::size_t i = 0; i < count; i += 3) values[i] = i % 2 == 0 ? 0.5F : -0.5F;
        for (const float threshold : {0.0F, 0.25F, 0.5F, 2.0F}) {
            std::vector<int> expected;
            for (std::size_t i = 0; i < count; ++i) {
                if (std::fabs(values[i]) > threshold) expected.push_back(int(i));
            }
            for_each_target([&](const char* target) {
                std::vector<std::uint8_t> places(count);
                const int found = places_above(values, threshold, places.data());
                ASSERT_EQ(std::vector<int>(places.begin(), places.begin() + found),
                          expected)
                    << target << ", " << count << " above " << threshold;
            });
        }
    }
}

// The whole chain: what is stored must not depend on the machine.
TEST(HaarKernel, SignaturesAreTheSameOnEveryTarget) {
    for (const Pixels& picture : {scene(481, 321, 35),
                                  noise(127, 300, 3, 36),
                                  noise(40, 33, 4, 37),
                                  flat(9, 9, {1, 2, 3})}) {
        hwy::SetSupportedTargetsForTest(0);
        const Signature expected = make_signature(picture.view());
        for_each_target([&](const char* target) {
            EXPECT_EQ(make_signature(picture.view()), expected) << target;
        });
    }
}

}  // namespace
}  // namespace haarmony::image
