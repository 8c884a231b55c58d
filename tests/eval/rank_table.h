// The columns that every table of ranks ends with: rates with their 95 % intervals.
//
// Units   rates in per cent.
#pragma once

#include <vector>

#include "tests/eval/csv.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {

[[nodiscard]] std::vector<CsvCell> with_rank_header(std::vector<CsvCell> header);
[[nodiscard]] std::vector<CsvCell> with_ranks(std::vector<CsvCell> row,
                                              const RankSummary& summary);

}  // namespace haarmony::eval
