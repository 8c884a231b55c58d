// From a plan to rows: the indexes rank, one read of the database tells what the matches are.
//
// Threads const-safe; holds no lock while scoring.
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "schema/image_store.h"
#include "server/app/connection.h"
#include "server/app/search_plan.h"

namespace haarmony::server {

struct FoundImage {
    schema::Image image;
    Candidate match;
};

struct Found {
    std::vector<FoundImage> images;  // best first
    std::int64_t searched = 0;
    std::chrono::nanoseconds ranking{};  // what the indexes took, without the database
};

// The `limit` best matches. A picture that was deleted after the snapshots were taken is left
// out, and the next best takes its place. `executor` as SearchPlan::best().
// Requires: limit >= 1.
[[nodiscard]] Result<Found> search_images(const SearchPlan& plan,
                                          int limit,
                                          const image::IdSet* only,
                                          Executor* executor,
                                          ReadConnections& connections);

}  // namespace haarmony::server
