#include "server/app/variant_indexes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "engine/image/query.h"

namespace haarmony::server {
namespace {

using Ids = std::set<std::int64_t>;

SearchablePicture picture(std::int64_t id, const std::vector<std::string>& variants) {
    SearchablePicture made{ImageId{id}, 0, {}};
    for (const std::string& variant : variants) made.signatures[variant] = {};
    return made;
}

Ids ids_in(const VariantIndexes& indexes, const std::string& variant) {
    const image::Query query =
        image::make_query({}, *image::built_in_profile("painted"), 1);
    Ids ids;
    for (const image::Match& match :
         indexes.snapshots().at(variant)->score_all(query, nullptr))
        ids.insert(to_int(match.id));
    return ids;
}

TEST(VariantIndexes, StartWithTheMainOne) {
    const VariantIndexes indexes({});
    const Snapshots snapshots = indexes.snapshots();
    ASSERT_EQ(snapshots.size(), 1U);
    EXPECT_EQ(snapshots.begin()->first, "yiq-standard");
    EXPECT_EQ(total_stats(snapshots).images, 0);
    EXPECT_EQ(indexes.index_m(), 60);
}

TEST(VariantIndexes, APictureIsInTheIndexesOfItsSignaturesAlone) {
    VariantIndexes indexes({});
    indexes.apply(std::vector{picture(1, {"yiq-standard", "lab-standard"}),
                              picture(2, {"yiq-standard"}),
                              picture(3, {"lab-standard"})},
                  {});
    EXPECT_EQ(ids_in(indexes, "yiq-standard"), (Ids{1, 2}));
    EXPECT_EQ(ids_in(indexes, "lab-standard"), (Ids{1, 3}));

    // Picture 1 lost one signature, 2 got one, 3 went.
    indexes.apply(std::vector{picture(1, {"yiq-standard"}),
                              picture(2, {"yiq-standard", "lab-standard"})},
                  std::vector{ImageId{3}});
    EXPECT_EQ(ids_in(indexes, "yiq-standard"), (Ids{1, 2}));
    EXPECT_EQ(ids_in(indexes, "lab-standard"), (Ids{2}));
}

TEST(VariantIndexes, CountPicturesOnceAndBytesOfAll) {
    VariantIndexes indexes({});
    const std::int64_t empty = total_stats(indexes.snapshots()).bytes;
    indexes.apply(std::vector{picture(1, {"yiq-standard", "rgb-standard"})}, {});
    const image::IndexStats stats = total_stats(indexes.snapshots());
    EXPECT_EQ(stats.images, 1);
    EXPECT_EQ(stats.tail, 2);
    EXPECT_EQ(stats.bytes, 2 * empty);
}

TEST(VariantIndexes, MergeAllOfThem) {
    VariantIndexes indexes({.index_m = 1, .tail_capacity = 1});
    for (std::int64_t id = 1; id <= 40; ++id)
        indexes.apply(std::vector{picture(2 * id, {"yiq-standard", "hsv-standard"}),
                                  picture(2 * id + 1, {"yiq-standard", "hsv-standard"})},
                      {});
    EXPECT_EQ(total_stats(indexes.snapshots()).segments, 80);
    while (indexes.merge_once()) {
    }
    for (const auto& [variant, snapshot] : indexes.snapshots())
        EXPECT_LT(snapshot->stats().segments, 10) << variant;
    EXPECT_EQ(total_stats(indexes.snapshots()).images, 80);
}

}  // namespace
}  // namespace haarmony::server
