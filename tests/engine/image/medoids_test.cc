#include "engine/image/medoids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#include "tests/engine/image/planted_clusters.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

InlineExecutor inline_executor;

std::vector<const Signature*> pointers(const std::vector<Signature>& signatures) {
    std::vector<const Signature*> result;
    for (const Signature& signature : signatures) result.push_back(&signature);
    return result;
}

SignatureBlocks blocks_of(const std::vector<Signature>& signatures,
                          const Profile& profile) {
    return {pointers(signatures), profile, inline_executor};
}

Medoids medoids_of(const std::vector<Signature>& signatures,
                   int count,
                   std::uint64_t seed,
                   int iterations = 20) {
    const Profile profile = *built_in_profile("painted");
    return find_medoids(blocks_of(signatures, profile),
                        profile,
                        count,
                        seed,
                        iterations,
                        inline_executor);
}

// The cost by its definition, pair by pair.
std::int64_t literal_cost(const std::vector<Signature>& signatures,
                          const std::vector<std::size_t>& medoids) {
    const Profile profile = *built_in_profile("painted");
    std::int64_t cost = 0;
    for (const Signature& signature : signatures) {
        std::int64_t nearest = std::numeric_limits<std::int64_t>::max();
        for (const std::size_t medoid : medoids) {
            nearest = std::min(
                nearest,
                relative_distance(signature, signatures[medoid], profile, profile.m));
        }
        cost += nearest;
    }
    return cost;
}

// The least cost of all choices of `count` medoids.
std::int64_t least_cost(const std::vector<Signature>& signatures, std::size_t count) {
    std::vector<int> chosen(signatures.size(), 0);
    std::fill_n(chosen.begin(), count, 1);
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    do {
        std::vector<std::size_t> medoids;
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            if (chosen[i] != 0) medoids.push_back(i);
        }
        least = std::min(least, literal_cost(signatures, medoids));
    } while (std::ranges::prev_permutation(chosen).found);
    return least;
}

std::vector<Signature> random_signatures(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::vector<Signature> signatures;
    for (int i = 0; i < count; ++i) {
        signatures.push_back(
            random_signature(random, {.max_count = 20, .max_index = 40}));
    }
    return signatures;
}

TEST(SignatureBlocks, NearestIsTheNearestOfAllWithTiesToTheEarlier) {
    // More than one block, and two centers alike, so that there are ties.
    std::mt19937 random(111);
    std::vector<Signature> signatures;
    for (int i = 0; i < 5000; ++i) {
        signatures.push_back(random_signature(
            random, {.max_count = 1, .max_index = 1, .average_steps = 2}));
    }
    signatures[2500] = signatures[17];
    const Profile profile = *built_in_profile("scanned");
    const SignatureBlocks blocks = blocks_of(signatures, profile);
    ASSERT_EQ(blocks.size(), 5000U);
    const std::vector<std::size_t> centers{4999, 17, 2500};
    std::vector<Query> queries;
    for (const std::size_t i : centers) {
        queries.push_back(make_query(signatures[i], profile, profile.m));
    }
    BackwardExecutor backward;
    const Nearest nearest = blocks.nearest(queries, backward);
    int ties = 0;
    for (std::size_t i = 0; i < signatures.size(); ++i) {
        std::vector<std::int64_t> distances;
        for (const std::size_t center : centers) {
            distances.push_back(
                relative_distance(signatures[i], signatures[center], profile, profile.m));
        }
        const auto least = std::ranges::min_element(distances);
        ties += std::ranges::count(distances, *least) > 1 ? 1 : 0;
        ASSERT_EQ(nearest.distance[i], *least) << i;
        ASSERT_EQ(nearest.center[i], std::size_t(least - distances.begin())) << i;
    }
    EXPECT_GT(ties, 0);
}

TEST(Medoids, OneMedoidIsTheBestOfAll) {
    for (const std::uint32_t seed : {1, 2, 3}) {
        const std::vector<Signature> signatures = random_signatures(seed, 40);
        const Medoids medoids = medoids_of(signatures, 1, seed);
        ASSERT_EQ(medoids.pictures.size(), 1U);
        EXPECT_EQ(literal_cost(signatures, medoids.pictures), least_cost(signatures, 1));
    }
}

TEST(Medoids, AreNeverBetterThanTheBestAndSeldomMuchWorse) {
    int optimal = 0;
    constexpr int kTrials = 20;
    for (int seed = 0; seed < kTrials; ++seed) {
        const std::vector<Signature> signatures = random_signatures(200 + seed, 10);
        const Medoids medoids = medoids_of(signatures, 3, seed);
        const std::int64_t least = least_cost(signatures, 3);
        const std::int64_t cost = literal_cost(signatures, medoids.pictures);
        EXPECT_GE(cost, least) << seed;
        EXPECT_LE(static_cast<double>(cost), 1.25 * static_cast<double>(least)) << seed;
        optimal += cost == least ? 1 : 0;
    }
    EXPECT_GE(optimal, kTrials / 4);
}

TEST(Medoids, FindPlantedGroupsAgain) {
    for (const std::uint32_t seed : {1, 2, 3, 4}) {
        std::mt19937 random(seed);
        const std::vector<Signature> signatures = planted_clusters(random, 5, 30);
        const Medoids medoids = medoids_of(signatures, 5, seed);
        ASSERT_EQ(medoids.pictures.size(), 5U);
        for (std::size_t group = 0; group < 5; ++group) {
            EXPECT_EQ(medoids.pictures[group] / 30, group) << seed;
        }
    }
}

TEST(Medoids, TheCostNeverGrowsAndIsTheOneReported) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const std::vector<Signature> signatures =
            random_signatures(static_cast<std::uint32_t>(300 + seed), 400);
        const Medoids medoids = medoids_of(signatures, 4, seed);
        ASSERT_GT(medoids.costs.size(), 1U);
        EXPECT_TRUE(std::ranges::is_sorted(medoids.costs, std::greater<>()));
        EXPECT_LT(medoids.costs.back(), medoids.costs.front());
        EXPECT_EQ(medoids.costs.back(), literal_cost(signatures, medoids.pictures));
        EXPECT_TRUE(std::ranges::is_sorted(medoids.pictures));
    }
}

TEST(Medoids, WithoutIterationsAreTheSeeds) {
    const std::vector<Signature> signatures = random_signatures(310, 50);
    const Medoids seeds = medoids_of(signatures, 4, 1, 0);
    EXPECT_EQ(seeds.costs.size(), 1U);
    EXPECT_EQ(seeds.costs.front(), literal_cost(signatures, seeds.pictures));
}

TEST(Medoids, AreAsManyAsThereAreDifferentPictures) {
    std::vector<Signature> signatures = random_signatures(311, 3);
    for (int i = 0; i < 12; ++i) signatures.push_back(signatures[i % 3]);
    const Medoids medoids = medoids_of(signatures, 10, 1);
    EXPECT_EQ(medoids.pictures.size(), 3U);
    EXPECT_EQ(medoids.costs.back(), 0);

    const std::vector<Signature> same(7, signatures[0]);
    EXPECT_EQ(medoids_of(same, 3, 1).pictures, (std::vector<std::size_t>{0}));
}

TEST(Medoids, DoNotDependOnWhatIsDoneFirst) {
    const std::vector<Signature> signatures = random_signatures(312, 500);
    const Profile profile = *built_in_profile("painted");
    BackwardExecutor backward;
    const SignatureBlocks blocks(pointers(signatures), profile, backward);
    const Medoids there = find_medoids(blocks, profile, 7, 9, 20, backward);
    const Medoids here = medoids_of(signatures, 7, 9);
    EXPECT_EQ(there.pictures, here.pictures);
    EXPECT_EQ(there.costs, here.costs);
}

TEST(Medoids, PicturesTooCloseToTellApartAreOne) {
    // Averages that differ by one step in 2^24, and weights beside which that is nothing.
    std::vector<Signature> signatures(3, random_signatures(313, 1)[0]);
    signatures[1].channels[0].average += 1;
    signatures[2].channels[0].average += 2;
    Profile profile = *built_in_profile("painted");
    profile.weights[0].fill(kMaxWeight);
    profile.weights[0][0] = 1;
    const Medoids medoids =
        find_medoids(blocks_of(signatures, profile), profile, 3, 1, 5, inline_executor);
    EXPECT_EQ(medoids.pictures.size(), 1U);
    EXPECT_EQ(medoids.costs.back(), 0);
}

TEST(Medoids, LargestDistancesDoNotOverflowTheirSum) {
    const Nearest nearest{std::vector<std::size_t>(kMaxSlots, 0),
                          std::vector<std::int64_t>(kMaxSlots, kMaxRelativeDistance)};
    EXPECT_EQ(nearest.cost(), std::int64_t{1} << 56);
}

}  // namespace
}  // namespace haarmony::image
