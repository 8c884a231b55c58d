#include "server/app/reply_cache.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace haarmony::server {
namespace {

ReplyCache::Reply reply(std::size_t bytes) {
    auto made = std::make_shared<PictureReply>();
    made->bytes.assign(bytes, 'x');
    return made;
}

TEST(ReplyCache, FindsByKeyAndKnowsEverySpellingThatAskedForIt) {
    ReplyCache cache(1'000'000);
    const auto kept = reply(10);
    cache.put(1, "key", "spelling", kept);
    EXPECT_EQ(cache.find("key", "other"), kept);
    EXPECT_EQ(cache.find("other key", "x"), nullptr);
    EXPECT_TRUE(cache.knows("spelling"));
    EXPECT_TRUE(cache.knows("other"));
    EXPECT_FALSE(cache.knows("x"));
    EXPECT_FALSE(cache.knows("key"));
}

TEST(ReplyCache, TheLongestUnusedGoesWhereThereIsNoRoom) {
    ReplyCache cache(30'000);
    for (const char* key : {"a", "b", "c"}) cache.put(1, key, key, reply(9'000));
    ASSERT_NE(cache.find("a", "a"), nullptr);
    cache.put(1, "d", "d", reply(9'000));
    EXPECT_EQ(cache.find("b", "b"), nullptr);
    EXPECT_FALSE(cache.knows("b"));
    for (const char* key : {"a", "c", "d"}) EXPECT_NE(cache.find(key, key), nullptr);
    EXPECT_LE(cache.bytes(), 30'000u);
    // Larger than all the room.
    cache.put(1, "e", "e", reply(40'000));
    EXPECT_EQ(cache.find("e", "e"), nullptr);
    EXPECT_EQ(cache.bytes(), 0u);
}

TEST(ReplyCache, ForgetsAVideoAndNoOther) {
    ReplyCache cache(1'000'000);
    cache.put(1, "a", "a1", reply(10));
    cache.put(2, "b", "b1", reply(10));
    cache.put(1, "c", "c1", reply(10));
    cache.forget(1);
    EXPECT_EQ(cache.find("a", ""), nullptr);
    EXPECT_EQ(cache.find("c", ""), nullptr);
    EXPECT_FALSE(cache.knows("a1"));
    EXPECT_NE(cache.find("b", "b1"), nullptr);
}

// Or a client that spells one address in ever new ways would fill the memory.
TEST(ReplyCache, SpellingsAreCountedAndBounded) {
    ReplyCache cache(1'000'000);
    cache.put(1, "key", "0", reply(10));
    for (int i = 1; i < 1'000; ++i)
        ASSERT_NE(cache.find("key", std::string(100, 'x') + std::to_string(i)), nullptr);
    EXPECT_LT(cache.bytes(), 3'000u);
    cache.put(1, "key", "0", reply(10));
    cache.forget(1);
    EXPECT_EQ(cache.bytes(), 0u);
}

}  // namespace
}  // namespace haarmony::server
