#include "tests/eval/figure_4_6.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/plot_svg.h"
#include "tests/eval/rank_table.h"

namespace haarmony::eval {
namespace {

constexpr std::array kKinds = {QueryKind::kScanned,
                               QueryKind::kPainted,
                               QueryKind::kHalfPainted};

// Whether a curve is L^q under the profile that is meant for its kind of query.
bool is_meant(const RankCurve& curve) {
    const bool scanned = curve.kind == QueryKind::kScanned;
    return curve.profile == (scanned ? "scanned" : "painted");
}

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
    for (double place = 1; std::llround(place) < pictures;) {
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

std::string to_html(const Figure46& figure) {
    std::vector<Plot> plots;
    const double pictures = static_cast<double>(figure.pictures);
    for (const QueryKind kind : kKinds) {
        Plot plot{query_kind_name(kind) + " queries",
                  {"top x % of the database", 100 / pictures, 100, true},
                  {"% of queries", 0, 100},
                  {}};
        if (figure.pictures == 1) plot.x.low = 10;
        for (const RankCurve& curve : figure.curves) {
            if (curve.kind != kind) continue;
            PlotSeries series{metric_label(curve.name, curve.profile),
                              metric_style(curve.name, curve.profile),
                              {},
                              false,
                              is_meant(curve)};
            for (const std::int64_t place : curve_places(figure.pictures)) {
                series.points.push_back(
                    rate_point(100 * static_cast<double>(place) / pictures,
                               within(curve.ranks, place)));
            }
            plot.series.push_back(std::move(series));
        }
        plots.push_back(std::move(plot));
    }
    std::vector<std::string> drawings;
    for (const Plot& plot : plots) drawings.push_back(to_svg(plot));

    HtmlTable table({"query",
                     "metric",
                     "rank 1, %",
                     "top 20, %",
                     "top 1 %, %",
                     "mean reciprocal rank",
                     "median rank"},
                    2);
    for (const RankCurve& curve : figure.curves) {
        const RankSummary& summary = curve.summary;
        table.add({query_kind_name(curve.kind),
                   metric_label(curve.name, curve.profile),
                   percent_with_interval(summary.first),
                   percent_with_interval(summary.top_20),
                   percent_with_interval(summary.top_1_percent),
                   number(summary.mean_reciprocal, 3),
                   std::to_string(summary.median)},
                  is_meant(curve)
                      ? std::vector<bool>{false, true, true, true, true, true, true}
                      : std::vector<bool>{});
    }
    return paragraph(
               "The percentage of queries whose target is in the top x % of the "
               "database. The band is the 95 % interval of L^q under the profile that is "
               "meant for "
               "the kind of query (in bold in the table). Painting from memory cannot be "
               "simulated; half paintings take its place. What is transparent there is "
               "filled as the search fills it, for every metric.") +
           paragraph(
               "Where L1 or L2 on 8 x 8 comes out ahead on painted queries, the "
               "simulation "
               "is why: a simulated painting keeps the mean colour of every square, "
               "which "
               "is just what these two compare, and 8 x 8 to 16 x 16 flat squares have "
               "few "
               "other features. It also keeps the brightness: what scans lose and these "
               "metrics depend on.") +
           panels(drawings) + legend(plots) + table.html();
}

}  // namespace haarmony::eval
