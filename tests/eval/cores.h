// What more cores are worth to searches: many at a time, and one that is alone.
//
// Units   wall time: the machine should be idle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/index.h"
#include "engine/image/query.h"

namespace haarmony::eval {

struct CoresRow {
    std::int64_t images = 0;
    int threads = 0;
    double queries_per_second = 0;  // each thread answers one query after the other
    double alone_ms = 0;            // of one query that all threads share, median
    std::int64_t mismatches = 0;    // answers that differ from those of one thread alone
};

// Every number of threads from 1 to `threads`, with the same queries.
// Requires: queries not empty, threads >= 1.
[[nodiscard]] std::vector<CoresRow> measure_cores(const image::IndexSnapshot& snapshot,
                                                  std::span<const image::Query> queries,
                                                  int limit,
                                                  int threads);

}  // namespace haarmony::eval
