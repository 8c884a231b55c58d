// An overview of a collection: groups of pictures that resemble each other, each with one
// that stands for it:
//   record.h -> medoids.h -> [clusters.h]
//
// Pictures with next to no information resemble everything a little and each other too
// much; they make one cluster of their own, beside the ones that were asked for.
//
// Units   distances are the mean of both directions as a part of the weights: 0 for alike,
//         1 for nothing in common (relative_distance() in symmetric_metric.h).
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads as medoids.h.
// Source  ours: a collection without a query.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/ids.h"
#include "engine/image/profile.h"
#include "engine/image/record.h"

namespace haarmony::image {

// The most pictures that medoids are sought among.
inline constexpr int kMaxClusterSample = 65'536;

struct ClusterOptions {
    int count = 20;  // of clusters, >= 1; fewer where there are fewer different pictures
    std::uint64_t seed = 1;
    int iterations = 10;  // at most, >= 0
    int sample = 20'000;  // of a larger collection: medoids are sought among so many,
                          // then all are assigned; 1 to kMaxClusterSample
};

struct ClusterMember {
    ImageId id{};
    double distance = 0;  // from the medoid
    friend bool operator==(const ClusterMember&, const ClusterMember&) = default;
};

struct Cluster {
    ImageId medoid{};
    bool low_information = false;        // the cluster of such pictures
    std::vector<ClusterMember> members;  // the medoid, too; by distance, then by id
    friend bool operator==(const Cluster&, const Cluster&) = default;
};

struct Clustering {
    // The largest first, ties to the smaller medoid; that of low information last.
    std::vector<Cluster> clusters;
    double cost = 0;  // the sum of all distances
    friend bool operator==(const Clustering&, const Clustering&) = default;
};

// Every record is in exactly one cluster; no records make no clusters. The order of the
// records does not matter.
// Requires: ids differ; every signature is of the profile's kind.
[[nodiscard]] Clustering find_clusters(std::span<const Record> records,
                                       const Profile& profile,
                                       const ClusterOptions& options,
                                       Executor& executor);

}  // namespace haarmony::image
