#include "engine/image/tail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

TEST(Tail, ScoresTheFirstRecordsThatAreNotRemoved) {
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
        if (slot < kCount && slot != 3) reference[100 - slot] = {signature};
    }
    const Profile profile = *built_in_profile("painted");
    for (const int m : {1, 2, 50, 100}) {
        const Signature& query = tail[3].signature;
        std::vector<Match> found;
        tail.score_all(make_query(query, profile, m), m, kCount, removed, nullptr, found);
        std::ranges::sort(found, better);
        EXPECT_EQ(found, search_literally(reference, query, profile, m, {}).matches);
    }
}

TEST(Tail, OfNoRecordsHasNoScores) {
    const Tail tail(1);
    std::vector<Match> found;
    const Query query = make_query({}, *built_in_profile("painted"), 1);
    tail.score_all(query, 1, 0, nullptr, nullptr, found);
    EXPECT_TRUE(found.empty());
}

TEST(Tail, CountsItsCapacityAsItsBytes) {
    EXPECT_EQ(Tail(10).bytes(), 10 * std::int64_t{sizeof(Record)});
}

}  // namespace
}  // namespace haarmony::image
