// A speed run as text, tables, a plot and a page.
//
// Shape   speed.csv has one row for each way of searching, size, m, bin rule and kind of
//         query; where a column means nothing to a row, its cell is empty.
#pragma once

#include <string>
#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/figures.h"
#include "tests/eval/plot_svg.h"
#include "tests/eval/speed.h"

namespace haarmony::eval {

[[nodiscard]] std::string to_text(const SpeedReport& report);

[[nodiscard]] CsvTable speed_csv(const SpeedReport& report);
[[nodiscard]] CsvTable popularity_csv(const SpeedReport& report);
[[nodiscard]] CsvTable size_csv(const SpeedReport& report);

// Median times against the number of pictures, both logarithmic.
// Requires: the report has rows.
[[nodiscard]] Plot speed_plot(const SpeedReport& report);

// speed.html and speed.svg, and the tables as CSV.
[[nodiscard]] std::vector<OutputFile> speed_files(const SpeedReport& report);

}  // namespace haarmony::eval
