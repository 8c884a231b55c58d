#include "engine/image/metric.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

// Weights that say which term they belong to.
Profile telling_profile() {
    Profile profile;
    for (int c = 0; c < kChannels; ++c) {
        for (int b = 0; b < kBins; ++b) profile.weights[c][b] = 100 * (c + 1) + b;
    }
    return profile;
}

TEST(Metric, AddsUpEquation4_3ByHand) {
    Signature query;
    query.channels[0].average = 1000;
    query.channels[0].count = 3;
    query.channels[0].indices = {1, -128, 16383};  // (0, 1), (1, 0), (127, 127)
    query.channels[2].count = 1;
    query.channels[2].indices = {2};  // (0, 2)
    Signature target;
    target.channels[0].average = 1300;
    target.channels[0].count = 3;
    target.channels[0].indices = {1, 128, 50};
    target.channels[1].average = -7;

    // Average terms: 100 * 300 + 200 * 7. Coefficients that differ: (1, 0) by its sign,
    // (127, 127) and Q's (0, 2) by being absent; the target's own (0, 50) does not count.
    const std::int64_t expected =
        100 * 300 + 200 * 7 + (101 + 105 + 302) * std::int64_t{1 << 24};
    EXPECT_EQ(metric(query, target, telling_profile(), 100), expected);
}

TEST(Metric, CutsQueryAndTargetAlike) {
    Signature query;
    query.channels[0].count = 2;
    query.channels[0].indices = {1, 2};
    Signature target;
    target.channels[0].count = 2;
    target.channels[0].indices = {2, 1};
    EXPECT_EQ(metric(query, target, telling_profile(), 2), 0);
    EXPECT_EQ(metric(query, target, telling_profile(), 1), 101 * kAverageOne);
}

TEST(Metric, OfAPictureWithItselfIs0) {
    std::mt19937 random(71);
    for (int i = 0; i < 20; ++i) {
        const Signature signature = random_signature(random, {});
        for (const int m : {1, 40, 100}) {
            EXPECT_EQ(metric(signature, signature, telling_profile(), m), 0);
        }
    }
}

}  // namespace
}  // namespace haarmony::image
