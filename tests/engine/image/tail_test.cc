#include "engine/image/tail.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

TEST(Tail, SearchesTheFirstRecordsThatAreNotRemoved) {
    constexpr int kCapacity = 12;
    constexpr int kCount = 9;
    std::mt19937 random(131);
    Tail tail(kCapacity);
    auto removed = std::make_shared<Tombstones>(kCapacity);
    removed->set(3);
    Reference reference;
    for (int slot = 0; slot < kCapacity; ++slot) {
        const Signature signature =
            random_signature(random, {.max_index = 120, .average_steps = 2});
        tail.write(slot, {ImageId{100 - slot}, signature});
        if (slot < kCount && slot != 3) reference[100 - slot] = signature;
    }
    const Profile profile = *built_in_profile("painted");
    for (const int m : {1, 2, 50, 100}) {
        const Signature& query = tail[3].signature;
        TopK top(20);
        tail.search(make_query(query, profile, m), m, kCount, removed, top);
        EXPECT_EQ(top.take(), search_literally(reference, query, profile, m, 20).matches);
    }
}

TEST(Tail, OfNoRecordsOffersNothing) {
    const Tail tail(1);
    TopK top(5);
    tail.search(make_query({}, *built_in_profile("painted"), 1), 1, 0, nullptr, top);
    EXPECT_TRUE(top.take().empty());
}

TEST(Tail, CountsItsCapacityAsItsBytes) {
    EXPECT_EQ(Tail(10).bytes(), 10 * std::int64_t{sizeof(Record)});
}

}  // namespace
}  // namespace haarmony::image
