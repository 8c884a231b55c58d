#include "tests/eval/speed_report.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/printed_times.h"
#include "tests/eval/speed_csv.h"
#include "tests/eval/text_table.h"

namespace haarmony::eval {
namespace {

std::string milliseconds(double ms) { return number(ms, 4); }

std::string spread(const RatioSummary& ratio) {
    return number(ratio.lower_quartile, 1) + " to " + number(ratio.upper_quartile, 1);
}

TextTable popularity_table(const SpeedReport& report) {
    TextTable table({"list popularity",
                     "m",
                     "lists in use",
                     "hits / N",
                     "density: median %",
                     "p90 %",
                     "max %",
                     "lists > 1 %",
                     "their share %"},
                    1);
    const auto add = [&](const std::string& name, const ListPopularity& p) {
        table.add({name,
                   std::to_string(p.m),
                   std::to_string(p.non_empty_lists),
                   number(p.hits_per_picture, 1),
                   number(100 * p.median_density, 1),
                   number(100 * p.p90_density, 1),
                   number(100 * p.largest_density, 1),
                   std::to_string(p.popular_lists),
                   number(100 * p.popular_share, 1)});
    };
    for (const ListPopularity& p : report.photos) add("the photos themselves", p);
    for (const auto& [kind, p] : report.synthetic) add(synthetic_kind_name(kind), p);
    return table;
}

TextTable times_table(const SpeedReport& report) {
    TextTable table({"profile",
                     "bins",
                     "query",
                     "pictures",
                     "m",
                     "plain ms",
                     "p90",
                     "max",
                     "index ms",
                     "p90",
                     "max",
                     "ratio",
                     "deviation",
                     "quartiles",
                     "wrong"},
                    3);
    for (const SpeedRow& row : report.rows) {
        table.add({row.profile,
                   std::string(image::bin_rule_name(row.bin_rule)),
                   synthetic_kind_name(row.kind),
                   std::to_string(row.images),
                   std::to_string(row.m),
                   milliseconds(row.times.first.median_ms),
                   milliseconds(row.times.first.p90_ms),
                   milliseconds(row.times.first.largest_ms),
                   milliseconds(row.times.second.median_ms),
                   milliseconds(row.times.second.p90_ms),
                   milliseconds(row.times.second.largest_ms),
                   number(row.times.ratio.median, 2),
                   number(row.times.ratio.deviation, 2),
                   spread(row.times.ratio),
                   std::to_string(row.mismatches)});
    }
    return table;
}

TextTable effort_table(const SpeedReport& report) {
    TextTable table({"profile",
                     "bins",
                     "query",
                     "pictures",
                     "m",
                     "blocks visited %",
                     "pictures compared",
                     "scan ms",
                     "its bytes a picture",
                     "of the memory's time"},
                    3);
    for (const SpeedRow& row : report.rows) {
        const double bound = report.memory_ms(row);
        table.add({row.profile,
                   std::string(image::bin_rule_name(row.bin_rule)),
                   synthetic_kind_name(row.kind),
                   std::to_string(row.images),
                   std::to_string(row.m),
                   number(row.visited_percent(), 1),
                   number(row.per_query(row.effort.compared), 0),
                   milliseconds(row.scan.median_ms),
                   number(row.per_query(row.scan_bytes) / double(row.images), 1),
                   bound == 0.0 ? "" : number(row.scan.median_ms / bound, 2)});
    }
    return table;
}

TextTable cores_table(const SpeedReport& report) {
    TextTable table(
        {"pictures", "threads", "queries a second", "one alone, ms of wall time"}, 0);
    for (const CoresRow& row : report.cores) {
        table.add({std::to_string(row.images),
                   std::to_string(row.threads),
                   number(row.queries_per_second, 1),
                   milliseconds(row.alone_ms)});
    }
    return table;
}

TextTable brute_force_table(const SpeedReport& report) {
    TextTable table({"brute force", "pictures", "bytes a picture", "ms", "p90", "max"},
                    1);
    for (const BruteForceRow& row : report.brute_force) {
        table.add({metric_label(row.name, ""),
                   std::to_string(row.images),
                   std::to_string(row.bytes_per_image),
                   milliseconds(row.times.median_ms),
                   milliseconds(row.times.p90_ms),
                   milliseconds(row.times.largest_ms)});
    }
    return table;
}

TextTable size_table(const SpeedReport& report) {
    std::vector<std::string> header = {
        "pictures", "segments", "built in s", "index, bytes a picture"};
    for (const auto& [m, bytes] : report.sizes.front().plain_bytes_per_image)
        header.push_back("plain, m = " + std::to_string(m));
    TextTable table(header, 0);
    for (const SizeRow& row : report.sizes) {
        std::vector<std::string> cells = {std::to_string(row.images),
                                          std::to_string(row.segments),
                                          number(row.build_s, 2),
                                          number(row.index_bytes_per_image, 1)};
        for (const auto& [m, bytes] : row.plain_bytes_per_image)
            cells.push_back(number(bytes, 1));
        table.add(cells);
    }
    return table;
}

TextTable dissertation_table(const Table42& table) {
    TextTable text({"Table 4.2", "pictures", "median ms", "mean ms", "printed, ms"}, 1);
    for (const QueryTime& row : table.rows) {
        const auto printed = printed_ms(row.name, row.pictures);
        text.add({metric_label(row.name, row.profile),
                  std::to_string(row.pictures),
                  number(row.median_ms, 3),
                  number(row.mean_ms, 3),
                  printed ? number(*printed, 0) : ""});
    }
    return text;
}

std::string summary(const SpeedReport& report) {
    std::int64_t answers = 0;
    for (const SpeedRow& row : report.rows) answers += row.queries;
    return std::to_string(report.mismatches()) + " of " + std::to_string(answers) +
           " answers differ from the exhaustive search; " +
           std::to_string(report.oracle_errors) + " of its scores differ from the metric";
}

std::string surroundings(const SpeedReport& report) {
    return "made of " + report.source + ", seed " + std::to_string(report.seed) +
           "; one core reads memory at " + number(report.bytes_per_second / 1e9, 1) +
           " GB/s";
}

// The SVG as a file of its own: with a name space and with the page's colours.
std::string standalone(std::string svg) {
    const std::string_view start = "<svg ";
    svg.insert(start.size(), "xmlns=\"http://www.w3.org/2000/svg\" ");
    svg.insert(svg.find('>') + 1, "\n<style>" + std::string(style_sheet()) + "</style>");
    return svg;
}

// Limits that leave a little room around positive values.
PlotAxis logarithmic_axis(std::string label, double low, double high) {
    return {std::move(label), low / 1.5, high * 1.5, true};
}

}  // namespace

std::string to_text(const SpeedReport& report) {
    std::string text = surroundings(report) + "\n\n" + popularity_table(report).text() +
                       '\n' + times_table(report).text() + '\n' +
                       effort_table(report).text() + '\n' + cores_table(report).text() +
                       '\n' + brute_force_table(report).text() + '\n' +
                       size_table(report).text() + '\n';
    if (!report.table_4_2.rows.empty())
        text += dissertation_table(report.table_4_2).text() + '\n';
    return text + summary(report) + '\n';
}

Plot speed_plot(const SpeedReport& report) {
    Plot plot{"time of a query", {}, {}, {}};
    const auto add = [&](const std::string& name, PlotStyle style, double x, double y) {
        auto found = std::ranges::find(plot.series, name, &PlotSeries::name);
        if (found == plot.series.end()) {
            plot.series.push_back({name, style, {}, true, false});
            found = std::prev(plot.series.end());
        }
        found->points.push_back({x, y, 0, 0});
    };
    for (const SpeedRow& row : report.rows) {
        if (row.bin_rule != image::BinRule::kLog2Plus1 ||
            row.kind != SyntheticKind::kNear) {
            continue;
        }
        const auto x = static_cast<double>(row.images);
        const std::string name = "L^q, m=" + std::to_string(row.m);
        const int dash = row.m / 20 - 1;
        add(name + ", plain", {4, dash}, x, row.times.first.median_ms);
        add(name + ", index", {0, dash}, x, row.times.second.median_ms);
    }
    for (const BruteForceRow& row : report.brute_force) {
        add(metric_label(row.name, ""),
            metric_style(row.name, ""),
            static_cast<double>(row.images),
            row.times.median_ms);
    }
    const PlotPoint& any = plot.series.front().points.front();
    PlotPoint least = any;
    PlotPoint most = any;
    for (const PlotSeries& series : plot.series) {
        for (const PlotPoint& point : series.points) {
            least = {std::min(least.x, point.x), std::min(least.y, point.y), 0, 0};
            most = {std::max(most.x, point.x), std::max(most.y, point.y), 0, 0};
        }
    }
    plot.x = logarithmic_axis("pictures", least.x, most.x);
    plot.y = logarithmic_axis("ms of CPU time, median", least.y, most.y);
    return plot;
}

std::vector<OutputFile> speed_files(const SpeedReport& report) {
    const Plot plot = speed_plot(report);
    std::vector<Section> sections = {
        {"times",
         "Time of a query",
         paragraph("Medians over queries that are variations of pictures in the "
                   "collection, bins log2_plus_1; from the query's signature to the " +
                   std::to_string(kSpeedMatches) + " best, on one thread.") +
             panels({to_svg(plot), legend({plot})}) + times_table(report).html()},
        {"effort",
         "What a search looks at",
         paragraph(
             "The scan leaves nothing out; the memory's time is that of reading its "
             "rows at the speed measured in this run.") +
             effort_table(report).html()},
        {"cores", "Cores", cores_table(report).html()},
        {"brute-force", "Brute force", brute_force_table(report).html()},
        {"memory", "Memory", size_table(report).html()},
        {"popularity", "Popularity of lists", popularity_table(report).html()}};
    std::vector<OutputFile> files = {
        {"speed.svg", standalone(to_svg(plot))},
        {"speed.csv", speed_csv(report).text()},
        {"speed_effort.csv", effort_csv(report).text()},
        {"speed_cores.csv", cores_csv(report).text()},
        {"speed_memory.csv", size_csv(report).text()},
        {"speed_popularity.csv", popularity_csv(report).text()}};
    if (!report.table_4_2.rows.empty()) {
        sections.push_back({"table-4-2",
                            "Table 4.2: the dissertation's times and ours",
                            dissertation_table(report.table_4_2).html()});
        files.push_back({"speed_table_4_2.csv", to_csv(report.table_4_2).text()});
    }
    files.insert(files.begin(),
                 {"speed.html",
                  page("Searching by pictures: speed",
                       paragraph(summary(report) + ". The pictures are synthetic, " +
                                 surroundings(report) + '.'),
                       sections)});
    return files;
}

}  // namespace haarmony::eval
