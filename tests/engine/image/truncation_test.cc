#include "engine/image/truncation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

namespace haarmony::image {
namespace {

std::vector<int> kept(const Plane& plane) {
    const ChannelSignature channel = truncate(plane);
    const auto indices = channel.largest(kMaxCoefficients);
    return {indices.begin(), indices.end()};
}

// Everything sorted by the definition.
std::vector<int> sorted_and_cut(const Plane& plane) {
    std::vector<int> order;
    for (int i = 1; i < kCoefficientCount; ++i) {
        if (plane[i] != 0) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return std::fabs(plane[a]) > std::fabs(plane[b]);
    });
    order.resize(std::min(order.size(), std::size_t{kMaxCoefficients}));
    for (int& index : order) {
        if (plane[index] < 0) index = -index;
    }
    return order;
}

std::unique_ptr<Plane> random_plane(unsigned seed, int levels) {
    auto plane = std::make_unique<Plane>();
    std::mt19937 random(seed);
    for (float& value : *plane) {
        value =
            static_cast<float>(static_cast<int>(random() % (2 * levels + 1)) - levels) /
            static_cast<float>(levels);
    }
    return plane;
}

TEST(Truncation, KeepsTheLargestInOrder) {
    const auto plane = random_plane(31, 1 << 22);
    EXPECT_EQ(kept(*plane), sorted_and_cut(*plane));
}

TEST(Truncation, BreaksTiesByTheSmallerIndex) {
    for (const int levels : {1, 2, 5, 40}) {
        const auto plane = random_plane(32, levels);
        EXPECT_EQ(kept(*plane), sorted_and_cut(*plane)) << levels << " levels";
    }
}

// Rising and falling magnitudes are the worst and the best case of a running threshold.
TEST(Truncation, DoesNotDependOnWhereTheLargeOnesAre) {
    const auto plane = std::make_unique<Plane>();
    for (const int slope : {+1, -1}) {
        for (int i = 0; i < kCoefficientCount; ++i) {
            (*plane)[i] = static_cast<float>(slope > 0 ? i : kCoefficientCount - i);
        }
        EXPECT_EQ(kept(*plane), sorted_and_cut(*plane)) << slope;
    }
}

TEST(Truncation, NeverKeepsAZeroOfEitherSign) {
    const auto plane = std::make_unique<Plane>();
    (*plane)[5] = -0.0F;
    (*plane)[77] = -1e-30F;
    (*plane)[4000] = 2e-30F;
    EXPECT_EQ(kept(*plane), (std::vector<int>{4000, -77}));
}

TEST(Truncation, NeverKeepsTheMean) {
    const auto plane = std::make_unique<Plane>();
    (*plane)[0] = 0.75F;
    const ChannelSignature channel = truncate(*plane);
    EXPECT_EQ(channel.count, 0);
    EXPECT_EQ(channel.average, 3 * kAverageOne / 4);
}

TEST(Truncation, RoundsTheAverageToFixedPoint) {
    const auto plane = std::make_unique<Plane>();
    for (const float mean : {1.0F, -0.5957F, 1.0F / 3.0F, 1e-7F, -3e-8F}) {
        (*plane)[0] = mean;
        EXPECT_EQ(truncate(*plane).average, std::lround(std::ldexp(double(mean), 24)))
            << mean;
    }
}

TEST(WaveletEnergy, IsTheSumOfSquaresWithoutTheMean) {
    const auto plane = random_plane(33, 1 << 20);
    double expected = 0;
    for (int i = 1; i < kCoefficientCount; ++i) {
        expected += double((*plane)[i]) * (*plane)[i];
    }
    EXPECT_NEAR(wavelet_energy(*plane) / expected, 1.0, 1e-6);
}

}  // namespace
}  // namespace haarmony::image
