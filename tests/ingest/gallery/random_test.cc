#include "ingest/gallery/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace haarmony::gallery {
namespace {

TEST(Random, FollowsThePublishedSequence) {
    // The first values of splitmix64 from 1234567, as published with the algorithm.
    Random random(1234567);
    EXPECT_EQ(random.next(), 6457827717110365317ULL);
    EXPECT_EQ(random.next(), 3203168211198807973ULL);
    EXPECT_EQ(random.next(), 9817491932198370423ULL);
    EXPECT_EQ(random.next(), 4593380528125082431ULL);
    EXPECT_EQ(random.next(), 16408922859458223821ULL);
}

TEST(Random, UnitStaysBelowOneAndSpreadsEvenly) {
    Random random(1);
    std::vector<int> bins(16);
    constexpr int kDraws = 160'000;
    for (int i = 0; i < kDraws; ++i) {
        const double u = random.unit();
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        ++bins[static_cast<std::size_t>(u * 16)];
    }
    // Five deviations of a binomial count about 10000.
    for (const int count : bins) EXPECT_NEAR(count, kDraws / 16, 5 * 97);
}

TEST(Random, BelowReachesEveryValueEquallyOften) {
    Random random(2);
    std::vector<int> seen(7);
    for (int i = 0; i < 70'000; ++i) ++seen[static_cast<std::size_t>(random.below(7))];
    for (const int count : seen) EXPECT_NEAR(count, 10'000, 5 * 93);
    EXPECT_EQ(Random(3).below(1), 0);
}

TEST(Random, BellHasMeanZeroAndDeviationOne) {
    Random random(4);
    double sum = 0;
    double squares = 0;
    constexpr int kDraws = 100'000;
    for (int i = 0; i < kDraws; ++i) {
        const double x = random.bell();
        ASSERT_LE(std::fabs(x), 6);
        sum += x;
        squares += x * x;
    }
    EXPECT_NEAR(sum / kDraws, 0, 5 / std::sqrt(kDraws));
    EXPECT_NEAR(squares / kDraws, 1, 0.03);
}

TEST(Random, SeedsOfNeighboursHaveNothingInCommon) {
    std::set<std::uint64_t> seeds;
    int flipped = 0;
    for (std::uint64_t seed = 0; seed < 64; ++seed) {
        for (std::uint64_t stream = 0; stream < 64; ++stream) {
            const std::uint64_t value = mix_seeds(seed, stream);
            seeds.insert(value);
            std::uint64_t difference = value ^ mix_seeds(seed, stream + 1);
            for (; difference != 0; difference &= difference - 1) ++flipped;
        }
    }
    EXPECT_EQ(seeds.size(), 64U * 64U);
    EXPECT_NEAR(flipped / 4096.0, 32, 0.5) << "half of the 64 bits should flip";
}

}  // namespace
}  // namespace haarmony::gallery
