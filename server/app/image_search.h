// From a query to rows: the index ranks, one read of the database tells what the matches
// are.
//
// Threads const-safe; holds no lock while scoring.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/image/index.h"
#include "engine/image/query.h"
#include "schema/image_store.h"
#include "server/app/connection.h"

namespace haarmony::server {

struct FoundImage {
    schema::Image image;
    double distance = 0;    // equation (4.3)
    double similarity = 0;  // 0..1
};

struct Found {
    std::vector<FoundImage> images;  // best first
    std::int64_t searched = 0;
};

// The `limit` best matches that are at least `min_similarity` similar. A picture that was
// deleted after the snapshot was taken is left out, and the next best takes its place.
// Requires: query.m <= the index's m; limit >= 1.
[[nodiscard]] Result<Found> search_images(const image::IndexSnapshot& snapshot,
                                          const image::Query& query,
                                          int limit,
                                          std::optional<double> min_similarity,
                                          ReadConnections& connections);

}  // namespace haarmony::server
