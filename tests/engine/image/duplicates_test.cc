#include "engine/image/duplicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace haarmony::image {
namespace {

constexpr auto kExact = DuplicateLevel::kExact;
constexpr auto kNear = DuplicateLevel::kNear;
constexpr auto kSimilar = DuplicateLevel::kSimilar;

DuplicatePair pair_of(std::int64_t a,
                      std::int64_t b,
                      DuplicateLevel level,
                      double similarity) {
    return {ImageId{a}, ImageId{b}, level, similarity};
}

DuplicateGroup group_of(const std::vector<std::int64_t>& ids,
                        DuplicateLevel level,
                        double similarity) {
    DuplicateGroup group{{}, level, similarity};
    for (const std::int64_t id : ids) group.ids.push_back(ImageId{id});
    return group;
}

TEST(Duplicates, LevelsAreNeverConflated) {
    EXPECT_EQ(level_of({.similarity = 1.0}), kNear);
    EXPECT_EQ(level_of({.similarity = 1.0, .same_bytes = true}), kExact);
    EXPECT_EQ(level_of({.similarity = kNearSimilarity}), kNear);
    EXPECT_EQ(level_of({.similarity = kNearSimilarity - 1e-9}), kSimilar);
    EXPECT_EQ(level_of({.similarity = kSimilarSimilarity}), kSimilar);
    EXPECT_EQ(level_of({.similarity = kSimilarSimilarity - 1e-9}), std::nullopt);
    EXPECT_EQ(level_of({.similarity = 0.0}), std::nullopt);
}

TEST(Duplicates, LowInformationIsExactOrNothing) {
    EXPECT_EQ(level_of({.similarity = 1.0, .low_information = true}), std::nullopt);
    EXPECT_EQ(level_of({.similarity = 0.0, .same_bytes = true, .low_information = true}),
              kExact);
}

TEST(Duplicates, LevelNamesRoundTrip) {
    for (const DuplicateLevel level : {kExact, kNear, kSimilar}) {
        EXPECT_EQ(duplicate_level_from_name(duplicate_level_name(level)), level);
    }
    EXPECT_EQ(duplicate_level_name(kNear), "near");
    EXPECT_EQ(duplicate_level_from_name("identical"), std::nullopt);
}

TEST(Duplicates, ProfileComparesAsManyCoefficientsAsTheIndexKeeps) {
    EXPECT_EQ(duplicate_profile().m, 60);
    EXPECT_EQ(duplicate_profile().weights, built_in_profile("scanned")->weights);
}

TEST(Duplicates, ChainsAreOneGroupAndGroupsAreInOrder) {
    const std::vector<DuplicatePair> pairs{pair_of(9, 8, kNear, 0.8),
                                           pair_of(1, 5, kSimilar, 0.5),
                                           pair_of(5, 3, kExact, 1.0),
                                           pair_of(2, 7, kExact, 1.0)};
    EXPECT_EQ(group_duplicates(pairs, {}, {}),
              (std::vector<DuplicateGroup>{group_of({1, 3, 5}, kSimilar, 0.5),
                                           group_of({2, 7}, kExact, 1.0),
                                           group_of({8, 9}, kNear, 0.8)}));
}

TEST(Duplicates, AWeakPairWithinAStrongGroupDoesNotWeakenIt) {
    const std::vector<DuplicatePair> pairs{pair_of(1, 2, kNear, 0.9),
                                           pair_of(2, 3, kNear, 0.8),
                                           pair_of(1, 3, kSimilar, 0.5)};
    EXPECT_EQ(group_duplicates(pairs, {}, {}),
              (std::vector<DuplicateGroup>{group_of({1, 2, 3}, kNear, 0.8)}));
}

TEST(Duplicates, APairGivenTwiceCountsWithItsBetterLevel) {
    const std::vector<DuplicatePair> pairs{pair_of(1, 2, kSimilar, 0.5),
                                           pair_of(2, 1, kNear, 0.7)};
    EXPECT_EQ(group_duplicates(pairs, {}, {}),
              (std::vector<DuplicateGroup>{group_of({1, 2}, kNear, 0.7)}));
}

TEST(Duplicates, IgnoredPairsDoNotConnect) {
    const std::vector<DuplicatePair> pairs{
        pair_of(1, 2, kNear, 0.9), pair_of(3, 2, kNear, 0.8), pair_of(4, 5, kNear, 0.8)};
    const std::vector<std::pair<ImageId, ImageId>> ignored{
        {ImageId{2}, ImageId{3}}, {ImageId{5}, ImageId{4}}, {ImageId{6}, ImageId{7}}};
    EXPECT_EQ(group_duplicates(pairs, ignored, {}),
              (std::vector<DuplicateGroup>{group_of({1, 2}, kNear, 0.9)}));
}

TEST(Duplicates, AnIgnoredPairMayMeetInAGroupThatOthersConnect) {
    const std::vector<DuplicatePair> pairs{
        pair_of(1, 2, kNear, 0.9), pair_of(2, 3, kNear, 0.8), pair_of(1, 3, kNear, 0.7)};
    const std::vector<std::pair<ImageId, ImageId>> ignored{{ImageId{1}, ImageId{3}}};
    EXPECT_EQ(group_duplicates(pairs, ignored, {}),
              (std::vector<DuplicateGroup>{group_of({1, 2, 3}, kNear, 0.8)}));
}

TEST(Duplicates, OptionsCutWhatIsBelowThem) {
    const std::vector<DuplicatePair> pairs{pair_of(1, 2, kExact, 1.0),
                                           pair_of(2, 3, kNear, 0.7),
                                           pair_of(4, 5, kSimilar, 0.5)};
    EXPECT_EQ(group_duplicates(pairs, {}, {.min_similarity = 0.7}),
              (std::vector<DuplicateGroup>{group_of({1, 2, 3}, kNear, 0.7)}));
    EXPECT_EQ(group_duplicates(pairs, {}, {.min_level = kExact}),
              (std::vector<DuplicateGroup>{group_of({1, 2}, kExact, 1.0)}));
    EXPECT_TRUE(group_duplicates(pairs, {}, {.min_similarity = 1.1}).empty());
}

TEST(Duplicates, NoPairsMakeNoGroups) {
    EXPECT_TRUE(group_duplicates({}, {}, {}).empty());
}

// Connected components by walking, and the best weakest pair by trying every threshold.
std::vector<DuplicateGroup> groups_by_walking(const std::vector<DuplicatePair>& pairs) {
    using Strength = std::pair<DuplicateLevel, double>;
    const auto walk = [&pairs](ImageId from, const Strength& least) {
        std::set<ImageId> reached{from};
        for (std::size_t before = 0; before != reached.size();) {
            before = reached.size();
            for (const DuplicatePair& pair : pairs) {
                if (Strength(pair.level, pair.similarity) < least) continue;
                if (reached.contains(pair.a)) reached.insert(pair.b);
                if (reached.contains(pair.b)) reached.insert(pair.a);
            }
        }
        return reached;
    };
    std::set<ImageId> left;
    std::set<Strength> strengths;
    for (const DuplicatePair& pair : pairs) {
        left.insert({pair.a, pair.b});
        strengths.emplace(pair.level, pair.similarity);
    }
    std::vector<DuplicateGroup> groups;
    while (!left.empty()) {
        const std::set<ImageId> all = walk(*left.begin(), *strengths.begin());
        Strength best = *strengths.begin();
        for (const Strength& strength : strengths) {
            if (walk(*left.begin(), strength) == all) best = strength;
        }
        groups.push_back({{all.begin(), all.end()}, best.first, best.second});
        for (const ImageId id : all) left.erase(id);
    }
    return groups;
}

TEST(Duplicates, GroupsAreThoseFoundByWalking) {
    std::mt19937 random(501);
    for (int trial = 0; trial < 30; ++trial) {
        std::vector<DuplicatePair> pairs;
        for (int i = 0; i < 20; ++i) {
            const auto a = std::int64_t(1 + random() % 20);
            const auto b = std::int64_t(1 + random() % 20);
            if (a == b) continue;
            // Similarities rise with the level, as they do by level_of().
            const auto level = static_cast<DuplicateLevel>(1 + random() % 3);
            const double within = static_cast<double>(random() % 5) / 50;
            pairs.push_back(pair_of(a, b, level, static_cast<int>(level) * 0.3 + within));
        }
        const auto groups = group_duplicates(pairs, {}, {});
        EXPECT_EQ(groups, groups_by_walking(pairs)) << trial;
        std::ranges::shuffle(pairs, random);
        EXPECT_EQ(group_duplicates(pairs, {}, {}), groups) << trial;
    }
}

}  // namespace
}  // namespace haarmony::image
