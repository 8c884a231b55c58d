#include "engine/image/combined_rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace haarmony::image {
namespace {

// Ranks by counting the pictures that come before.
std::int64_t rank_literally(const std::vector<BestMatch>& metric, ImageId id) {
    const auto self = std::ranges::find(metric, id, &BestMatch::id);
    if (self == metric.end()) return std::int64_t(metric.size()) + 1;
    return 1 + std::ranges::count_if(metric, [&](const BestMatch& other) {
               return other.distance < self->distance ||
                      (other.distance == self->distance && other.id < id);
           });
}

TEST(CombinedRank, IsTheMeanOrTheWorstOfTheRanks) {
    std::mt19937 random(191);
    for (int round = 0; round < 30; ++round) {
        std::vector<std::vector<BestMatch>> metrics(1 + round % 3);
        for (auto& metric : metrics) {
            for (int id = 1; id <= 25; ++id) {
                // The first knows all but some; the others lack more.
                if (random() % 5 == 0) continue;
                metric.push_back({ImageId{id}, Score(random() % 8), 0, 0});
            }
        }
        for (const CombineBy by : {CombineBy::kMean, CombineBy::kWorst}) {
            const std::vector<CombinedMatch> found = combine_ranks(metrics, by, 1000);
            ASSERT_EQ(found.size(), metrics[0].size());
            std::int64_t before = 0;
            for (const CombinedMatch& match : found) {
                std::int64_t expected = 0;
                for (const auto& metric : metrics) {
                    const std::int64_t rank = rank_literally(metric, match.first.id);
                    expected = by == CombineBy::kMean ? expected + rank
                                                      : std::max(expected, rank);
                }
                EXPECT_EQ(match.rank, expected);
                EXPECT_GE(match.rank, before);
                before = match.rank;
            }
            const auto few = combine_ranks(metrics, by, 3);
            ASSERT_EQ(few.size(), 3U);
            for (int i = 0; i < 3; ++i) EXPECT_EQ(few[i].first, found[i].first);
        }
    }
}

TEST(CombinedRank, TiesGoToTheFirstMetric) {
    const std::vector<std::vector<BestMatch>> metrics = {
        {{ImageId{1}, 9, 0, 0}, {ImageId{2}, 3, 0, 0}},
        {{ImageId{1}, 3, 0, 0}, {ImageId{2}, 9, 0, 0}}};
    const auto found = combine_ranks(metrics, CombineBy::kMean, 2);
    EXPECT_EQ(found[0].first.id, ImageId{2});
    EXPECT_EQ(found[0].rank, 3);
    EXPECT_EQ(found[1].rank, 3);
}

}  // namespace
}  // namespace haarmony::image
