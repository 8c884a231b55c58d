#include "engine/image/best_kept.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <thread>
#include <tuple>

namespace haarmony::image {
namespace {

std::vector<Match> random_matches(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Match> matches;
    for (int i = 0; i < count; ++i)
        matches.push_back({ImageId{i + 1}, static_cast<Score>(random() % 500) - 250});
    std::ranges::shuffle(matches, random);
    return matches;
}

std::vector<Match> best_of(std::vector<Match> matches, std::size_t limit) {
    std::ranges::sort(matches, [](const Match& a, const Match& b) {
        return std::tie(a.score, a.id) < std::tie(b.score, b.id);
    });
    matches.resize(std::min(limit, matches.size()));
    return matches;
}

TEST(BestKept, TheWorstIsOpenUntilAsManyAreKeptAsAreWanted) {
    const std::vector<Match> matches = random_matches(40, 1);
    BestKept best(7);
    std::vector<Match> offered;
    for (const Match& match : matches) {
        EXPECT_EQ(best.worst(),
                  offered.size() < 7 ? BestKept::kAny : best_of(offered, 7).back().score);
        best.offer(match);
        offered.push_back(match);
    }
    EXPECT_EQ(best.take(), best_of(matches, 7));
}

TEST(BestKept, NothingIsLeftBehind) {
    BestKept best(1);
    best.offer({ImageId{3}, 5});
    EXPECT_EQ(best.worst(), 5);
    EXPECT_EQ(best.take().size(), 1U);
    EXPECT_EQ(best.worst(), BestKept::kAny);
    EXPECT_TRUE(best.take().empty());
}

TEST(BestKept, ThreadsThatSkipWhatIsWorseFindTheSame) {
    constexpr std::size_t kThreads = 4;
    const std::vector<Match> matches = random_matches(20'000, 2);
    BestKept best(20);
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < kThreads; ++t) {
            threads.emplace_back([&, t] {
                for (std::size_t i = t; i < matches.size(); i += kThreads) {
                    if (matches[i].score <= best.worst()) best.offer(matches[i]);
                }
            });
        }
    }
    EXPECT_EQ(best.take(), best_of(matches, 20));
}

}  // namespace
}  // namespace haarmony::image
