// How well poor copies and coarse paintings find their originals in a folder of pictures.
//
// Errors  kNotFound for a folder without pictures that can be read.
// Source  sec. 4.5.2, with simulated queries.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::eval {

struct CopiesOptions {
    std::string folder;
    int queries =
        100;  // evenly spread over the folder's pictures, in order of their names
};

// One kind of query under one profile.
struct CopiesRow {
    std::string query;
    std::string profile;
    std::vector<std::int64_t> ranks;  // of the target, one a query
    double median_query_ms = 0;       // scoring and top 20 alone
};

struct CopiesReport {
    std::int64_t pictures = 0;
    std::vector<std::string> unreadable;  // "path: reason"
    double describe_per_second = 0;       // decode, signature and thumbnail, one thread
    std::vector<std::string> targets;     // paths, one a query
    std::vector<CopiesRow> rows;
};

[[nodiscard]] Result<CopiesReport> measure_copies(const CopiesOptions& options);

// The report as plain text, one line a row, and one for each target that was not first.
[[nodiscard]] std::string to_text(const CopiesReport& report);

}  // namespace haarmony::eval
