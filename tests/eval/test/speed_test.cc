// The whole of a small run: what it asks, that every answer is exact, and its files.
#include "tests/eval/speed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <tuple>

#include "ingest/thumbnail.h"
#include "server/app/thread_executor.h"
#include "tests/eval/printed_times.h"
#include "tests/eval/signature_cache.h"
#include "tests/eval/speed_csv.h"
#include "tests/eval/speed_report.h"
#include "tests/eval/table_4_2.h"
#include "tests/eval/test/generated_pictures.h"
#include "tests/eval/test/xml_reader.h"
#include "tests/eval/text_table.h"
#include "tests/support/temporary_folder.h"

namespace haarmony::eval {
namespace {

SpeedOptions small_options() {
    SpeedOptions options;
    options.images = {12, 40};
    options.queries = 3;
    options.generated_photos = 4;
    options.threads = 2;
    options.bandwidth_bytes = 1U << 16U;
    return options;
}

Result<SpeedReport> run(const SpeedOptions& options, std::string* heard = nullptr) {
    server::ThreadExecutor threads(1);
    return measure_speed(options, threads, [&](const std::string& line) {
        if (heard != nullptr) *heard += line + '\n';
    });
}

class SmallSpeedRun : public ::testing::Test {
  protected:
    static const SpeedReport& report() {
        static const SpeedReport made = *run(small_options());
        return made;
    }
};

TEST_F(SmallSpeedRun, EveryAnswerIsExact) {
    EXPECT_EQ(report().mismatches(), 0);
    EXPECT_EQ(report().oracle_errors, 0);
}

TEST_F(SmallSpeedRun, AsksEverySizeMRuleAndKind) {
    std::set<std::tuple<std::int64_t, int, image::BinRule, SyntheticKind>> asked;
    for (const SpeedRow& row : report().rows) {
        asked.emplace(row.images, row.m, row.bin_rule, row.kind);
        EXPECT_EQ(row.queries, 3);
        EXPECT_EQ(row.profile, row.m == 60 ? "painted" : "scanned");
        EXPECT_GT(row.times.ratio.median, 0);
    }
    EXPECT_EQ(asked.size(), 2U * 3 * 3 * 3);
    EXPECT_EQ(report().rows.size(), asked.size());
    EXPECT_EQ(report().brute_force.size(), 2U * 3);
    EXPECT_EQ(report().sizes.size(), 2U);
    EXPECT_TRUE(report().table_4_2.rows.empty());
    EXPECT_GT(report().bytes_per_second, 0);
}

TEST_F(SmallSpeedRun, AWrongAnswerIsCounted) {
    SpeedReport wrong = report();
    wrong.rows[4].mismatches = 2;
    wrong.cores[1].mismatches = 1;
    wrong.oracle_errors = 1;
    EXPECT_EQ(wrong.mismatches(), 4);
    EXPECT_NE(to_text(wrong).find("4 of 162 answers differ"), std::string::npos);
}

TEST_F(SmallSpeedRun, EveryNumberOfThreadsIsMeasured) {
    std::vector<std::pair<std::int64_t, int>> measured;
    for (const CoresRow& row : report().cores) {
        measured.emplace_back(row.images, row.threads);
        EXPECT_GT(row.queries_per_second, 0);
        EXPECT_GT(row.alone_ms, 0);
        EXPECT_EQ(row.mismatches, 0);
    }
    EXPECT_EQ(
        measured,
        (std::vector<std::pair<std::int64_t, int>>{{12, 1}, {12, 2}, {40, 1}, {40, 2}}));
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');)
            rows.back().push_back(cell);
        if (line.ends_with(',')) rows.back().emplace_back();
    }
    return rows;
}

TEST_F(SmallSpeedRun, TablesHaveOneWidthAndFiniteNumbers) {
    int tables = 0;
    for (const OutputFile& file : speed_files(report())) {
        if (!file.name.ends_with(".csv")) continue;
        ++tables;
        const auto rows = rows_of(file.text);
        ASSERT_GE(rows.size(), 2U) << file.name;
        for (const auto& row : rows) {
            EXPECT_EQ(row.size(), rows.front().size()) << file.name;
            for (const std::string& cell : row) {
                EXPECT_NE(cell, "nan") << file.name;
                EXPECT_NE(cell, "inf") << file.name;
            }
        }
    }
    EXPECT_EQ(tables, 5);
}

TEST_F(SmallSpeedRun, TableNamesEveryMetricAndWay) {
    std::set<std::string> metrics;
    std::set<std::string> algorithms;
    const auto rows = rows_of(speed_csv(report()).text());
    for (std::size_t i = 1; i < rows.size(); ++i) {
        metrics.insert(rows[i][0]);
        algorithms.insert(rows[i][2]);
    }
    EXPECT_EQ(metrics, (std::set<std::string>{"L^q", "L1", "L2", "histogram"}));
    EXPECT_EQ(algorithms, (std::set<std::string>{"brute force", "index", "plain"}));
    EXPECT_EQ(rows.size(), 1 + 2 * report().rows.size() + report().brute_force.size());
}

TEST_F(SmallSpeedRun, PlotHoldsEveryCurveWithinItsAxes) {
    const Plot plot = speed_plot(report());
    EXPECT_EQ(plot.series.size(), 3U * 2 + 3);
    for (const PlotSeries& series : plot.series) {
        EXPECT_EQ(series.points.size(), 2U) << series.name;
        for (const PlotPoint& point : series.points) {
            EXPECT_GT(point.x, plot.x.low) << series.name;
            EXPECT_LT(point.x, plot.x.high) << series.name;
            EXPECT_GT(point.y, plot.y.low) << series.name;
            EXPECT_LT(point.y, plot.y.high) << series.name;
        }
    }
}

TEST_F(SmallSpeedRun, PageAndPlotAreWellFormed) {
    const std::string doctype = "<!DOCTYPE html>";
    const auto files = speed_files(report());
    ASSERT_EQ(files[0].name, "speed.html");
    ASSERT_TRUE(files[0].text.starts_with(doctype));
    EXPECT_EQ(read_xml(files[0].text.substr(doctype.size())).error, "");
    ASSERT_EQ(files[1].name, "speed.svg");
    const XmlReading plot = read_xml(files[1].text);
    EXPECT_EQ(plot.error, "");
    EXPECT_EQ(plot.attributes.at("xmlns").front(), "http://www.w3.org/2000/svg");
    EXPECT_EQ(plot.elements.at("style"), 1);
}

TEST(Speed, AnyDifferenceOfAnAnswerIsAMismatch) {
    const std::vector<image::Match> right = {{ImageId{3}, -50}, {ImageId{1}, -40}};
    const auto mismatches = [&](std::vector<image::Match> matches, int searched) {
        const std::vector<image::SearchResult> answers = {{right, 5},
                                                          {std::move(matches), searched}};
        return count_mismatches(answers, std::vector{right, right}, 5);
    };
    EXPECT_EQ(mismatches(right, 5), 0);
    EXPECT_EQ(mismatches(right, 4), 1);
    EXPECT_EQ(mismatches({right[1], right[0]}, 5), 1);
    EXPECT_EQ(mismatches({right[0]}, 5), 1);
    EXPECT_EQ(mismatches({right[0], {ImageId{2}, -40}}, 5), 1);
    EXPECT_EQ(mismatches({right[0], {ImageId{1}, -39}}, 5), 1);
}

TEST(Speed, CacheGivesTheSameCollection) {
    const haarmony::testing::TemporaryFolder folder;
    SpeedOptions options = small_options();
    options.images = {8};
    options.queries = 2;
    options.cache = folder.file("cache");
    std::string first;
    std::string second;
    ASSERT_TRUE(run(options, &first));
    ASSERT_TRUE(run(options, &second));
    EXPECT_NE(first.find("cache: cannot be opened"), std::string::npos) << first;
    EXPECT_NE(first.find("making 8 pictures"), std::string::npos) << first;
    EXPECT_EQ(second.find("making"), std::string::npos) << second;
    EXPECT_EQ(read_signature_cache(options.cache)->queries.front().size(), 8U);
}

TEST(Speed, CacheOfSomethingElseIsMadeAnew) {
    const haarmony::testing::TemporaryFolder folder;
    SpeedOptions options = small_options();
    options.images = {4};
    options.queries = 2;
    options.cache = folder.file("cache");
    ASSERT_TRUE(run(options));
    const auto heard_with = [](const SpeedOptions& changed) {
        std::string heard;
        EXPECT_TRUE(run(changed, &heard));
        return heard;
    };
    SpeedOptions changed = options;
    changed.seed = 2;
    EXPECT_NE(heard_with(changed).find("of another seed"), std::string::npos);
    changed.images = {6};
    EXPECT_NE(heard_with(changed).find("4 pictures, not 6"), std::string::npos);
    EXPECT_EQ(read_signature_cache(options.cache)->size(), 6);
    changed.queries = 4;
    EXPECT_EQ(heard_with(changed).find("making"), std::string::npos);
    std::ofstream(options.cache) << "no cache";
    EXPECT_NE(heard_with(changed).find("no cache of signatures"), std::string::npos);
    EXPECT_EQ(read_signature_cache(options.cache)->size(), 6);
}

TEST(Speed, FewerCachedQueriesThanAskedForAreMadeAnew) {
    const haarmony::testing::TemporaryFolder folder;
    SpeedOptions options = small_options();
    options.images = {2};
    options.queries = 1;
    options.cache = folder.file("cache");
    ASSERT_TRUE(run(options));  // two of each kind: no more than pictures
    options.images = {2, 2};
    options.queries = 2;
    std::string heard;
    ASSERT_TRUE(run(options, &heard));
    EXPECT_EQ(heard.find("making"), std::string::npos) << heard;
    SyntheticCollection fewer = *read_collection_cache(options.cache, 2);
    for (auto& queries : fewer.queries) queries.resize(1);
    ASSERT_TRUE(write_collection_cache(fewer, options.cache));
    heard.clear();
    ASSERT_TRUE(run(options, &heard));
    EXPECT_NE(heard.find("too few queries"), std::string::npos) << heard;
}

TEST(Speed, CacheThatCannotBeWrittenIsAnError) {
    const haarmony::testing::TemporaryFolder folder;
    SpeedOptions options = small_options();
    options.images = {3};
    options.cache = folder.file("none/cache");
    const auto report = run(options);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kIo);
}

TEST(Speed, PhotosMustBeThereAndMoreThanOne) {
    const haarmony::testing::TemporaryFolder folder;
    SpeedOptions options = small_options();
    options.photos = folder.file("none");
    EXPECT_EQ(run(options).error().code, ErrorCode::kNotFound);
    options.photos = folder.path().string();
    EXPECT_EQ(run(options).error().code, ErrorCode::kNotFound);
    const auto jpeg = ingest::encode_jpeg(gradient(40, 30).view(), 90);
    ASSERT_TRUE(jpeg);
    std::ofstream(folder.file("one.jpg"), std::ios::binary)
        .write(reinterpret_cast<const char*>(jpeg->data()),
               static_cast<std::streamsize>(jpeg->size()));
    const auto single = run(options);
    ASSERT_FALSE(single);
    EXPECT_EQ(single.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(single.error().message,
              folder.path().string() + ": one picture; two are the least");
}

TEST(PrintedTimes, AreThoseOfTable42) {
    EXPECT_EQ(printed_ms({"L^q", "m=20"}, 1093), 190);
    EXPECT_EQ(printed_ms({"L^q", "m=20"}, 20558), 440);
    EXPECT_EQ(printed_ms(rival_name(Rival::kL1Full), 20558), 892'600);
    EXPECT_EQ(printed_ms(rival_name(Rival::kL2Full), 1093), 42'040);
    EXPECT_EQ(printed_ms({"L^q", "m=40"}, 1093), std::nullopt);
    EXPECT_EQ(printed_ms({"L^q", "m=20"}, 1000), std::nullopt);
    for (const Rival rival : kRivals) {
        const auto small = printed_ms(rival_name(rival), kSmallDatabase);
        const auto large = printed_ms(rival_name(rival), kLargeDatabase);
        ASSERT_TRUE(small && large) << rival_name(rival).metric;
        EXPECT_GT(*large, 9 * *small) << rival_name(rival).metric;
    }
}

TEST(SpeedReport, Table42HasThePrintedFiguresBesideOurs) {
    Table42 table;
    table.rows = {{{"L^q", "m=20"}, "scanned", 1093, 20, 0.5, 0.6},
                  {{"L1", "8x8"}, "", 500, 20, 1.5, 1.6}};
    EXPECT_EQ(to_csv(table).text(),
              "metric,resolution,profile,pictures,queries,median_ms,mean_ms,printed_ms\n"
              "L^q,m=20,scanned,1093,20,0.5,0.6,190\n"
              "L1,8x8,,500,20,1.5,1.6,\n");
}

TEST(TextTable, AlignsNumbersToTheRight) {
    TextTable table({"name", "ms"}, 1);
    table.add({"a", "12.5"});
    table.add({"longer", "3"});
    EXPECT_EQ(table.text(), "name      ms\na       12.5\nlonger     3\n");
    EXPECT_EQ(read_xml(table.html()).error, "");
}

}  // namespace
}  // namespace haarmony::eval
