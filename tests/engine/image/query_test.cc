#include "engine/image/query.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "engine/image/metric.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

Signature one_term() {
    Signature signature;
    signature.channels[1].average = 1 << 20;
    signature.channels[1].count = 1;
    signature.channels[1].indices = {-130};  // (1, 2)
    return signature;
}

// The score of one target, from the terms of the query and the target's lists.
Score score_of(const Query& query, const Signature& target) {
    std::set<std::uint32_t> keys;
    std::array<std::int32_t, kChannels> average{};
    for (int c = 0; c < kChannels; ++c) {
        average[c] = target.channels[c].average;
        for (const std::int16_t index : target.channels[c].largest(query.m)) {
            keys.insert(coefficient_key(c, index));
        }
    }
    std::int64_t matched = 0;
    for (const QueryTerm& term : query.terms) {
        if (keys.contains(term.key)) matched += term.weight;
    }
    return score(query, average, 0, matched);
}

TEST(CoefficientKey, IsDifferentForEverySignChannelAndPlace) {
    std::vector<bool> seen(kKeyCount);
    for (int c = 0; c < kChannels; ++c) {
        for (int index = 1; index < kCoefficientCount; ++index) {
            for (const int signed_index : {index, -index}) {
                const std::uint32_t key = coefficient_key(c, signed_index);
                ASSERT_LT(key, std::uint32_t{kKeyCount});
                ASSERT_FALSE(seen[key]);
                seen[key] = true;
            }
        }
    }
}

TEST(Query, HasTheTermsOfTheSignature) {
    const Profile profile = *built_in_profile("painted");
    const Query query = make_query(one_term(), profile, 60);
    EXPECT_EQ(query.m, 60);
    ASSERT_EQ(query.terms.size(), 1U);
    EXPECT_EQ(query.terms[0].key, std::uint32_t{3 * 16384 + 130});
    EXPECT_EQ(query.terms[0].weight, profile.weights[1][2]);
    EXPECT_EQ(query.weight_sum, profile.weights[1][2]);
    EXPECT_EQ(query.average[1], 1 << 20);
    EXPECT_EQ(query.average_weight[2], profile.weights[2][0]);
}

TEST(Query, CutsTheSignature) {
    std::mt19937 random(81);
    Signature signature = random_signature(random, {});
    signature.channels[0].count = 100;
    for (int i = 0; i < 100; ++i) signature.channels[0].indices[i] = std::int16_t(i + 1);
    for (const int m : {1, 7, 60, 100}) {
        const Query query = make_query(signature, *built_in_profile("scanned"), m);
        std::size_t expected = 0;
        for (const ChannelSignature& channel : signature.channels) {
            expected += std::size_t(std::min<int>(m, channel.count));
        }
        EXPECT_EQ(query.terms.size(), expected) << m;
    }
}

TEST(Query, DistanceOfAScoreIsTheMetric) {
    std::mt19937 random(82);
    const SignatureShape shape{.max_count = 30, .max_index = 60};
    for (const char* name : {"painted", "scanned"}) {
        const Profile profile = *built_in_profile(name);
        for (int i = 0; i < 20; ++i) {
            const Signature q = random_signature(random, shape);
            const Signature t = random_signature(random, shape);
            for (const int m : {1, 10, 100}) {
                const Query query = make_query(q, profile, m);
                const std::int64_t expected = metric(q, t, profile, m);
                const Score found = score_of(query, t);
                EXPECT_EQ(found + query.weight_sum * kAverageOne, expected);
                EXPECT_DOUBLE_EQ(distance(query, found),
                                 double(expected) / (100.0 * double(kAverageOne)));
            }
        }
    }
}

TEST(Query, SimilarityFallsFrom1To0) {
    const Profile profile = *built_in_profile("painted");
    const Query query = make_query(one_term(), profile, 60);
    const Score itself = score_of(query, one_term());
    EXPECT_EQ(distance(query, itself), 0.0);
    EXPECT_EQ(similarity(query, itself), 1.0);

    Signature same_color;
    same_color.channels[1].average = 1 << 20;
    EXPECT_EQ(similarity(query, score_of(query, same_color)), 0.0);

    Signature half = one_term();  // half of the weight of the one term away in colour
    half.channels[1].average += static_cast<std::int32_t>(query.weight_sum * kAverageOne /
                                                          (2 * profile.weights[1][0]));
    // The division rounds by less than one weight of the average in weight_sum * 2^24.
    EXPECT_NEAR(similarity(query, score_of(query, half)), 0.5, 1e-5);

    Signature far;
    far.channels[1].average = -(1 << 23);
    EXPECT_EQ(similarity(query, score_of(query, far)), 0.0);
}

TEST(Query, WithoutCoefficientsOnlyTheSameColorIsSimilar) {
    const Query query = make_query(Signature{}, *built_in_profile("painted"), 60);
    EXPECT_EQ(similarity(query, score_of(query, Signature{})), 1.0);
    Signature other;
    other.channels[0].average = 1;
    EXPECT_EQ(similarity(query, score_of(query, other)), 0.0);
    EXPECT_EQ(similarity(query, score_of(query, one_term())), 0.0);
}

}  // namespace
}  // namespace haarmony::image
