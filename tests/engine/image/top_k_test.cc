#include "engine/image/top_k.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace haarmony::image {
namespace {

std::vector<Match> sorted(std::vector<Match> matches) {
    std::ranges::sort(matches, [](const Match& a, const Match& b) {
        return std::pair(a.score, a.id) < std::pair(b.score, b.id);
    });
    return matches;
}

TEST(TopK, IsThePrefixOfTheFullSort) {
    std::mt19937 random(91);
    for (const int scores : {1, 3, 1000}) {
        std::vector<Match> matches;
        for (int i = 0; i < 60; ++i) {
            matches.push_back(
                {ImageId{i + 1}, static_cast<Score>(random() % scores) - 1});
        }
        std::ranges::shuffle(matches, random);
        const std::vector<Match> expected = sorted(matches);
        for (int limit = 1; limit < 65; ++limit) {
            TopK top(limit);
            for (const Match& match : matches) top.offer(match);
            const std::size_t count = std::min(std::size_t(limit), matches.size());
            EXPECT_EQ(top.take(), std::vector(expected.begin(), expected.begin() + count))
                << scores << " scores, limit " << limit;
        }
    }
}

TEST(TopK, TiesGoToTheSmallerId) {
    TopK top(1);
    top.offer({ImageId{5}, 7});
    top.offer({ImageId{6}, 7});
    top.offer({ImageId{4}, 7});
    top.offer({ImageId{1}, 8});
    EXPECT_EQ(top.take(), (std::vector<Match>{{ImageId{4}, 7}}));
}

TEST(TopK, AHugeLimitCostsNothingBeforehand) {
    TopK top(std::numeric_limits<int>::max());
    top.offer({ImageId{2}, 1});
    EXPECT_EQ(top.take(), (std::vector<Match>{{ImageId{2}, 1}}));
}

TEST(TopK, IsFullOfAsManyAsAreWantedAndKnowsTheWorstOfThem) {
    std::mt19937 random(92);
    for (const std::size_t limit : {1U, 2U, 7U, 40U}) {
        TopK top(static_cast<int>(limit));
        std::vector<Match> offered;
        EXPECT_FALSE(top.full());
        for (int i = 0; i < 60; ++i) {
            offered.push_back({ImageId{i + 1}, static_cast<Score>(random() % 50) - 25});
            top.offer(offered.back());
            ASSERT_EQ(top.full(), offered.size() >= limit) << i;
            if (!top.full()) continue;
            ASSERT_EQ(top.worst(), sorted(offered)[limit - 1].score) << i;
        }
    }
}

}  // namespace
}  // namespace haarmony::image
