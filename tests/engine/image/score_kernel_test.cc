#include "engine/image/score_kernel.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace haarmony::image {
namespace {

TEST(ScoreKernel, IsTheScoreOfEverySlot) {
    std::mt19937 random(111);
    const auto average = [&random] {
        return static_cast<std::int32_t>(random() % (1U << 25)) - (1 << 24);
    };
    for (const std::size_t count : {0U, 1U, 3U, 8U, 1001U}) {
        Query query;
        std::array<std::vector<std::int32_t>, kChannels> averages;
        for (int c = 0; c < kChannels; ++c) {
            query.average[c] = average();
            query.average_weight[c] =
                static_cast<std::int32_t>(random() % (kMaxWeight + 1));
            for (std::size_t i = 0; i < count; ++i) averages[c].push_back(average());
        }
        query.log_aspect = average();
        query.aspect_weight = static_cast<std::int32_t>(random() % 3 * 500);
        std::vector<std::int32_t> aspects;
        for (std::size_t i = 0; i < count; ++i) aspects.push_back(average());
        std::vector<std::int32_t> matched;
        for (std::size_t i = 0; i < count; ++i) {
            matched.push_back(static_cast<std::int32_t>(random() % (300U * kMaxWeight)));
        }
        std::vector<Score> scores(count);
        score_slots(
            query, {{averages[0], averages[1], averages[2]}, aspects}, matched, scores);
        for (std::size_t i = 0; i < count; ++i) {
            ASSERT_EQ(scores[i],
                      score(query,
                            {averages[0][i], averages[1][i], averages[2][i]},
                            aspects[i],
                            matched[i]));
        }
    }
}

// The largest differences, weights and matches that there are.
TEST(ScoreKernel, DoesNotOverflow) {
    Query query;
    query.average.fill(-(1 << 24));
    query.average_weight.fill(kMaxWeight);
    const std::vector<std::int32_t> averages = {1 << 24, 1 << 24};
    const std::int32_t all_terms = 300 * kMaxWeight;
    const std::vector<std::int32_t> matched = {0, all_terms};
    std::vector<Score> scores(2);
    query.log_aspect = -(1 << 27);
    query.aspect_weight = kMaxWeight;
    const std::vector<std::int32_t> aspects = {1 << 27, 1 << 27};
    score_slots(query, {{averages, averages, averages}, aspects}, matched, scores);
    EXPECT_EQ(
        scores[0],
        3 * Score{kMaxWeight} * (Score{1} << 25) + Score{kMaxWeight} * (Score{1} << 28));
    EXPECT_EQ(scores[1], scores[0] - (Score{all_terms} << 24));
}

}  // namespace
}  // namespace haarmony::image
