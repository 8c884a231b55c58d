// The tables of a speed run, for other programs.
//
// Shape   speed_csv() has one row for each way of searching, size, m, bin rule and kind of
//         query; where a column means nothing to a row, its cell is empty.
#pragma once

#include "tests/eval/csv.h"
#include "tests/eval/speed.h"

namespace haarmony::eval {

[[nodiscard]] CsvTable speed_csv(const SpeedReport& report);
[[nodiscard]] CsvTable popularity_csv(const SpeedReport& report);
[[nodiscard]] CsvTable effort_csv(const SpeedReport& report);
[[nodiscard]] CsvTable cores_csv(const SpeedReport& report);
[[nodiscard]] CsvTable size_csv(const SpeedReport& report);

}  // namespace haarmony::eval
