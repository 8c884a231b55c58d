#include "tests/eval/paired_times.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/eval/cpu_clock.h"
#include "tests/eval/memory_bandwidth.h"
#include "tests/eval/quantile.h"

namespace haarmony::eval {
namespace {

TEST(Quantile, IsTheNearestRank) {
    const std::vector<double> values = {5, 1, 4, 2, 3};
    EXPECT_EQ(quantile(values, 0), 1);
    EXPECT_EQ(quantile(values, 0.2), 1);
    EXPECT_EQ(quantile(values, 0.21), 2);
    EXPECT_EQ(quantile(values, 0.5), 3);
    EXPECT_EQ(quantile(values, 0.9), 5);
    EXPECT_EQ(quantile(values, 1), 5);
    EXPECT_EQ(quantile({7}, 0.5), 7);
    EXPECT_EQ(quantile({1, 2}, 0.5), 1);
}

TEST(Quantile, DeviationIsFromTheMedianAndIgnoresOutliers) {
    EXPECT_EQ(median_deviation({1, 2, 3, 4, 1000}), 1);
    EXPECT_EQ(median_deviation({4, 4, 4}), 0);
    EXPECT_EQ(median_deviation({10, 13, 17, 20, 11}), 3);
}

TEST(PairedTimes, SummariesAreOrderStatistics) {
    const TimeSummary times = summarize_times({9, 1, 8, 2, 7, 3, 6, 4, 5, 10});
    EXPECT_EQ(times.median_ms, 5);
    EXPECT_EQ(times.p90_ms, 9);
    EXPECT_EQ(times.largest_ms, 10);
    const RatioSummary ratios = summarize_ratios({1, 2, 3, 4, 9});
    EXPECT_EQ(ratios.median, 3);
    EXPECT_EQ(ratios.deviation, 1);
    EXPECT_EQ(ratios.lower_quartile, 2);
    EXPECT_EQ(ratios.upper_quartile, 4);
}

TEST(PairedTimes, EachQuestionIsAskedOfBothInTurn) {
    std::string order;
    const PairedTimes times = measure_in_turn(
        3,
        2,
        [&](std::size_t i) { order += static_cast<char>('a' + i); },
        [&](std::size_t i) { order += static_cast<char>('A' + i); });
    EXPECT_EQ(order,
              "aA"
              "aaAA"
              "BBbb"
              "ccCC");
    EXPECT_GT(times.first.median_ms, 0);
    EXPECT_GT(times.second.median_ms, 0);
    EXPECT_GT(times.ratio.median, 0);
    EXPECT_LE(times.first.median_ms, times.first.p90_ms);
    EXPECT_LE(times.first.p90_ms, times.first.largest_ms);
    EXPECT_LE(times.ratio.lower_quartile, times.ratio.median);
    EXPECT_LE(times.ratio.median, times.ratio.upper_quartile);
}

TEST(PairedTimes, OneAloneIsAskedEachQuestion) {
    std::string order;
    const TimeSummary times =
        measure_alone(2, 3, [&](std::size_t i) { order += static_cast<char>('a' + i); });
    EXPECT_EQ(order,
              "a"
              "aaa"
              "bbb");
    EXPECT_GT(times.median_ms, 0);
}

TEST(CpuClock, NeverGoesBack) {
    double last = thread_cpu_ms();
    for (int i = 0; i < 1000; ++i) {
        const double now = thread_cpu_ms();
        EXPECT_GE(now, last);
        last = now;
    }
}

TEST(MemoryBandwidth, IsPositiveAndFinite) {
    const double bandwidth = memory_bandwidth(1U << 20U, 2);
    EXPECT_GT(bandwidth, 0);
    EXPECT_LT(bandwidth, 1e13);
}

}  // namespace
}  // namespace haarmony::eval
