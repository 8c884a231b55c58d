#include "engine/image/segment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/image/collection.h"
#include "engine/image/collection_search.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

constexpr int kIndexM = 40;
constexpr SignatureShape kShape{.max_count = 50, .max_index = 80, .average_steps = 3};

std::vector<Record> random_records(const std::vector<std::int64_t>& ids, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Record> records;
    for (const std::int64_t id : ids) {
        records.push_back({ImageId{id}, random_signature(random, kShape)});
    }
    return records;
}

std::shared_ptr<const Segment> segment_of(const std::vector<Record>& records) {
    std::vector<const Record*> pointers;
    for (const Record& record : records) pointers.push_back(&record);
    return Segment::from_records(pointers, kIndexM);
}

TombstonesPtr removed_slots(const Segment& segment, const std::vector<int>& slots) {
    auto removed = std::make_shared<Tombstones>(segment.size());
    for (const int slot : slots) removed->set(slot);
    return removed;
}

// The search of a collection of this segment alone.
std::vector<Match> search_all(const std::shared_ptr<const Segment>& segment,
                              const TombstonesPtr& removed,
                              const Query& query) {
    Collection collection;
    collection.index_m = kIndexM;
    collection.segments.push_back({segment, removed});
    collection.tail = {std::make_shared<Tail>(1), 0, nullptr};
    const SearchResult result = search(collection, query, {.limit = 1000});
    EXPECT_EQ(result.searched, segment->size() - removed_count(removed));
    return result.matches;
}

// The slots of some ids.
std::vector<int> slots_of(const Segment& segment, const std::vector<std::int64_t>& ids) {
    std::vector<int> slots;
    for (const std::int64_t id : ids) slots.push_back(*segment.find(ImageId{id}));
    return slots;
}

TEST(Tombstones, AreOneBitEach) {
    Tombstones tombstones(130);
    for (const int slot : {0, 63, 64, 129}) {
        EXPECT_FALSE(tombstones.test(slot));
        tombstones.set(slot);
        EXPECT_TRUE(tombstones.test(slot));
    }
    EXPECT_EQ(tombstones.count(), 4);
    EXPECT_FALSE(tombstones.test(1));
    EXPECT_EQ(tombstones.bytes(), 3 * 8);
}

TEST(Segment, FindsEveryIdAndNoOther) {
    const auto segment = segment_of(random_records({3, 4, 9, 12}, 121));
    for (const std::int64_t id : {3, 4, 9, 12}) {
        const std::optional<int> slot = segment->find(ImageId{id});
        ASSERT_TRUE(slot) << id;
        EXPECT_EQ(segment->id(*slot), ImageId{id});
    }
    for (const std::int64_t id : {1, 5, 10, 13}) {
        EXPECT_EQ(segment->find(ImageId{id}), std::nullopt) << id;
    }
}

TEST(Segment, RemovedImageNeverMatches) {
    const std::vector<Record> records = random_records({1, 2, 3, 4, 5}, 122);
    const auto segment = segment_of(records);
    Reference reference;
    for (const Record& record : records)
        reference[to_int(record.id)] = {record.signature};
    reference.erase(2);
    reference.erase(5);
    const Profile profile = *built_in_profile("scanned");
    const Signature& query = records[1].signature;
    EXPECT_EQ(search_all(segment,
                         removed_slots(*segment, slots_of(*segment, {2, 5})),
                         make_query(query, profile, kIndexM)),
              search_literally(reference, query, profile, kIndexM, {}).matches);
}

TEST(Segment, MergedSearchesLikeTheLiveRecordsOfItsParts) {
    const std::vector<std::vector<Record>> records = {random_records({2, 5, 6, 11}, 123),
                                                      random_records({1, 5, 8}, 124),
                                                      random_records({3}, 125)};
    // Picture 5 was replaced: the version of the first part is gone.
    const std::vector<std::vector<std::int64_t>> removed = {{5, 11}, {}, {}};
    std::vector<LiveSegment> parts;
    Reference reference;
    for (std::size_t p = 0; p < records.size(); ++p) {
        const auto segment = segment_of(records[p]);
        parts.push_back(
            {segment, removed_slots(*segment, slots_of(*segment, removed[p]))});
        for (const Record& record : records[p]) {
            if (!std::ranges::count(removed[p], to_int(record.id)))
                reference[to_int(record.id)] = {record.signature};
        }
    }
    const auto merged = Segment::merge(parts);
    ASSERT_NE(merged, nullptr);
    EXPECT_EQ(merged->size(), int(reference.size()));
    const Profile profile = *built_in_profile("painted");
    for (int m = 1; m <= kIndexM; ++m) {
        const Signature& query = records[0][2].signature;
        EXPECT_EQ(search_all(merged, nullptr, make_query(query, profile, m)),
                  search_literally(reference, query, profile, m, {}).matches)
            << "m " << m;
    }
}

TEST(Segment, MergeOfNothingLiveIsNothing) {
    const auto segment = segment_of(random_records({1, 2}, 126));
    const std::vector<LiveSegment> parts = {{segment, removed_slots(*segment, {0, 1})}};
    EXPECT_EQ(Segment::merge(parts), nullptr);
}

TEST(Segment, KeepsItsRanksBehindWhatEverySearchReads) {
    const auto segment = segment_of(random_records({1, 2, 3}, 127));
    const SegmentBytes bytes = segment->bytes();
    const SegmentView& view = segment->view();
    const auto* const begin = reinterpret_cast<const std::byte*>(view.terms.data());
    EXPECT_EQ(reinterpret_cast<const std::byte*>(view.dense_keys.data()) - begin,
              std::ptrdiff_t(bytes.without_ranks));
    EXPECT_EQ(bytes.total, segment_bytes(view.counts).total);
    EXPECT_GT(bytes.total, bytes.without_ranks);
}

}  // namespace
}  // namespace haarmony::image
