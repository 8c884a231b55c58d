#include "engine/image/segment.h"

#include <gtest/gtest.h>

#include <random>

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

std::vector<Match> search_all(const Segment& segment,
                              const TombstonesPtr& removed,
                              const Query& query) {
    TopK top(1000);
    SegmentScores scores;
    EXPECT_EQ(segment.search(query, removed, nullptr, scores, top),
              segment.size() - removed_count(removed));
    return top.take();
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
    EXPECT_EQ(segment->find(ImageId{3}), 0);
    EXPECT_EQ(segment->find(ImageId{9}), 2);
    EXPECT_EQ(segment->find(ImageId{12}), 3);
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
    EXPECT_EQ(search_all(*segment,
                         removed_slots(*segment, {1, 4}),
                         make_query(query, profile, kIndexM)),
              search_literally(reference, query, profile, kIndexM, {}).matches);
}

TEST(Segment, MergedSearchesLikeTheLiveRecordsOfItsParts) {
    const std::vector<std::vector<Record>> records = {random_records({2, 5, 6, 11}, 123),
                                                      random_records({1, 5, 8}, 124),
                                                      random_records({3}, 125)};
    // Picture 5 was replaced: the version of the first part is gone.
    const std::vector<std::vector<int>> removed = {{1, 3}, {}, {}};
    std::vector<LiveSegment> parts;
    Reference reference;
    for (std::size_t p = 0; p < records.size(); ++p) {
        const auto segment = segment_of(records[p]);
        parts.push_back({segment, removed_slots(*segment, removed[p])});
        for (int slot = 0; slot < segment->size(); ++slot) {
            if (is_removed(parts[p].removed, slot)) continue;
            reference[to_int(segment->id(slot))] = {records[p][slot].signature};
        }
    }
    const auto merged = Segment::merge(parts);
    ASSERT_NE(merged, nullptr);
    EXPECT_EQ(merged->size(), int(reference.size()));
    const Profile profile = *built_in_profile("painted");
    for (int m = 1; m <= kIndexM; ++m) {
        const Signature& query = records[0][2].signature;
        EXPECT_EQ(search_all(*merged, nullptr, make_query(query, profile, m)),
                  search_literally(reference, query, profile, m, {}).matches)
            << "m " << m;
    }
}

TEST(Segment, MergeOfNothingLiveIsNothing) {
    const auto segment = segment_of(random_records({1, 2}, 126));
    const std::vector<LiveSegment> parts = {{segment, removed_slots(*segment, {0, 1})}};
    EXPECT_EQ(Segment::merge(parts), nullptr);
}

TEST(Segment, CountsArraysIdsAndColumns) {
    const auto one = segment_of(random_records({1}, 127));
    std::vector<Record> twice = random_records({1}, 127);
    twice.push_back(twice[0]);
    twice[1].id = ImageId{2};
    std::int64_t postings = 0;
    for (const ChannelSignature& channel : twice[0].signature.channels) {
        postings += std::min<int>(kIndexM, channel.count);
    }
    EXPECT_EQ(segment_of(twice)->bytes() - one->bytes(), 3 * postings + 8 + 4 * 4);
}

}  // namespace
}  // namespace haarmony::image
