#include "engine/image/rank_summary.h"

#include <gtest/gtest.h>

#include <vector>

namespace haarmony::image {
namespace {

TEST(RankSummary, ByHand) {
    const std::vector<std::int64_t> ranks{40, 1, 2, 20, 1};
    const RankSummary summary = summarize(ranks, 250);
    EXPECT_EQ(summary.median, 2);
    EXPECT_DOUBLE_EQ(summary.mean, 64.0 / 5);
    EXPECT_DOUBLE_EQ(summary.first, 0.4);
    EXPECT_DOUBLE_EQ(summary.top_20, 0.8);
    EXPECT_DOUBLE_EQ(summary.top_percent, 0.6);  // of 250: ranks 1 and 2
    EXPECT_DOUBLE_EQ(summary.mean_reciprocal_rank,
                     (2 + 1.0 / 2 + 1.0 / 20 + 1.0 / 40) / 5);
}

TEST(RankSummary, MedianOfAnEvenCountLiesBetween) {
    EXPECT_EQ(summarize(std::vector<std::int64_t>{7, 1, 2, 4}, 10).median, 3);
}

TEST(RankSummary, OnePercentOfFewIsTheFirst) {
    EXPECT_EQ(summarize(std::vector<std::int64_t>{1, 2}, 99).top_percent, 0.5);
}

TEST(RankSummary, OfNothingIsZero) { EXPECT_EQ(summarize({}, 10), RankSummary{}); }

}  // namespace
}  // namespace haarmony::image
