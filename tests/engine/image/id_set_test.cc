#include "engine/image/id_set.h"

#include <gtest/gtest.h>

#include <algorithm>

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

}  // namespace
}  // namespace haarmony::image
