// Table 4.2: the time of one query under each metric, at two sizes of the database.
//
// From a 128 x 128 query picture to the 20 closest, on one thread, with m = 20 for L^q; what
// can be prepared of the database is prepared. A database larger than the folder holds its
// pictures several times, each copy in memory of its own. Times depend on the machine and on what else it does; they are
// reported and never judged.
//
// Source  sec. 4.5.5, Table 4.2.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/experiment.h"
#include "tests/eval/rival_metrics.h"

namespace haarmony::eval {

struct QueryTime {
    MetricName name;
    std::string profile;
    std::int64_t pictures = 0;
    std::int64_t queries = 0;
    double median_ms = 0;
    double mean_ms = 0;
};

struct Table42 {
    std::vector<QueryTime> rows;
};

// Two sizes for a folder of that many pictures, some ten times apart: the folder and a
// multiple of it, or a tenth of a large folder and the folder.
[[nodiscard]] std::pair<std::int64_t, std::int64_t> timed_sizes(std::int64_t pictures);

// Requires: 1 <= small, large.
[[nodiscard]] Table42 measure_table_4_2(const Experiment& experiment,
                                        std::int64_t small,
                                        std::int64_t large);

// With the dissertation's times, where it prints them, beside ours.
[[nodiscard]] CsvTable to_csv(const Table42& table);
[[nodiscard]] std::string to_html(const Table42& table);

}  // namespace haarmony::eval
