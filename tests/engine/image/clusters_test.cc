#include "engine/image/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "engine/image/metric.h"
#include "tests/engine/image/planted_clusters.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

Profile small_profile() {
    Profile profile = *built_in_profile("painted");
    profile.m = 20;
    return profile;
}

std::vector<Record> records_of(const std::vector<Signature>& signatures) {
    std::vector<Record> records;
    for (const Signature& signature : signatures) {
        records.push_back({ImageId{std::int64_t(records.size() * 3 + 10)}, signature});
    }
    return records;
}

std::vector<Record> random_records(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::vector<Signature> signatures;
    for (int i = 0; i < count; ++i) {
        signatures.push_back(
            random_signature(random, {.max_count = 20, .max_index = 60}));
    }
    return records_of(signatures);
}

Clustering clusters_of(const std::vector<Record>& records,
                       const ClusterOptions& options) {
    InlineExecutor executor;
    return find_clusters(records, small_profile(), options, executor);
}

// What must hold of every clustering, by the definition of the metric.
void expect_sound(const Clustering& clustering, const std::vector<Record>& records) {
    std::map<ImageId, const Signature*> signatures;
    for (const Record& record : records) signatures[record.id] = &record.signature;
    const Profile profile = small_profile();
    const auto weights_of = [&](const Signature& signature) {
        Signature nothing;
        for (int c = 0; c < kChannels; ++c) {
            nothing.channels[c].average = signature.channels[c].average;
        }
        return metric(signature, nothing, profile, profile.m) / (1 << 24);
    };
    const auto distance = [&](ImageId a, ImageId b) {
        const Signature& one = *signatures.at(a);
        const Signature& other = *signatures.at(b);
        const std::int64_t both = metric(one, other, profile, profile.m) +
                                  metric(other, one, profile, profile.m);
        const std::int64_t weights = weights_of(one) + weights_of(other);
        return static_cast<double>(both / weights) / (1 << 24);
    };
    std::map<ImageId, int> seen;
    double cost = 0;
    for (const Cluster& cluster : clustering.clusters) {
        ASSERT_FALSE(cluster.members.empty());
        EXPECT_EQ(cluster.members.front().distance, 0);
        EXPECT_TRUE(
            std::ranges::is_sorted(cluster.members, {}, [](const ClusterMember& member) {
                return std::pair(member.distance, member.id);
            }));
        for (const ClusterMember& member : cluster.members) {
            ++seen[member.id];
            cost += member.distance;
            EXPECT_DOUBLE_EQ(member.distance, distance(member.id, cluster.medoid));
            EXPECT_EQ(signatures.at(member.id)->low_information, cluster.low_information);
            for (const Cluster& other : clustering.clusters) {
                if (other.low_information != cluster.low_information) continue;
                EXPECT_LE(member.distance, distance(member.id, other.medoid) + 1e-9);
            }
        }
    }
    EXPECT_EQ(seen.size(), records.size());
    for (const auto& [id, times] : seen) EXPECT_EQ(times, 1) << to_int(id);
    EXPECT_NEAR(clustering.cost, cost, 1e-9 * cost);
}

TEST(Clusters, EveryPictureIsWithItsNearestMedoid) {
    const std::vector<Record> records = random_records(401, 80);
    const Clustering clustering = clusters_of(records, {.count = 5});
    EXPECT_EQ(clustering.clusters.size(), 5U);
    expect_sound(clustering, records);
    EXPECT_TRUE(
        std::ranges::is_sorted(clustering.clusters, {}, [](const Cluster& cluster) {
            return std::pair(-std::ptrdiff_t(cluster.members.size()), cluster.medoid);
        }));
}

TEST(Clusters, FindPlantedGroupsAgain) {
    std::mt19937 random(402);
    const std::vector<Record> records = records_of(planted_clusters(random, 6, 20));
    InlineExecutor executor;
    const Clustering clustering =
        find_clusters(records, *built_in_profile("painted"), {.count = 6}, executor);
    ASSERT_EQ(clustering.clusters.size(), 6U);
    for (const Cluster& cluster : clustering.clusters) {
        ASSERT_EQ(cluster.members.size(), 20U);
        const auto group = [](ImageId id) { return (to_int(id) - 10) / 3 / 20; };
        for (const ClusterMember& member : cluster.members) {
            EXPECT_EQ(group(member.id), group(cluster.medoid));
        }
    }
}

TEST(Clusters, DoNotDependOnTheOrderOfTheRecordsOrOfTheWork) {
    std::vector<Record> records = random_records(403, 120);
    const Clustering clustering = clusters_of(records, {.count = 7, .seed = 3});
    std::ranges::reverse(records);
    BackwardExecutor backward;
    EXPECT_EQ(find_clusters(records, small_profile(), {.count = 7, .seed = 3}, backward),
              clustering);
    EXPECT_NE(clusters_of(records, {.count = 7, .seed = 4}), clustering);
}

TEST(Clusters, OfALargerCollectionAreSoughtAmongASample) {
    const std::vector<Record> records = random_records(404, 150);
    const Clustering clustering = clusters_of(records, {.count = 4, .sample = 30});
    EXPECT_EQ(clustering.clusters.size(), 4U);
    expect_sound(clustering, records);
    EXPECT_EQ(clusters_of(records, {.count = 4, .sample = 30}), clustering);
    // With a sample of as many as there are clusters, the sample is the medoids.
    EXPECT_EQ(clusters_of(records, {.count = 4, .sample = 4}).clusters.size(), 4U);
}

TEST(Clusters, OneClusterHoldsAll) {
    const std::vector<Record> records = random_records(405, 30);
    const Clustering clustering = clusters_of(records, {.count = 1});
    ASSERT_EQ(clustering.clusters.size(), 1U);
    EXPECT_EQ(clustering.clusters[0].members.size(), 30U);
    expect_sound(clustering, records);
}

TEST(Clusters, MoreThanPicturesAreOneEach) {
    const std::vector<Record> records = random_records(406, 6);
    const Clustering clustering = clusters_of(records, {.count = 50});
    EXPECT_EQ(clustering.clusters.size(), 6U);
    EXPECT_EQ(clustering.cost, 0);
    expect_sound(clustering, records);
}

TEST(Clusters, IdenticalPicturesAreOneClusterWithTheSmallestId) {
    const std::vector<Signature> same(9, random_records(407, 1)[0].signature);
    const Clustering clustering = clusters_of(records_of(same), {.count = 4});
    ASSERT_EQ(clustering.clusters.size(), 1U);
    EXPECT_EQ(clustering.clusters[0].medoid, ImageId{10});
    EXPECT_EQ(clustering.clusters[0].members.size(), 9U);
}

TEST(Clusters, NothingMakesNone) { EXPECT_EQ(clusters_of({}, {}), Clustering{}); }

TEST(Clusters, LowInformationIsAClusterOfItsOwn) {
    std::vector<Record> records = random_records(408, 40);
    for (std::size_t i = 0; i < 25; ++i) {
        records[i].signature.low_information = true;
    }
    const Clustering clustering = clusters_of(records, {.count = 3});
    ASSERT_EQ(clustering.clusters.size(), 4U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_FALSE(clustering.clusters[i].low_information);
    }
    // Last, although it is the largest.
    EXPECT_TRUE(clustering.clusters[3].low_information);
    EXPECT_EQ(clustering.clusters[3].members.size(), 25U);
    expect_sound(clustering, records);
}

TEST(Clusters, OfLowInformationAloneAreOne) {
    std::vector<Record> records = random_records(409, 5);
    for (Record& record : records) record.signature.low_information = true;
    const Clustering clustering = clusters_of(records, {.count = 3});
    ASSERT_EQ(clustering.clusters.size(), 1U);
    EXPECT_TRUE(clustering.clusters[0].low_information);
    expect_sound(clustering, records);
}

}  // namespace
}  // namespace haarmony::image
