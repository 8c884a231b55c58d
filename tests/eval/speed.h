// The time of a query against the number of pictures and m: the index beside the plain
// algorithm of Figure 4.2 and the brute-force metrics, in one run, with exactness checked.
//
// Plain and index answer each query in turn on one thread, from the query's signature to the
// 20 best; the times are CPU times, so that the ratios hold on a busy machine. Every answer of
// the index is compared with exhaustive_matches.h, which is itself compared with the metric.
//
// Shape   one index of 60 coefficients serves all; the plain algorithm has arrays for each m.
// Errors  kNotFound for photos that cannot be read, kInvalidArgument for a single photo, kIo
//         for a cache that cannot be written.
// Source  sec. 4.5.5, Table 4.2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/result.h"
#include "engine/image/profile.h"
#include "engine/image/query.h"
#include "tests/eval/cores.h"
#include "tests/eval/list_popularity.h"
#include "tests/eval/paired_times.h"
#include "tests/eval/rival_metrics.h"
#include "tests/eval/synthetic_signatures.h"
#include "tests/eval/table_4_2.h"

namespace haarmony::eval {

inline constexpr int kSpeedMatches = 20;  // one screen

// What is asked of every collection: so many coefficients, weighed by a built-in profile.
struct SpeedCase {
    int m = 0;
    std::string_view profile;
};
inline constexpr std::array kSpeedCases = {SpeedCase{20, "scanned"},
                                           SpeedCase{40, "scanned"},
                                           SpeedCase{60, "painted"}};

// The most queries of each kind, and so many a cache holds. Near queries and sketches are of
// the first pictures, so that a collection has no fewer.
inline constexpr int kMostSpeedQueries = 256;

struct SpeedOptions {
    std::vector<std::int64_t> images;  // sizes, rising, the first >= queries
    std::string photos;                // a folder; empty for generated pictures
    int generated_photos = 60;         // how many, where there is no folder; >= 2
    std::string cache;                 // a file; empty for none
    int queries = 60;                  // of each kind, 1 .. kMostSpeedQueries
    std::uint64_t seed = 1;
    int threads = 1;  // the most that searches are measured with
    std::size_t bandwidth_bytes = std::size_t{512} << 20U;  // read to measure memory
};

// One size, m, bin rule and kind of query.
struct SpeedRow {
    std::int64_t images = 0;
    int m = 0;
    std::string profile;
    image::BinRule bin_rule{};
    SyntheticKind kind{};
    int queries = 0;
    PairedTimes times;           // plain, then the index
    image::SearchEffort effort;  // of the index, all queries
    // The index when it leaves nothing out, and what that has to read, all queries.
    TimeSummary scan;
    std::int64_t scan_bytes = 0;
    std::int64_t mismatches = 0;

    [[nodiscard]] double per_query(std::int64_t sum) const {
        return static_cast<double>(sum) / queries;
    }
    [[nodiscard]] double visited_percent() const {
        return effort.blocks == 0
                   ? 0.0
                   : 100 * double(effort.blocks_visited) / double(effort.blocks);
    }
};

struct BruteForceRow {
    std::int64_t images = 0;
    MetricName name;
    int queries = 0;
    TimeSummary times;
    std::int64_t bytes_per_image = 0;
};

struct SizeRow {
    std::int64_t images = 0;
    double index_bytes_per_image = 0;
    std::int64_t segments = 0;
    double build_s = 0;  // of CPU time, sealed and merged
    std::vector<std::pair<int, double>> plain_bytes_per_image;  // by m
};

struct SpeedReport {
    std::string source;  // what the pictures were made of
    std::uint64_t seed = 0;
    double bytes_per_second = 0;  // of memory, one core
    std::vector<ListPopularity>
        photos;  // of the photos themselves, queried with themselves
    std::vector<std::pair<SyntheticKind, ListPopularity>> synthetic;
    std::vector<SpeedRow> rows;
    std::vector<BruteForceRow> brute_force;
    std::vector<SizeRow> sizes;
    std::vector<CoresRow> cores;
    std::int64_t oracle_errors =
        0;              // scores of the exhaustive search that the metric denies
    Table42 table_4_2;  // no rows where all sizes are smaller than its larger one

    [[nodiscard]] std::int64_t mismatches() const;
    // How long memory needs for what the scan of a query has to read; 0 for a small
    // collection, all of which is in the tail.
    [[nodiscard]] double memory_ms(const SpeedRow& row) const {
        return row.per_query(row.scan_bytes) / bytes_per_second * 1e3;
    }
};

// How many answers are not exactly the expected matches, ids, order and scores, or did not
// look at all `images`. Requires: as many of the one as of the other.
[[nodiscard]] std::int64_t count_mismatches(
    std::span<const image::SearchResult> answers,
    std::span<const std::vector<image::Match>> expected,
    std::int64_t images);

// `progress` hears one line for each step.
// Requires: the options are in their ranges.
[[nodiscard]] Result<SpeedReport> measure_speed(
    const SpeedOptions& options,
    Executor& executor,
    const std::function<void(const std::string&)>& progress);

}  // namespace haarmony::eval
