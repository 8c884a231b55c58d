#include "tests/eval/table_4_2.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

#include "tests/eval/metric_style.h"
#include "tests/eval/page.h"
#include "tests/eval/printed_times.h"
#include "tests/eval/ranking.h"
#include "tests/eval/statistics.h"

namespace haarmony::eval {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCoefficients = 20;  // m
constexpr int kTop = 20;
constexpr std::size_t kQueries = 20;  // full-size scans of a large database are slow

RgbPicture square_of(const RgbPicture& picture) {
    return resize(picture, image::kSide, image::kSide);
}

template <typename Answer>
QueryTime time_queries(const std::vector<RgbPicture>& queries,
                       MetricName name,
                       std::int64_t pictures,
                       const Answer& answer) {
    std::vector<double> times;
    std::size_t answers = 0;
    for (const RgbPicture& query : queries) {
        const auto start = Clock::now();
        answers += answer(query);
        times.push_back(
            std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    assert(answers == queries.size() * std::min<std::size_t>(kTop, pictures));
    std::ranges::sort(times);
    return {std::move(name),
            "",
            pictures,
            static_cast<std::int64_t>(queries.size()),
            times[times.size() / 2],
            mean(times)};
}

std::size_t closest(Rival rival,
                    const std::vector<RivalFeatures>& pictures,
                    const RgbPicture& query) {
    const RivalFeatures features = describe_rivals(query.view());
    std::vector<std::pair<std::uint64_t, std::size_t>> order;
    order.reserve(pictures.size());
    for (std::size_t i = 0; i < pictures.size(); ++i)
        order.emplace_back(distance(rival, features, pictures[i]), i);
    const std::size_t top = std::min<std::size_t>(kTop, order.size());
    std::ranges::partial_sort(order, order.begin() + std::ptrdiff_t(top));
    order.resize(top);
    return order.size();
}

// The first `size` of the values, from the first again after the last.
template <typename T>
std::vector<T> cycled(const std::vector<T>& values, std::int64_t size) {
    std::vector<T> result;
    result.reserve(size);
    for (std::int64_t i = 0; i < size; ++i) result.push_back(values[i % values.size()]);
    return result;
}

}  // namespace

std::pair<std::int64_t, std::int64_t> timed_sizes(std::int64_t pictures) {
    assert(pictures >= 1);
    // The full-size squares of 9,000 pictures are 440 MB.
    constexpr std::int64_t kLarge = 9000;
    if (pictures > kLarge / 2) return {pictures / 10, pictures};
    return {pictures, std::min<std::int64_t>(10, kLarge / pictures) * pictures};
}

Table42 measure_table_4_2(const Experiment& experiment,
                          std::int64_t small,
                          std::int64_t large) {
    assert(small >= 1 && large >= 1);
    std::vector<RgbPicture> queries;
    for (const std::size_t place : experiment.evaluation()) {
        if (queries.size() == kQueries) break;
        queries.push_back(square_of(experiment.picture(place)));
    }

    Table42 table;
    const image::Profile profile = *image::built_in_profile("scanned");
    for (const std::int64_t pictures : {small, large}) {
        const auto index = make_index(
            cycled(experiment.database().signatures.at(profile.kind), pictures));
        const auto snapshot = index->snapshot();
        table.rows.push_back(time_queries(
            queries,
            {"L^q", "m=" + std::to_string(kCoefficients)},
            pictures,
            [&](const RgbPicture& query) {
                return snapshot
                    ->search(
                        image::make_query(
                            image::make_signature(query.view()), profile, kCoefficients),
                        {kTop})
                    .matches.size();
            }));
        table.rows.back().profile = profile.name;
        const auto rivals = cycled(experiment.database().rivals, pictures);
        for (const Rival rival : kRivals) {
            table.rows.push_back(time_queries(
                queries, rival_name(rival), pictures, [&](const RgbPicture& query) {
                    return closest(rival, rivals, query);
                }));
        }
    }
    return table;
}

CsvTable to_csv(const Table42& table) {
    CsvTable csv({"metric",
                  "resolution",
                  "profile",
                  "pictures",
                  "queries",
                  "median_ms",
                  "mean_ms",
                  "printed_ms"});
    for (const QueryTime& row : table.rows) {
        const auto printed = printed_ms(row.name, row.pictures);
        csv.add({row.name.metric,
                 row.name.resolution,
                 row.profile,
                 row.pictures,
                 row.queries,
                 row.median_ms,
                 row.mean_ms,
                 printed ? CsvCell(*printed) : CsvCell("")});
    }
    return csv;
}

std::string to_html(const Table42& table) {
    HtmlTable html({"metric", "pictures", "queries", "median, ms", "mean, ms"}, 1);
    for (const QueryTime& row : table.rows) {
        html.add({metric_label(row.name, row.profile),
                  std::to_string(row.pictures),
                  std::to_string(row.queries),
                  number(row.median_ms, 3),
                  number(row.mean_ms, 3)});
    }
    return paragraph(
               "From a 128 x 128 query picture to the 20 closest, on one thread, with "
               "what "
               "can be prepared of the database prepared. A database larger than the "
               "folder "
               "holds its pictures several times.") +
           html.html();
}

}  // namespace haarmony::eval
