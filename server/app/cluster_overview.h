// A collection without a query: groups of pictures that resemble each other, each with one
// that stands for it.
//
//   schema/image_store -> [cluster_overview] -> engine/image/clusters
//
// Scale   reads every signature of the profile's kind: 0.7 kB of memory for each picture
//         while it works. One overview is made at a time; the last few are kept until the
//         collection changes, but those of a filter, which changes unseen.
// Errors  as ImageStore. No picture of the profile's kind: no clusters.
// Threads every member from any thread.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "engine/image/clusters.h"
#include "engine/image/profile.h"
#include "schema/image_store.h"
#include "server/app/connection.h"
#include "server/app/index_follower.h"
#include "server/app/thread_executor.h"

namespace haarmony::server {

struct OverviewOptions {
    image::Profile profile;
    int count = 12;  // of clusters, >= 1
    std::uint64_t seed = 1;
    schema::ImageFilter filter;  // only pictures that match it; empty: all
    int members = 12;            // that are described of each cluster, >= 0
};

struct OverviewCluster {
    schema::Image representative;
    bool low_information = false;
    std::int64_t size = 0;
    std::vector<schema::Image>
        members;  // the nearest to the representative, which is first
};

struct Overview {
    std::vector<OverviewCluster> clusters;  // as image::Clustering has them
    double cost = 0;
    std::int64_t searched = 0;  // pictures in all clusters
};

class ClusterOverview {
  public:
    // `threads` beside the callers work for it. Requires: the follower outlives it.
    ClusterOverview(const std::string& database_path,
                    const IndexFollower& follower,
                    int threads);

    [[nodiscard]] Result<Overview> make(const OverviewOptions& options);

    // How often clusters were sought, rather than taken from those that are kept.
    [[nodiscard]] std::int64_t computed();

  private:
    struct Kept {
        std::string key;
        std::shared_ptr<const image::Clustering> clustering;
    };

    [[nodiscard]] Result<std::shared_ptr<const image::Clustering>> clustering(
        const OverviewOptions& options,
        schema::ImageStore& images);

    const IndexFollower& follower_;
    ReadConnections readers_;
    ThreadExecutor executor_;
    std::mutex mutex_;  // guards kept_ and computed_; held while clusters are sought
    std::deque<Kept> kept_;
    std::int64_t computed_ = 0;
};

}  // namespace haarmony::server
