// A speed run as text, a plot and a page.
#pragma once

#include <string>
#include <vector>

#include "tests/eval/figures.h"
#include "tests/eval/plot_svg.h"
#include "tests/eval/speed.h"

namespace haarmony::eval {

[[nodiscard]] std::string to_text(const SpeedReport& report);

// Median times against the number of pictures, both logarithmic.
// Requires: the report has rows.
[[nodiscard]] Plot speed_plot(const SpeedReport& report);

// speed.html and speed.svg, and the tables as CSV.
[[nodiscard]] std::vector<OutputFile> speed_files(const SpeedReport& report);

}  // namespace haarmony::eval
