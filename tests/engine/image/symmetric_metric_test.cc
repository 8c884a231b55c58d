#include "engine/image/symmetric_metric.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/image/metric.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

std::vector<Signature> random_signatures(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::vector<Signature> signatures;
    for (int i = 0; i < count; ++i) {
        signatures.push_back(random_signature(random, {.max_index = 400}));
    }
    return signatures;
}

std::vector<const Signature*> pointers(const std::vector<Signature>& signatures) {
    std::vector<const Signature*> result;
    for (const Signature& signature : signatures) result.push_back(&signature);
    return result;
}

TEST(SymmetricMetric, IsTheSumOfBothDirectionsOfEquation4_3) {
    const std::vector<Signature> signatures = random_signatures(81, 12);
    for (const char* name : {"painted", "scanned"}) {
        const Profile profile = *built_in_profile(name);
        for (const int m : {1, 7, 40, 100}) {
            for (const Signature& a : signatures) {
                for (const Signature& b : signatures) {
                    EXPECT_EQ(symmetric_distance(a, b, profile, m),
                              metric(a, b, profile, m) + metric(b, a, profile, m));
                }
            }
        }
    }
}

TEST(SymmetricMetric, IsZeroFromAPictureToItself) {
    for (const Signature& a : random_signatures(82, 10)) {
        EXPECT_EQ(symmetric_distance(a, a, *built_in_profile("painted"), 60), 0);
    }
}

// The weights of all coefficients of a picture: its distance to one without any.
std::int64_t weights_of(const Signature& signature, const Profile& profile) {
    Signature nothing;
    for (int c = 0; c < kChannels; ++c) {
        nothing.channels[c].average = signature.channels[c].average;
    }
    return metric(signature, nothing, profile, profile.m) / kAverageOne;
}

TEST(SymmetricMetric, RelativeIsAPartOfTheWeightsOfBoth) {
    const std::vector<Signature> signatures = random_signatures(86, 20);
    const Profile profile = *built_in_profile("painted");
    const SignatureBlock block(pointers(signatures), profile);
    std::vector<std::int64_t> distances(signatures.size());
    for (const Signature& a : signatures) {
        block.relative_distances(make_query(a, profile, profile.m), distances);
        for (std::size_t i = 0; i < signatures.size(); ++i) {
            const Signature& b = signatures[i];
            const std::int64_t both =
                metric(a, b, profile, profile.m) + metric(b, a, profile, profile.m);
            const std::int64_t expected =
                both / (weights_of(a, profile) + weights_of(b, profile));
            EXPECT_EQ(relative_distance(a, b, profile, profile.m), expected);
            EXPECT_EQ(distances[i], expected);
        }
    }
}

TEST(SymmetricMetric, RelativeOfNothingInCommonIsOne) {
    Signature a;
    a.channels[0].count = 2;
    a.channels[0].indices = {1, 2};
    Signature b;
    b.channels[1].count = 1;
    b.channels[1].indices = {-1};
    const Profile profile = *built_in_profile("painted");
    EXPECT_EQ(relative_distance(a, b, profile, 60), kAverageOne);
    EXPECT_EQ(relative_distance(a, a, profile, 60), 0);
}

TEST(SymmetricMetric, RelativeWithoutCoefficientsIsAllOrNothing) {
    const Profile profile = *built_in_profile("painted");
    Signature flat;
    Signature other;
    other.channels[2].average = 1;
    EXPECT_EQ(relative_distance(flat, flat, profile, 60), 0);
    EXPECT_EQ(relative_distance(flat, other, profile, 60), kMaxRelativeDistance);
    // Hardly any weight and a large difference of averages: no larger.
    Profile top_heavy;
    top_heavy.weights[0] = {kMaxWeight, 1, 0, 0, 0, 0};
    flat.channels[0].average = kAverageOne;
    flat.channels[0].count = 1;
    flat.channels[0].indices = {1};
    other.channels[0].average = -kAverageOne;
    EXPECT_EQ(relative_distance(flat, other, top_heavy, 60), kMaxRelativeDistance);
}

TEST(SymmetricMetric, AnOddSumIsKept) {
    Signature a;
    a.channels[0].count = 1;
    a.channels[0].indices = {1};
    Profile profile;
    profile.weights[0] = {1, 1, 0, 0, 0, 0};
    Signature b;
    b.channels[0].average = 1;
    // One direction misses the coefficient, the other has none: 2^24 + 1 and 1.
    EXPECT_EQ(symmetric_distance(a, b, profile, 60), kAverageOne + 2);
    b.channels[0].average = 0;
    profile.weights[0][1] = 3;
    EXPECT_EQ(symmetric_distance(a, b, profile, 60), 3 * kAverageOne);
}

TEST(SymmetricMetric, SimilarityIsTheLesserOfBothWays) {
    const Profile profile = *built_in_profile("painted");
    std::vector<Signature> signatures = random_signatures(83, 12);
    // A picture with nothing but one coefficient that others have, too.
    Signature bare;
    for (int c = 0; c < kChannels; ++c) {
        bare.channels[c].average = signatures[0].channels[c].average;
    }
    bare.channels[0].count = 1;
    bare.channels[0].indices[0] = signatures[0].channels[0].indices[0];
    ASSERT_GT(signatures[0].channels[0].count, 1);
    signatures.push_back(bare);

    for (const Signature& a : signatures) {
        for (const Signature& b : signatures) {
            const auto one_way = [&profile](const Signature& from, const Signature& to) {
                const Query query = make_query(from, profile, 40);
                return similarity(
                    query,
                    metric(from, to, profile, 40) - query.weight_sum * kAverageOne);
            };
            EXPECT_EQ(mutual_similarity(a, b, profile, 40),
                      std::min(one_way(a, b), one_way(b, a)));
        }
    }
    EXPECT_LT(mutual_similarity(bare, signatures[0], profile, 40), 0.5);
    EXPECT_EQ(mutual_similarity(bare, bare, profile, 40), 1);
}

TEST(SignatureBlock, ComparesAllSlotsAsTheMetricDoes) {
    const std::vector<Signature> signatures = random_signatures(84, 60);
    for (const int m : {3, 40}) {
        Profile profile = *built_in_profile("scanned");
        profile.m = m;
        const SignatureBlock block(pointers(signatures), profile);
        ASSERT_EQ(block.size(), 60);
        std::vector<Score> scores(60);
        std::vector<std::int64_t> distances(60);
        for (const Signature& from : random_signatures(85, 8)) {
            const Query query = make_query(from, profile, m);
            block.score(query, scores);
            block.symmetric_distances(query, distances);
            for (std::size_t i = 0; i < signatures.size(); ++i) {
                const std::int64_t there = metric(from, signatures[i], profile, m);
                EXPECT_EQ(scores[i] + query.weight_sum * kAverageOne, there);
                EXPECT_EQ(distances[i], there + metric(signatures[i], from, profile, m));
            }
        }
    }
}

TEST(SignatureBlock, MayBeEmpty) {
    const Profile profile = *built_in_profile("scanned");
    const SignatureBlock block({}, profile);
    EXPECT_EQ(block.size(), 0);
    block.score(make_query({}, profile, profile.m), {});
}

}  // namespace
}  // namespace haarmony::image
