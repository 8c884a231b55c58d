// The robustness table: every distortion, under every metric, and with the service's options
// that are meant for it; and the same with the targets exchanged, which must be at chance.
//
// Source  sec. 4.5.3, with the distortions of today.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/experiment.h"
#include "tests/eval/ranking.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

struct RobustnessRow {
    std::string distortion;
    std::string option;  // of the service; empty for the plain search
    MetricName name;
    std::string profile;
    std::vector<std::int64_t> ranks;  // one a query
    RankSummary summary;
};

struct Robustness {
    std::vector<RobustnessRow> rows;
};

[[nodiscard]] Robustness measure_robustness(const Experiment& experiment,
                                            const MetricPanel& panel);

// The undistorted pictures as queries, each for the target of another one.
struct Control {
    std::vector<RobustnessRow> rows;
    // What a random order gives: the query's own picture is among the first 20, and any
    // of the others is as likely as the next.
    double chance_top_20 = 0;
};
[[nodiscard]] Control measure_control(const Experiment& experiment,
                                      const MetricPanel& panel);

[[nodiscard]] CsvTable to_csv(const std::vector<RobustnessRow>& rows);
[[nodiscard]] std::string to_html(const Robustness& robustness);
[[nodiscard]] std::string to_html(const Control& control);

}  // namespace haarmony::eval
