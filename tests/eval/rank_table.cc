#include "tests/eval/rank_table.h"

#include <string>

namespace haarmony::eval {
namespace {

void add_rate(std::vector<CsvCell>& row, const Rate& rate) {
    row.emplace_back(100 * rate.share());
    row.emplace_back(100 * rate.interval().low);
    row.emplace_back(100 * rate.interval().high);
}

}  // namespace

std::vector<CsvCell> with_rank_header(std::vector<CsvCell> header) {
    header.emplace_back("pictures");
    header.emplace_back("queries");
    for (const char* rate : {"rank_1", "top_20", "top_1_percent"}) {
        for (const char* part : {"", "_low", "_high"}) {
            header.emplace_back(std::string(rate) + part);
        }
    }
    for (const char* column : {"mean_reciprocal_rank",
                               "mean_reciprocal_rank_low",
                               "mean_reciprocal_rank_high",
                               "median_rank"}) {
        header.emplace_back(column);
    }
    return header;
}

std::vector<CsvCell> with_ranks(std::vector<CsvCell> row, const RankSummary& summary) {
    row.emplace_back(summary.pictures);
    row.emplace_back(summary.first.trials);
    add_rate(row, summary.first);
    add_rate(row, summary.top_20);
    add_rate(row, summary.top_1_percent);
    row.emplace_back(summary.mean_reciprocal);
    row.emplace_back(summary.mean_reciprocal_interval.low);
    row.emplace_back(summary.mean_reciprocal_interval.high);
    row.emplace_back(summary.median);
    return row;
}

}  // namespace haarmony::eval
