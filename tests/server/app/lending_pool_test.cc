#include "server/app/lending_pool.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <utility>

namespace haarmony::server {
namespace {

TEST(LendingPool, MakesNoMoreThanAreInUseAtOnce) {
    int made = 0;
    LendingPool<int> pool(
        [&]() -> Result<std::unique_ptr<int>> { return std::make_unique<int>(made++); });
    for (int round = 0; round < 3; ++round) {
        const auto first = pool.lend();
        const auto second = pool.lend();
        ASSERT_TRUE(first && second);
        EXPECT_EQ((std::set<int>{**first, **second}), (std::set<int>{0, 1}));
    }
    EXPECT_EQ(made, 2);
}

TEST(LendingPool, AMovedLoanComesBackOnce) {
    int made = 0;
    LendingPool<int> pool(
        [&]() -> Result<std::unique_ptr<int>> { return std::make_unique<int>(made++); });
    {
        auto first = pool.lend();
        ASSERT_TRUE(first);
        const auto moved = std::move(first).value();
        EXPECT_EQ(*moved, 0);
    }
    const auto again = pool.lend();
    const auto other = pool.lend();
    ASSERT_TRUE(again && other);
    EXPECT_NE(&*again.value(), &*other.value());
    EXPECT_EQ(made, 2);
}

TEST(LendingPool, GivesTheFactorysErrorAndTriesAgain) {
    bool broken = true;
    LendingPool<int> pool([&]() -> Result<std::unique_ptr<int>> {
        if (broken) return Error{ErrorCode::kIo, "no more"};
        return std::make_unique<int>(7);
    });
    const auto refused = pool.lend();
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message, "no more");
    broken = false;
    const auto lent = pool.lend();
    ASSERT_TRUE(lent);
    EXPECT_EQ(*lent.value(), 7);
}

}  // namespace
}  // namespace haarmony::server
