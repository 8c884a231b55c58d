#include "tests/eval/speed_csv.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace haarmony::eval {
namespace {

const SizeRow& size_of(const SpeedReport& report, std::int64_t images) {
    return *std::ranges::find(report.sizes, images, &SizeRow::images);
}

double plain_bytes(const SpeedReport& report, std::int64_t images, int m) {
    const auto& by_m = size_of(report, images).plain_bytes_per_image;
    return std::ranges::find(by_m, m, &std::pair<int, double>::first)->second;
}

}  // namespace

CsvTable speed_csv(const SpeedReport& report) {
    CsvTable csv({"metric",
                  "resolution",
                  "algorithm",
                  "images",
                  "m",
                  "profile",
                  "bin_rule",
                  "query",
                  "queries",
                  "median_ms",
                  "p90_ms",
                  "max_ms",
                  "plain_ratio",
                  "plain_ratio_deviation",
                  "plain_ratio_lower_quartile",
                  "plain_ratio_upper_quartile",
                  "bytes_per_image",
                  "mismatches"});
    for (const SpeedRow& row : report.rows) {
        const std::string m = std::to_string(row.m);
        const auto add = [&](const char* algorithm,
                             const TimeSummary& times,
                             const std::array<CsvCell, 4>& ratio,
                             double bytes,
                             const CsvCell& mismatches) {
            csv.add({"L^q",
                     "m=" + m,
                     algorithm,
                     row.images,
                     row.m,
                     row.profile,
                     std::string(image::bin_rule_name(row.bin_rule)),
                     synthetic_kind_name(row.kind),
                     row.queries,
                     times.median_ms,
                     times.p90_ms,
                     times.largest_ms,
                     ratio[0],
                     ratio[1],
                     ratio[2],
                     ratio[3],
                     bytes,
                     mismatches});
        };
        add("plain",
            row.times.first,
            {"", "", "", ""},
            plain_bytes(report, row.images, row.m),
            "");
        const RatioSummary& ratio = row.times.ratio;
        add("index",
            row.times.second,
            {ratio.median, ratio.deviation, ratio.lower_quartile, ratio.upper_quartile},
            size_of(report, row.images).index_bytes_per_image,
            row.mismatches);
    }
    for (const BruteForceRow& row : report.brute_force) {
        csv.add({row.name.metric,
                 row.name.resolution,
                 "brute force",
                 row.images,
                 "",
                 "",
                 "",
                 synthetic_kind_name(SyntheticKind::kNear),
                 row.queries,
                 row.times.median_ms,
                 row.times.p90_ms,
                 row.times.largest_ms,
                 "",
                 "",
                 "",
                 "",
                 row.bytes_per_image,
                 ""});
    }
    return csv;
}

CsvTable popularity_csv(const SpeedReport& report) {
    CsvTable csv({"query",
                  "m",
                  "non_empty_lists",
                  "hits_per_image",
                  "median_density",
                  "p90_density",
                  "max_density",
                  "popular_lists",
                  "popular_share"});
    const auto add = [&](const std::string& name, const ListPopularity& p) {
        csv.add({name,
                 p.m,
                 p.non_empty_lists,
                 p.hits_per_picture,
                 p.median_density,
                 p.p90_density,
                 p.largest_density,
                 p.popular_lists,
                 p.popular_share});
    };
    for (const ListPopularity& p : report.photos) add("the photos themselves", p);
    for (const auto& [kind, p] : report.synthetic) add(synthetic_kind_name(kind), p);
    return csv;
}

CsvTable effort_csv(const SpeedReport& report) {
    CsvTable csv({"profile",
                  "bin_rule",
                  "query",
                  "images",
                  "m",
                  "blocks_visited_percent",
                  "compared",
                  "scan_ms",
                  "scan_bytes_per_image",
                  "memory_ms"});
    for (const SpeedRow& row : report.rows) {
        csv.add({row.profile,
                 std::string(image::bin_rule_name(row.bin_rule)),
                 synthetic_kind_name(row.kind),
                 row.images,
                 row.m,
                 row.visited_percent(),
                 row.per_query(row.effort.compared),
                 row.scan.median_ms,
                 row.per_query(row.scan_bytes) / double(row.images),
                 report.memory_ms(row)});
    }
    return csv;
}

CsvTable cores_csv(const SpeedReport& report) {
    CsvTable csv({"images", "threads", "queries_per_second", "alone_ms"});
    for (const CoresRow& row : report.cores)
        csv.add({row.images, row.threads, row.queries_per_second, row.alone_ms});
    return csv;
}

CsvTable size_csv(const SpeedReport& report) {
    CsvTable csv({"images", "algorithm", "m", "bytes_per_image", "segments", "build_s"});
    for (const SizeRow& row : report.sizes) {
        csv.add({row.images,
                 "index",
                 kPackedCoefficients,
                 row.index_bytes_per_image,
                 row.segments,
                 row.build_s});
        for (const auto& [m, bytes] : row.plain_bytes_per_image)
            csv.add({row.images, "plain", m, bytes, "", ""});
    }
    return csv;
}

}  // namespace haarmony::eval
