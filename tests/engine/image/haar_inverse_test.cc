#include "engine/image/haar_inverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/engine/image/all_kinds.h"

namespace haarmony::image {
namespace {

TEST(HaarInverse, GivesTheChannelBack) {
    std::mt19937 random(81);
    for (const Decomposition decomposition : kAllDecompositions) {
        for (int side = 1; side <= kMaxSide; side *= 2) {
            std::vector<float> plane(std::size_t(side) * side);
            for (float& value : plane) {
                value = static_cast<float>(random() >> 8) / (1 << 24);
            }
            std::vector<float> again = plane;
            decompose(again, side, decomposition);
            recompose(again, side, decomposition);
            for (std::size_t i = 0; i < plane.size(); ++i) {
                // 14 roundings of numbers below 1 on the way there and on the way back.
                ASSERT_NEAR(again[i], plane[i], 3e-6) << decomposition_name(decomposition)
                                                      << " side " << side << " at " << i;
            }
        }
    }
}

// One coefficient gives its basis function, so that all of them are orthogonal to each other
// and have mean square 1: the matrix of one small side in full.
TEST(HaarInverse, OfSingleCoefficientsIsAnOrthonormalBasis) {
    constexpr int kLength = 8;
    constexpr int kPlaces = kLength * kLength;
    for (const Decomposition decomposition : kAllDecompositions) {
        std::vector<std::vector<float>> functions;
        for (int place = 0; place < kPlaces; ++place) {
            std::vector<float> plane(kPlaces, 0.0F);
            plane[place] = 1.0F;
            recompose(plane, kLength, decomposition);
            functions.push_back(plane);
        }
        for (int a = 0; a < kPlaces; ++a) {
            for (int b = 0; b < kPlaces; ++b) {
                double product = 0;
                for (int i = 0; i < kPlaces; ++i) {
                    product += double{functions[a][i]} * functions[b][i] / kPlaces;
                }
                ASSERT_NEAR(product, a == b ? 1.0 : 0.0, 1e-6)
                    << decomposition_name(decomposition) << ' ' << a << ", " << b;
            }
        }
    }
}

// Coefficient (1, 2) of 4 x 4 places: left against right in the left half, in the standard
// decomposition upper against lower half as well, in the non-standard one below only.
TEST(HaarInverse, OfOneCoefficientByHand) {
    std::vector<float> standard(16, 0.0F);
    standard[1 * 4 + 2] = 1.0F;
    recompose(standard, 4, Decomposition::kStandard);
    const float root = std::sqrt(2.0F);
    const std::vector<float> narrow = {
        root, -root, 0, 0, root, -root, 0, 0, -root, root, 0, 0, -root, root, 0, 0};
    EXPECT_EQ(standard, narrow);

    std::vector<float> nonstandard(16, 0.0F);
    nonstandard[1 * 4 + 2] = 1.0F;
    recompose(nonstandard, 4, Decomposition::kNonstandard);
    const std::vector<float> square = {0, 0, 0, 0, 0, 0, 0, 0, 2, -2, 0, 0, 2, -2, 0, 0};
    EXPECT_EQ(nonstandard, square);
}

}  // namespace
}  // namespace haarmony::image
