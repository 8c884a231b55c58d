#include "tests/eval/robustness.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "tests/eval/distortions.h"
#include "tests/eval/rank_table.h"

namespace haarmony::eval {
namespace {

using Ranks = std::vector<std::int64_t>;

// ranks_of(query number) for each evaluation query, in parallel; turned into one list of
// ranks for each column.
template <typename RanksOf>
std::vector<Ranks> by_column(const Experiment& experiment,
                             std::size_t columns,
                             const RanksOf& ranks_of) {
    const std::size_t queries = experiment.evaluation().size();
    std::vector<Ranks> by_query(queries);
    experiment.executor().parallel_for(queries,
                                       [&](std::size_t i) { by_query[i] = ranks_of(i); });
    std::vector<Ranks> result(columns);
    for (const Ranks& ranks : by_query) {
        for (std::size_t c = 0; c < columns; ++c) result[c].push_back(ranks[c]);
    }
    return result;
}

std::vector<RobustnessRow> panel_rows(const std::string& distortion,
                                      const MetricPanel& panel,
                                      std::vector<Ranks> ranks,
                                      std::int64_t pictures) {
    std::vector<RobustnessRow> rows;
    for (std::size_t c = 0; c < ranks.size(); ++c) {
        const auto& [name, profile] = panel.columns()[c];
        const RankSummary summary = summarize(ranks[c], pictures);
        rows.push_back({distortion, "", name, profile, std::move(ranks[c]), summary});
    }
    return rows;
}

}  // namespace

Robustness measure_robustness(const Experiment& experiment, const MetricPanel& panel) {
    Robustness robustness;
    const std::vector<std::size_t>& targets = experiment.evaluation();
    for (const Distortion& distortion : distortions()) {
        auto ranks = by_column(experiment, panel.columns().size(), [&](std::size_t i) {
            Random random = experiment.random(distortion.name, targets[i]);
            const QueryPicture query =
                distortion.apply(experiment.picture(targets[i]), random);
            return panel.ranks(query.view(), targets[i]);
        });
        std::ranges::move(
            panel_rows(
                distortion.name, panel, std::move(ranks), experiment.database().size()),
            std::back_inserter(robustness.rows));
    }
    return robustness;
}

Control measure_control(const Experiment& experiment, const MetricPanel& panel) {
    // A cycle: no query keeps its own target, and with a single picture there is no other.
    const std::vector<std::size_t>& targets = experiment.evaluation();
    auto ranks = by_column(experiment, panel.columns().size(), [&](std::size_t i) {
        const RgbPicture& query = experiment.picture(targets[i]);
        return panel.ranks(query.view(), targets[(i + 1) % targets.size()]);
    });
    const std::int64_t pictures = experiment.database().size();
    return {panel_rows("identity", panel, std::move(ranks), pictures),
            pictures <= 20 ? 1.0 : 19.0 / static_cast<double>(pictures - 1)};
}

CsvTable to_csv(const std::vector<RobustnessRow>& rows) {
    CsvTable table(
        with_rank_header({"distortion", "option", "metric", "resolution", "profile"}));
    for (const RobustnessRow& row : rows) {
        table.add(with_ranks({row.distortion,
                              row.option,
                              row.name.metric,
                              row.name.resolution,
                              row.profile},
                             row.summary));
    }
    return table;
}

}  // namespace haarmony::eval
