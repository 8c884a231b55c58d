// Figure 4.6: how many queries have their target in the top x % of the database, for L^q,
// L1, L2 and the colour histogram.
//
// Painting from memory cannot be simulated; half paintings, whose other half is transparent,
// take the third place.
//
// Source  sec. 4.5.2, Figure 4.6.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/experiment.h"
#include "tests/eval/ranking.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

struct RankCurve {
    QueryKind kind{};
    MetricName name;
    std::string profile;              // of L^q; empty for the rivals
    std::vector<std::int64_t> ranks;  // one a query
    RankSummary summary;
};

struct Figure46 {
    std::int64_t pictures = 0;
    std::vector<RankCurve> curves;
};

[[nodiscard]] Figure46 measure_figure_4_6(const Experiment& experiment,
                                          const MetricPanel& panel);

// The numbers of pictures at which a curve is read: every one up to 20, then about
// twelve for each doubling, up to all.
[[nodiscard]] std::vector<std::int64_t> curve_places(std::int64_t pictures);

// One line for each curve and place.
[[nodiscard]] CsvTable to_csv(const Figure46& figure);
// One line for each curve.
[[nodiscard]] CsvTable summary_csv(const Figure46& figure);

// The section of the page.
[[nodiscard]] std::string to_html(const Figure46& figure);

}  // namespace haarmony::eval
