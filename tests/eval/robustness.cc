#include "tests/eval/robustness.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "tests/eval/distortions.h"
#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/rank_table.h"
#include "tests/eval/search_options.h"

namespace haarmony::eval {
namespace {

using Ranks = std::vector<std::int64_t>;

QueryPicture distorted(const Experiment& experiment,
                       const Distortion& distortion,
                       std::size_t target) {
    Random random = experiment.random(distortion.name, target);
    return distortion.apply(experiment.picture(target), random);
}

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

// The rows of one distortion under one option, one a profile.
std::vector<RobustnessRow> option_rows(const Experiment& experiment,
                                       const MetricPanel& panel,
                                       const Distortion& distortion,
                                       const SearchOption& option) {
    const std::vector<std::size_t>& targets = experiment.evaluation();
    std::vector<RobustnessRow> rows;
    auto ranks = by_column(experiment, panel.profiles().size(), [&](std::size_t i) {
        const QueryPicture query = distorted(experiment, distortion, targets[i]);
        const auto ways = option.ways(query.view(), panel.search().kind());
        Ranks of_query;
        for (const image::Profile& profile : panel.profiles()) {
            of_query.push_back(
                rank_with(option, ways, panel.search(), profile, targets[i]));
        }
        return of_query;
    });
    for (std::size_t p = 0; p < ranks.size(); ++p) {
        const image::Profile& profile = panel.profiles()[p];
        const RankSummary summary = summarize(ranks[p], experiment.database().size());
        rows.push_back({distortion.name,
                        option.name,
                        wavelet_name(profile),
                        profile.name,
                        std::move(ranks[p]),
                        summary});
    }
    return rows;
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
            const QueryPicture query = distorted(experiment, distortion, targets[i]);
            return panel.ranks(query.view(), targets[i]);
        });
        std::ranges::move(
            panel_rows(
                distortion.name, panel, std::move(ranks), experiment.database().size()),
            std::back_inserter(robustness.rows));
        for (const SearchOption& option : search_options()) {
            if (std::ranges::find(option.distortions, distortion.name) ==
                option.distortions.end()) {
                continue;
            }
            std::ranges::move(option_rows(experiment, panel, distortion, option),
                              std::back_inserter(robustness.rows));
        }
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

std::string to_html(const Robustness& robustness) {
    const auto table_of =
        [&](const std::function<std::string(const RankSummary&)>& cell) {
            std::vector<std::string> header{"distortion", "option"};
            for (const RobustnessRow& row : robustness.rows) {
                if (row.distortion != robustness.rows.front().distortion ||
                    !row.option.empty())
                    break;
                header.push_back(metric_label(row.name, row.profile));
            }
            HtmlTable table(header, 2);
            std::vector<std::string> cells;
            for (std::size_t i = 0; i < robustness.rows.size(); ++i) {
                const RobustnessRow& row = robustness.rows[i];
                if (cells.empty()) cells = {row.distortion, row.option};
                cells.push_back(cell(row.summary));
                const bool ends = i + 1 == robustness.rows.size() ||
                                  robustness.rows[i + 1].distortion != row.distortion ||
                                  robustness.rows[i + 1].option != row.option;
                if (!ends) continue;
                cells.resize(header.size());  // the rivals have no options
                table.add(cells);
                cells.clear();
            }
            return table.html();
        };
    return paragraph(
               "Rank 1 and top 20 in per cent; the intervals, the top 1 % and the mean "
               "reciprocal ranks are in robustness.csv. An option is one of the "
               "service's, "
               "meant for the distortion.") +
           table_of([](const RankSummary& summary) {
               return percent(summary.first) + " / " + percent(summary.top_20);
           });
}

std::string to_html(const Control& control) {
    HtmlTable table(
        {"metric", "rank 1, %", "top 20, %", "median rank", "chance, top 20, %"}, 1);
    for (const RobustnessRow& row : control.rows) {
        table.add({metric_label(row.name, row.profile),
                   percent(row.summary.first),
                   percent_with_interval(row.summary.top_20),
                   std::to_string(row.summary.median),
                   number(100 * control.chance_top_20, 1)});
    }
    return paragraph(
               "Undistorted pictures as queries, each with the target of another one: an "
               "evaluation that finds these better than chance finds everything.") +
           table.html();
}

}  // namespace haarmony::eval
