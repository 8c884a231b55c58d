#include "tests/eval/database_size.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/plot_svg.h"
#include "tests/eval/rank_table.h"

namespace haarmony::eval {
namespace {

// When each picture enters: the targets first, then the others in a random order.
std::vector<std::size_t> entrance_of(const Experiment& experiment) {
    const std::size_t pictures = experiment.database().names.size();
    Random random = experiment.random("nested databases", 0);
    std::vector<std::size_t> order = shuffled(pictures, random);
    std::vector<bool> is_target(pictures, false);
    for (const std::size_t target : experiment.evaluation()) is_target[target] = true;
    std::ranges::stable_partition(order, [&](std::size_t i) { return is_target[i]; });
    std::vector<std::size_t> entrance(pictures);
    for (std::size_t i = 0; i < pictures; ++i) entrance[order[i]] = i;
    return entrance;
}

// The target's rank among the pictures that have entered, one a size.
std::vector<std::int64_t> ranks_within(const std::vector<image::Match>& matches,
                                       std::size_t target,
                                       const std::vector<std::size_t>& entrance,
                                       const std::vector<std::int64_t>& sizes) {
    std::vector<std::int64_t> ranks(sizes.size(), 1);
    for (const image::Match& match : matches) {
        const auto place = static_cast<std::size_t>(to_int(match.id) - 1);
        if (place == target) break;
        for (std::size_t s = 0; s < sizes.size(); ++s) {
            if (static_cast<std::int64_t>(entrance[place]) < sizes[s]) ++ranks[s];
        }
    }
    return ranks;
}

}  // namespace

std::vector<std::int64_t> nested_sizes(std::int64_t smallest, std::int64_t largest) {
    assert(1 <= smallest && smallest <= largest);
    std::vector<std::int64_t> sizes;
    for (int i = 0; i < kNestedDatabases; ++i) {
        const std::int64_t size =
            smallest + (largest - smallest) * i / (kNestedDatabases - 1);
        if (sizes.empty() || size > sizes.back()) sizes.push_back(size);
    }
    return sizes;
}

DatabaseSize measure_database_size(const Experiment& experiment,
                                   const MetricPanel& panel) {
    DatabaseSize measured;
    const std::vector<std::size_t>& targets = experiment.evaluation();
    const std::vector<std::size_t> entrance = entrance_of(experiment);
    const std::vector<std::int64_t> sizes = nested_sizes(
        static_cast<std::int64_t>(targets.size()), experiment.database().size());
    for (const QueryKind kind : {QueryKind::kScanned, QueryKind::kPainted}) {
        const auto profile = *std::ranges::find(
            panel.profiles(), query_kind_name(kind), &image::Profile::name);
        std::vector<std::vector<std::int64_t>> by_query(targets.size());
        experiment.executor().parallel_for(targets.size(), [&](std::size_t i) {
            const QueryPicture query = experiment.query(kind, targets[i]);
            by_query[i] = ranks_within(
                panel.search().order(image::make_signature(query.view()), profile),
                targets[i],
                entrance,
                sizes);
        });
        double least = 100;
        double most = 0;
        for (std::size_t s = 0; s < sizes.size(); ++s) {
            std::vector<std::int64_t> ranks;
            for (const auto& of_query : by_query) ranks.push_back(of_query[s]);
            const RankSummary summary = summarize(ranks, sizes[s]);
            measured.points.push_back(
                {kind, wavelet_name(profile), profile.name, summary});
            least = std::min(least, 100 * summary.top_1_percent.share());
            most = std::max(most, 100 * summary.top_1_percent.share());
        }
        measured.spread.emplace_back(kind, most - least);
    }
    return measured;
}

CsvTable to_csv(const DatabaseSize& measured) {
    CsvTable table(with_rank_header({"query", "metric", "resolution", "profile"}));
    for (const SizePoint& point : measured.points) {
        table.add(with_ranks({query_kind_name(point.kind),
                              point.name.metric,
                              point.name.resolution,
                              point.profile},
                             point.summary));
    }
    return table;
}

std::string to_html(const DatabaseSize& measured) {
    Plot plot{"nested databases",
              {"pictures in the database", 0, 1},
              {"% in the top 1 %", 0, 100},
              {}};
    for (const auto& [kind, spread] : measured.spread) {
        PlotSeries series;
        series.marks = true;
        series.band = true;
        for (const SizePoint& point : measured.points) {
            if (point.kind != kind) continue;
            series.name =
                query_kind_name(kind) + ", " + metric_label(point.name, point.profile);
            series.style = metric_style(point.name, point.profile);
            const double pictures = static_cast<double>(point.summary.pictures);
            plot.x.high = std::max(plot.x.high, pictures);
            series.points.push_back(rate_point(pictures, point.summary.top_1_percent));
        }
        plot.series.push_back(std::move(series));
    }
    HtmlTable table({"query", "largest difference, points of per cent"}, 1);
    for (const auto& [kind, spread] : measured.spread)
        table.add({query_kind_name(kind), number(spread, 1)});
    return paragraph(
               "Each database holds the pictures of the one before and more; the "
               "smallest "
               "holds little more than the targets, so that its top 1 % is one picture. "
               "The dissertation found differences of at most 2 %.") +
           panels({to_svg(plot), legend({plot}) + table.html()});
}

}  // namespace haarmony::eval
