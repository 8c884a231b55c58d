#include "engine/image/clusters.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <iterator>
#include <random>

#include "engine/image/medoids.h"
#include "engine/image/random_order.h"

namespace haarmony::image {
namespace {

static_assert(kMaxClusterSample == kMaxSlots);

// How many pictures have their lists in memory at once while all are assigned.
constexpr std::size_t kAssignedAtOnce = 65'536;

using Records = std::vector<const Record*>;

std::vector<const Signature*> signatures_of(std::span<const Record* const> records) {
    std::vector<const Signature*> signatures;
    signatures.reserve(records.size());
    for (const Record* record : records) signatures.push_back(&record->signature);
    return signatures;
}

// In order of their ids. Requires: `records` are.
Records sample_of(const Records& records, const ClusterOptions& options) {
    if (records.size() <= std::size_t(options.sample)) return records;
    Records sample = records;
    std::mt19937_64 random(options.seed);
    draw_to_front(random, std::span(sample), std::size_t(options.sample));
    sample.resize(std::size_t(options.sample));
    std::ranges::sort(sample, {}, &Record::id);
    return sample;
}

// Clusters of `records`, which are in order of their ids.
std::vector<Cluster> cluster(const Records& records,
                             const Profile& profile,
                             const ClusterOptions& options,
                             Executor& executor) {
    if (records.empty()) return {};
    const Records sample = sample_of(records, options);
    const Medoids medoids =
        find_medoids(SignatureBlocks(signatures_of(sample), profile, executor),
                     profile,
                     options.count,
                     options.seed,
                     options.iterations,
                     executor);
    std::vector<Cluster> clusters;
    std::vector<Query> queries;
    for (const std::size_t i : medoids.pictures) {
        clusters.push_back({sample[i]->id, sample[i]->signature.low_information, {}});
        queries.push_back(make_query(sample[i]->signature, profile, profile.m));
    }
    for (std::size_t begin = 0; begin < records.size(); begin += kAssignedAtOnce) {
        const auto part = std::span<const Record* const>(records).subspan(
            begin, std::min(kAssignedAtOnce, records.size() - begin));
        const Nearest nearest = SignatureBlocks(signatures_of(part), profile, executor)
                                    .nearest(queries, executor);
        for (std::size_t i = 0; i < part.size(); ++i) {
            clusters[nearest.center[i]].members.push_back(
                {part[i]->id,
                 static_cast<double>(nearest.distance[i]) / double{kAverageOne}});
        }
    }
    // A medoid that is not told apart from an earlier one has no members of its own.
    std::erase_if(clusters, [](const Cluster& each) { return each.members.empty(); });
    for (Cluster& each : clusters) {
        std::ranges::sort(each.members, {}, [](const ClusterMember& member) {
            return std::pair(member.distance, member.id);
        });
    }
    std::ranges::sort(clusters, {}, [](const Cluster& each) {
        return std::pair(-std::ptrdiff_t(each.members.size()), each.medoid);
    });
    return clusters;
}

}  // namespace

Clustering find_clusters(std::span<const Record> records,
                         const Profile& profile,
                         const ClusterOptions& options,
                         Executor& executor) {
    assert(options.count >= 1 && options.iterations >= 0);
    assert(options.sample >= 1 && options.sample <= kMaxClusterSample);
    Records telling;
    Records low_information;
    for (const Record& record : records) {
        assert(record.signature.kind == profile.kind);
        (record.signature.low_information ? low_information : telling).push_back(&record);
    }
    std::ranges::sort(telling, {}, &Record::id);
    std::ranges::sort(low_information, {}, &Record::id);

    Clustering clustering;
    clustering.clusters = cluster(telling, profile, options, executor);
    ClusterOptions one = options;
    one.count = 1;
    std::ranges::move(cluster(low_information, profile, one, executor),
                      std::back_inserter(clustering.clusters));
    for (const Cluster& each : clustering.clusters) {
        for (const ClusterMember& member : each.members) {
            clustering.cost += member.distance;
        }
    }
    return clustering;
}

}  // namespace haarmony::image
