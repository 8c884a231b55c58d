#include "engine/image/term_weights.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace haarmony::image {
namespace {

TEST(TermWeights, AreThoseOfAMapForEveryKey) {
    std::mt19937 random(531);
    for (const int terms : {0, 1, 60, kChannels * kMaxCoefficients}) {
        TermWeights weights;
        std::map<std::uint32_t, std::int32_t> expected;
        while (int(expected.size()) < terms) {
            const auto key = static_cast<std::uint32_t>(random() % kKeyCount);
            if (key % kCoefficientCount == 0) continue;
            const auto weight = static_cast<std::int32_t>(random() % 4000);
            weights.add(key, weight);
            expected[key] += weight;
        }
        for (std::uint32_t key = 0; key < kKeyCount; ++key) {
            const auto found = expected.find(key);
            ASSERT_EQ(weights.of(key), found == expected.end() ? 0 : found->second)
                << "key " << key << " of " << terms;
        }
    }
}

TEST(TermWeights, KeysThatShareABitAreToldApart) {
    TermWeights weights;
    weights.add(5, 7);
    weights.add(5 + 2 * kCoefficientCount, 11);
    EXPECT_EQ(weights.of(5), 7);
    EXPECT_EQ(weights.of(5 + 2 * kCoefficientCount), 11);
    EXPECT_EQ(weights.of(5 + 4 * kCoefficientCount), 0);
}

TEST(TermWeights, OfAKeyThatComesTwiceAreAdded) {
    TermWeights weights;
    weights.add(9, 2);
    weights.add(9, 3);
    EXPECT_EQ(weights.of(9), 5);
}

}  // namespace
}  // namespace haarmony::image
