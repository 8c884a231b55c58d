// Section 4.5.4: whether a query still finds its target in the top 1 % as the database grows.
//
// Twenty nested databases: the smallest holds every target, the largest every picture, each
// one the pictures of the one before and some more in a random order. Scores do not depend
// on the database, so that the order within a part is the order within the whole without
// the others.
//
// Source  sec. 4.5.4.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/experiment.h"
#include "tests/eval/ranking.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

inline constexpr int kNestedDatabases = 20;

struct SizePoint {
    QueryKind kind{};
    MetricName name;
    std::string profile;
    RankSummary summary;  // of the database of summary.pictures
};

struct DatabaseSize {
    std::vector<SizePoint> points;
    // For each kind, the largest difference of the top-1-% rates, in points of per cent.
    std::vector<std::pair<QueryKind, double>> spread;
};

// Even sizes from `smallest` to `largest`, rising, without repetition.
// Requires: 1 <= smallest <= largest.
[[nodiscard]] std::vector<std::int64_t> nested_sizes(std::int64_t smallest,
                                                     std::int64_t largest);

[[nodiscard]] DatabaseSize measure_database_size(const Experiment& experiment,
                                                 const MetricPanel& panel);

[[nodiscard]] CsvTable to_csv(const DatabaseSize& measured);
[[nodiscard]] std::string to_html(const DatabaseSize& measured);

}  // namespace haarmony::eval
