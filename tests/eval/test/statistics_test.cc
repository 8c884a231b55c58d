#include "tests/eval/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace haarmony::eval {
namespace {

TEST(Wilson, SolvesItsOwnEquation) {
    // The ends are where the observed rate is 1.96 standard errors of the *true* rate away.
    for (const std::int64_t trials : {1, 7, 150}) {
        for (const std::int64_t hits : {std::int64_t{0}, trials / 3, trials}) {
            const double p = static_cast<double>(hits) / static_cast<double>(trials);
            const Interval interval = wilson(hits, trials);
            for (const double end : {interval.low, interval.high}) {
                if (end == 0 || end == 1) continue;
                const double error =
                    std::sqrt(end * (1 - end) / static_cast<double>(trials));
                EXPECT_NEAR(std::abs(p - end) / error, 1.959964, 1e-5)
                    << hits << " of " << trials;
            }
            EXPECT_LE(interval.low, p);
            EXPECT_GE(interval.high, p);
        }
    }
}

TEST(Wilson, StaysInsideTheRangeAtBothEnds) {
    EXPECT_EQ(wilson(0, 20).low, 0);
    EXPECT_GT(wilson(0, 20).high, 0.1);
    EXPECT_EQ(wilson(20, 20).high, 1);
    EXPECT_LT(wilson(20, 20).low, 0.9);
}

TEST(Bootstrap, IsAboutTwoStandardErrorsWideForAMean) {
    std::vector<double> values;
    for (int i = 0; i < 400; ++i) values.push_back(i % 2);
    const Interval interval = bootstrap(values, mean, 2000, 9);
    const double error = 0.5 / std::sqrt(400);
    EXPECT_NEAR(interval.low, 0.5 - 1.96 * error, 0.01);
    EXPECT_NEAR(interval.high, 0.5 + 1.96 * error, 0.01);
}

TEST(Bootstrap, IsTheSameForTheSameSeed) {
    const std::vector<double> values{1, 5, 2, 8, 3};
    const Interval a = bootstrap(values, mean, 200, 4);
    const Interval b = bootstrap(values, mean, 200, 4);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
    EXPECT_GE(a.low, 1);
    EXPECT_LE(a.high, 8);
}

TEST(TopCount, IsTheFloorButOneAtLeast) {
    EXPECT_EQ(top_count(0.01, 1093), 10);
    EXPECT_EQ(top_count(0.01, 900), 9);
    EXPECT_EQ(top_count(0.01, 100), 1);
    EXPECT_EQ(top_count(0.01, 5), 1);
    for (std::int64_t hundreds = 1; hundreds < 300; ++hundreds)
        EXPECT_EQ(top_count(0.01, hundreds * 100), hundreds);
}

TEST(Summarize, CountsRanks) {
    const std::vector<std::int64_t> ranks{1, 30, 1, 4, 20};
    const RankSummary summary = summarize(ranks, 400);
    EXPECT_EQ(summary.pictures, 400);
    EXPECT_EQ(summary.first.hits, 2);
    EXPECT_EQ(summary.top_20.hits, 4);
    EXPECT_EQ(summary.top_1_percent.hits, 3);
    EXPECT_EQ(summary.first.trials, 5);
    EXPECT_EQ(summary.median, 4);
    EXPECT_DOUBLE_EQ(summary.mean_reciprocal, (1 + 1 / 30.0 + 1 + 0.25 + 0.05) / 5);
    EXPECT_LE(summary.mean_reciprocal_interval.low, summary.mean_reciprocal);
    EXPECT_GE(summary.mean_reciprocal_interval.high, summary.mean_reciprocal);
}

}  // namespace
}  // namespace haarmony::eval
