// What is kept, what is found again, and how often something is decoded.
#include "engine/video/decoded_cache.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <latch>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace haarmony::video {
namespace {

DecodedCache::Decode number(int value, std::size_t bytes) {
    return [value, bytes]() -> Result<DecodedCache::Decoded> {
        return DecodedCache::Decoded{std::make_shared<const int>(value), bytes};
    };
}

TEST(DecodedCache, TheLastUsedStaysWithinTheLimit) {
    DecodedCache cache(30);
    for (std::uint64_t key = 0; key < 3; ++key) (void)cache.get({0, key}, number(0, 10));
    (void)cache.get({0, 0}, number(0, 10));
    (void)cache.get({0, 3}, number(3, 10));  // 1 goes
    EXPECT_EQ(cache.bytes(), 30U);
    EXPECT_EQ(cache.decoded(), 4U);
    for (const std::uint64_t key : {0, 2, 3}) (void)cache.get({0, key}, number(0, 10));
    EXPECT_EQ(cache.decoded(), 4U);
    (void)cache.get({0, 1}, number(1, 10));
    EXPECT_EQ(cache.decoded(), 5U);
}

TEST(DecodedCache, WhatIsInUseIsNotDecodedAgain) {
    DecodedCache cache(0);
    const auto held = cache.get({0, 5}, number(5, 100));
    ASSERT_TRUE(held.has_value());
    EXPECT_EQ(cache.bytes(), 0U);
    const auto again = cache.get({0, 5}, number(6, 100));
    EXPECT_EQ(*held, *again);
    EXPECT_EQ(cache.decoded(), 1U);
}

TEST(DecodedCache, AnErrorIsPassedOnAndForgotten) {
    DecodedCache cache(100);
    const auto failed = cache.get({0, 1}, []() -> Result<DecodedCache::Decoded> {
        return Error{ErrorCode::kIo, "no"};
    });
    ASSERT_FALSE(failed.has_value());
    EXPECT_EQ(failed.error().message, "no");
    EXPECT_TRUE(cache.get({0, 1}, number(1, 1)).has_value());
}

TEST(DecodedCache, AnExceptionLeavesNoOneWaiting) {
    DecodedCache cache(100);
    const DecodedCache::Decode throwing = []() -> Result<DecodedCache::Decoded> {
        throw std::bad_alloc();
    };
    EXPECT_THROW((void)cache.get({0, 1}, throwing), std::bad_alloc);
    EXPECT_TRUE(cache.get({0, 1}, number(1, 1)).has_value());
}

TEST(DecodedCache, ManyKeysThatDiedAreForgotten) {
    DecodedCache cache(50);
    for (std::uint64_t key = 0; key < 5000; ++key) {
        ASSERT_TRUE(cache.get({0, key}, number(static_cast<int>(key), 10)).has_value());
        ASSERT_LE(cache.bytes(), 50U);
    }
    EXPECT_EQ(cache.decoded(), 5000U);
}

TEST(DecodedCache, OwnersHaveKeysOfTheirOwnAndOneLimit) {
    DecodedCache cache(30);
    const DecodedCache::Owner first = cache.add_owner();
    const DecodedCache::Owner second = cache.add_owner();
    const auto mine = cache.get({first, 1}, number(1, 10));
    const auto theirs = cache.get({second, 1}, number(2, 10));
    ASSERT_TRUE(mine && theirs);
    EXPECT_NE(*mine, *theirs);
    (void)cache.get({second, 2}, number(3, 10));
    EXPECT_EQ(cache.bytes(), 30U);
    (void)cache.get({second, 3}, number(4, 10));  // the first one's goes
    EXPECT_EQ(cache.bytes(), 30U);
    cache.remove_owner(first);
    EXPECT_EQ(cache.bytes(), 30U);
}

TEST(DecodedCache, WhatAnOwnerHadGoesWithIt) {
    DecodedCache cache(100);
    const DecodedCache::Owner first = cache.add_owner();
    const DecodedCache::Owner second = cache.add_owner();
    std::weak_ptr<const void> mine;
    for (std::uint64_t part = 0; part < 4; ++part) {
        mine = *cache.get({first, part}, number(1, 10));
        (void)cache.get({second, part}, number(2, 10));
    }
    EXPECT_EQ(cache.bytes(), 80U);
    cache.remove_owner(first);
    EXPECT_EQ(cache.bytes(), 40U);
    EXPECT_TRUE(mine.expired());
    EXPECT_EQ(cache.decoded(), 8U);
    for (std::uint64_t part = 0; part < 4; ++part)
        (void)cache.get({second, part}, number(2, 10));
    EXPECT_EQ(cache.decoded(), 8U);
    // No owner comes back under a number that was given before.
    EXPECT_GT(cache.add_owner(), second);
}

TEST(DecodedCache, TwoThatWantTheSameDecodeItOnce) {
    constexpr int kThreads = 4;
    DecodedCache cache(100);
    std::latch started(kThreads);
    std::vector<DecodedCache::Value> got(kThreads);
    {
        std::vector<std::jthread> threads;
        for (int i = 0; i < kThreads; ++i) {
            threads.emplace_back([&, i] {
                started.arrive_and_wait();
                const auto value = cache.get({0, 7}, number(7, 1));
                if (value) got[static_cast<std::size_t>(i)] = *value;
            });
        }
    }
    EXPECT_EQ(cache.decoded(), 1U);
    for (const DecodedCache::Value& value : got) EXPECT_EQ(value, got.front());
    EXPECT_NE(got.front(), nullptr);
}

TEST(DecodedCache, ADecoderMayAskForOtherKeys) {
    DecodedCache cache(100);
    const auto sum = cache.get({0, 2}, [&]() -> Result<DecodedCache::Decoded> {
        const auto one = cache.get({0, 1}, number(20, 1));
        if (!one) return one.error();
        const int value = 1 + *std::static_pointer_cast<const int>(*one);
        return DecodedCache::Decoded{std::make_shared<const int>(value), 1};
    });
    ASSERT_TRUE(sum.has_value());
    EXPECT_EQ(*std::static_pointer_cast<const int>(*sum), 21);
    EXPECT_EQ(cache.bytes(), 2U);
}

}  // namespace
}  // namespace haarmony::video
