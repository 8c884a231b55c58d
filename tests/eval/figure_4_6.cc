#include "tests/eval/figure_4_6.h"

#include <algorithm>
#include <cmath>

#include "tests/eval/rank_table.h"

namespace haarmony::eval {
namespace {

constexpr std::array kKinds = {QueryKind::kScanned,
                               QueryKind::kPainted,
                               QueryKind::kHalfPainted};

}  // namespace

Figure46 measure_figure_4_6(const Experiment& experiment, const MetricPanel& panel) {
    Figure46 figure;
    figure.pictures = experiment.database().size();
    const std::vector<std::size_t>& targets = experiment.evaluation();
    for (const QueryKind kind : kKinds) {
        std::vector<std::vector<std::int64_t>> by_query(targets.size());
        experiment.executor().parallel_for(targets.size(), [&](std::size_t i) {
            by_query[i] =
                panel.ranks(experiment.query(kind, targets[i]).view(), targets[i]);
        });
        for (std::size_t c = 0; c < panel.columns().size(); ++c) {
            const auto& [name, profile] = panel.columns()[c];
            RankCurve curve{kind, name, profile, {}, {}};
            for (const auto& ranks : by_query) curve.ranks.push_back(ranks[c]);
            curve.summary = summarize(curve.ranks, figure.pictures);
            figure.curves.push_back(std::move(curve));
        }
    }
    return figure;
}

std::vector<std::int64_t> curve_places(std::int64_t pictures) {
    std::vector<std::int64_t> places;
    for (double place = 1; place < static_cast<double>(pictures);) {
        places.push_back(std::llround(place));
        place = std::max(std::round(place) + 1, place * std::exp2(1.0 / 12));
    }
    places.push_back(pictures);
    return places;
}

CsvTable to_csv(const Figure46& figure) {
    CsvTable table({"query",
                    "metric",
                    "resolution",
                    "profile",
                    "top_pictures",
                    "top_percent",
                    "queries",
                    "found_percent",
                    "found_percent_low",
                    "found_percent_high"});
    for (const RankCurve& curve : figure.curves) {
        for (const std::int64_t place : curve_places(figure.pictures)) {
            const Rate found = within(curve.ranks, place);
            table.add({query_kind_name(curve.kind),
                       curve.name.metric,
                       curve.name.resolution,
                       curve.profile,
                       place,
                       100.0 * static_cast<double>(place) /
                           static_cast<double>(figure.pictures),
                       found.trials,
                       100 * found.share(),
                       100 * found.interval().low,
                       100 * found.interval().high});
        }
    }
    return table;
}

CsvTable summary_csv(const Figure46& figure) {
    CsvTable table(with_rank_header({"query", "metric", "resolution", "profile"}));
    for (const RankCurve& curve : figure.curves) {
        table.add(with_ranks({query_kind_name(curve.kind),
                              curve.name.metric,
                              curve.name.resolution,
                              curve.profile},
                             curve.summary));
    }
    return table;
}

}  // namespace haarmony::eval
