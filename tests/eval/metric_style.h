// How each metric is named and drawn, the same in every figure.
#pragma once

#include <string>

#include "tests/eval/plot_svg.h"
#include "tests/eval/rival_metrics.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

// "L^q, m=40, scanned" or "L1, 128x128".
[[nodiscard]] std::string metric_label(const MetricName& name,
                                       const std::string& profile);

[[nodiscard]] PlotStyle metric_style(const MetricName& name, const std::string& profile);

// In per cent, to one decimal: "97.3".
[[nodiscard]] std::string percent(const Rate& rate);
// The same with its interval: "97.3 (93.3 to 99.0)".
[[nodiscard]] std::string percent_with_interval(const Rate& rate);

// A point of a curve of rates in per cent.
[[nodiscard]] PlotPoint rate_point(double x, const Rate& rate);

}  // namespace haarmony::eval
