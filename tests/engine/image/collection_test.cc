#include "engine/image/collection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/image/collection_search.h"

namespace haarmony::image {
namespace {

// Pictures with nothing but an id.
LiveSegment segment_of(const std::vector<std::int64_t>& ids) {
    std::vector<Record> records;
    for (const std::int64_t id : ids) records.push_back({ImageId{id}, {}});
    std::vector<const Record*> pointers;
    for (const Record& record : records) pointers.push_back(&record);
    return {Segment::from_records(pointers, 1), nullptr};
}

Collection collection_of(std::vector<LiveSegment> segments) {
    return {1, std::move(segments), {std::make_shared<Tail>(1), 0, nullptr}};
}

std::vector<std::int64_t> live_ids(const Collection& collection) {
    const Query query = make_query({}, *built_in_profile("painted"), 1);
    std::vector<std::int64_t> ids;
    for (const Match& match : search(collection, query, {1000}).matches) {
        ids.push_back(to_int(match.id));
    }
    return ids;
}

using Ids = std::vector<std::int64_t>;

TEST(Collection, RemovingLeavesCopiesTakenBeforeAsTheyWere) {
    Collection collection = collection_of({segment_of({1, 2, 3}), segment_of({4, 5})});
    const Collection before = collection;
    remove(collection, std::vector{ImageId{2}, ImageId{5}, ImageId{5}, ImageId{77}});
    EXPECT_EQ(live_ids(collection), (Ids{1, 3, 4}));
    const Collection between = collection;
    remove(collection, std::vector{ImageId{3}});
    EXPECT_EQ(live_ids(collection), (Ids{1, 4}));
    EXPECT_EQ(live_ids(between), (Ids{1, 3, 4}));
    EXPECT_EQ(live_ids(before), (Ids{1, 2, 3, 4, 5}));
}

TEST(Collection, RemovingManyCopiesTheTombstonesOfASegmentOnce) {
    Collection collection = collection_of({segment_of({1, 2, 3}), segment_of({4, 5})});
    remove(collection, std::vector{ImageId{1}});
    const TombstonesPtr first = collection.segments[0].removed;
    remove(collection, std::vector{ImageId{4}});
    EXPECT_EQ(collection.segments[0].removed, first);
    EXPECT_EQ(removed_count(collection.segments[0].removed), 1);
}

TEST(Collection, RemovesTheLiveVersionOfAReplacedPicture) {
    Collection collection = collection_of({segment_of({7})});
    remove(collection, std::vector{ImageId{7}});
    collection.segments.push_back(segment_of({7}));
    EXPECT_EQ(live_ids(collection), (Ids{7}));
    remove(collection, std::vector{ImageId{7}});
    EXPECT_EQ(live_ids(collection), Ids{});
}

TEST(Collection, AMergeKeepsRemovalsThatCameMeanwhile) {
    Collection collection =
        collection_of({segment_of({1, 2, 3}), segment_of({9}), segment_of({4, 5})});
    remove(collection, std::vector{ImageId{1}});
    const std::vector<LiveSegment> parts = {collection.segments[0],
                                            collection.segments[2]};
    const auto merged = Segment::merge(parts);
    remove(collection, std::vector{ImageId{3}, ImageId{4}, ImageId{9}});
    collection.segments.push_back(segment_of({3}));

    replace_segments(collection, parts, merged);
    EXPECT_EQ(live_ids(collection), (Ids{2, 3, 5}));
    EXPECT_EQ(collection.segments.size(), 3U);
    EXPECT_EQ(stats(collection).tombstones, 3);
}

TEST(Collection, AMergeOfWhatIsGoneMeanwhileLeavesNothing) {
    Collection collection = collection_of({segment_of({1}), segment_of({2})});
    const std::vector<LiveSegment> parts = collection.segments;
    const auto merged = Segment::merge(parts);
    remove(collection, std::vector{ImageId{1}, ImageId{2}});
    replace_segments(collection, parts, merged);
    EXPECT_TRUE(collection.segments.empty());

    collection.segments = {segment_of({3})};
    remove(collection, std::vector{ImageId{3}});
    const std::vector<LiveSegment> gone = collection.segments;
    replace_segments(collection, gone, Segment::merge(gone));
    EXPECT_TRUE(collection.segments.empty());
}

}  // namespace
}  // namespace haarmony::image
