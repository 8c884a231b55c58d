#include "engine/image/term_weights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "tests/engine/image/each_target.h"

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

// Different signed indices, none of an average; `shared` are among them.
std::vector<std::int16_t> random_indices(std::size_t count,
                                         std::span<const std::int16_t> shared,
                                         std::mt19937& random) {
    std::set<std::int16_t> drawn(shared.begin(), shared.end());
    while (drawn.size() < count) {
        const auto index =
            static_cast<std::int16_t>(1 + random() % (kCoefficientCount - 1));
        drawn.insert(random() % 2 == 0 ? index : std::int16_t(-index));
    }
    std::vector<std::int16_t> indices(drawn.begin(), drawn.end());
    std::ranges::shuffle(indices, random);
    return indices;
}

// Vectors of 8 and of 16, what is left over, and more than are sieved at once. The indices
// end with their memory, so that a sanitizer sees whoever reads on.
TEST(TermWeights, SumIsThatOfEachIndexOnEveryTarget) {
    std::mt19937 random(532);
    for (const std::size_t terms : {1U, 27U, 100U}) {
        TermWeights weights;
        std::array<std::vector<std::int16_t>, kChannels> asked;
        std::array<std::map<int, std::int64_t>, kChannels> expected;
        for (int c = 0; c < kChannels; ++c) {
            asked[c] = random_indices(terms, {}, random);
            for (const std::int16_t index : asked[c]) {
                const auto weight = static_cast<std::int32_t>(random() % 4000);
                weights.add(coefficient_key(c, index), weight);
                expected[c][index] = weight;
            }
        }
        for (std::size_t count = 0; count <= kMaxCoefficients; ++count) {
            for (int c = 0; c < kChannels; ++c) {
                const auto shared =
                    std::span(asked[c]).first(random() % (std::min(terms, count) + 1));
                const auto indices = random_indices(count, shared, random);
                std::int64_t sum = 0;
                for (const std::int16_t index : indices) {
                    const auto found = expected[c].find(index);
                    sum += found == expected[c].end() ? 0 : found->second;
                }
                ASSERT_EQ(weights.sum_scalar(c, indices), sum);
                for_each_target([&](const char* name) {
                    ASSERT_EQ(weights.sum(c, indices), sum)
                        << name << ", " << count << " indices, channel " << c;
                });
            }
        }
    }
}

TEST(TermWeights, SumFindsEveryIndexThatIsAskedFor) {
    for (int index = 1; index < kCoefficientCount; ++index) {
        TermWeights weights;
        const auto negative = static_cast<std::int16_t>(-index);
        weights.add(coefficient_key(2, negative), 7);
        std::vector<std::int16_t> indices(16, static_cast<std::int16_t>(index));
        ASSERT_EQ(weights.sum(2, indices), 0) << index;
        indices[std::size_t(index) % indices.size()] = negative;
        ASSERT_EQ(weights.sum(2, indices), 7) << index;
        ASSERT_EQ(weights.sum(1, indices), 0) << index;
    }
}

// What an index of weight does not have must not pass by chance too often: the sieve is
// what makes a sum cheap.
TEST(IndexSieve, LetsFewOthersPass) {
    std::mt19937 random(533);
    IndexSieve sieve;
    const auto asked = random_indices(40, {}, random);
    for (const std::int16_t index : asked) sieve.add(index);
    int passed = 0;
    for (int index = -kCoefficientCount + 1; index < kCoefficientCount; ++index)
        passed += sieve.may_have(static_cast<std::int16_t>(index)) ? 1 : 0;
    EXPECT_GE(passed, 40);
    EXPECT_LT(passed, 2 * kCoefficientCount / 25);
    for (const std::int16_t index : asked) EXPECT_TRUE(sieve.may_have(index)) << index;
}

}  // namespace
}  // namespace haarmony::image
