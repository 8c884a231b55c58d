#include "engine/image/id_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

namespace haarmony::image {
namespace {

TEST(IdSet, HoldsItsIdsAndNoOther) {
    for (const std::vector<std::int64_t>& ids :
         {std::vector<std::int64_t>{}, {5}, {70, 3, 3, 64, 200}, {1, 1'000'000}}) {
        std::vector<ImageId> members;
        for (const std::int64_t id : ids) members.push_back(ImageId{id});
        const IdSet set(members);
        for (const std::int64_t id : {-1L,
                                      0L,
                                      1L,
                                      2L,
                                      3L,
                                      4L,
                                      5L,
                                      6L,
                                      63L,
                                      64L,
                                      70L,
                                      199L,
                                      200L,
                                      1'000'000L,
                                      1'000'064L}) {
            EXPECT_EQ(set.contains(ImageId{id}), std::ranges::count(ids, id) > 0) << id;
        }
    }
}

std::vector<std::int64_t> visited(const IdSet& set) {
    std::vector<std::int64_t> ids;
    set.for_each([&ids](ImageId id) { ids.push_back(to_int(id)); });
    return ids;
}

TEST(IdSet, VisitsEachIdOnceRising) {
    std::mt19937 random(431);
    for (const std::int64_t first : {std::int64_t{-200},
                                     std::int64_t{1},
                                     std::numeric_limits<std::int64_t>::max() - 999}) {
        for (const int count : {0, 1, 2, 64, 700}) {
            std::vector<ImageId> members;
            std::set<std::int64_t> distinct;
            for (int i = 0; i < count; ++i) {
                const std::int64_t id = first + random() % 1000;
                members.push_back(ImageId{id});
                distinct.insert(id);
            }
            const IdSet set(members);
            EXPECT_EQ(visited(set), std::vector(distinct.begin(), distinct.end()))
                << first;
            EXPECT_EQ(set.size(), std::ssize(distinct)) << first;
        }
    }
}

TEST(IdSet, VisitsBothEndsOfItsWords) {
    const std::vector<std::int64_t> ids = {10, 73, 74, 137, 138, 10 + 64 * 5};
    std::vector<ImageId> members;
    for (const std::int64_t id : ids) members.push_back(ImageId{id});
    EXPECT_EQ(visited(IdSet(members)), ids);
}

TEST(IdSet, OfNothingHoldsAndVisitsNothing) {
    EXPECT_EQ(IdSet().size(), 0);
    EXPECT_TRUE(visited(IdSet()).empty());
    EXPECT_FALSE(IdSet().contains(ImageId{0}));
}

}  // namespace
}  // namespace haarmony::image
