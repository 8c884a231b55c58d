// An index that takes over segments: its own again, or those of a file.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "engine/image/index.h"
#include "engine/image/segment.h"
#include "tests/engine/image/segment_bytes.h"

namespace haarmony::image {
namespace {

constexpr IndexOptions kOptions{50, 32};

std::vector<Match> all_matches(const Index& index) {
    std::mt19937 random(7);
    const Query query =
        make_query(random_signature(random, {60, 120}), *built_in_profile("painted"), 40);
    std::vector<Match> matches = index.snapshot()->score_all(query, nullptr);
    std::ranges::sort(matches, better);
    return matches;
}

std::set<ImageId> ids_in(const Index& index) {
    std::set<ImageId> ids;
    for (const Match& match : all_matches(index)) ids.insert(match.id);
    return ids;
}

// Some segments with removals, and a tail with one.
void fill(Index& index, unsigned seed, int count) {
    std::mt19937 random(seed);
    const std::vector<Record> records = make_records(random, count);
    for (std::span<const Record> rest = records; !rest.empty();) {
        const auto some = rest.first(std::min<std::size_t>(rest.size(), 20));
        index.apply(some, {});
        rest = rest.subspan(some.size());
    }
    index.apply({}, std::vector{records[0].id, records[21].id, records.back().id});
}

// A segment in bytes of its own, the first of which the test may have changed.
LiveSegment as_from_file(const Segment& segment, bool damaged) {
    const auto copy = std::make_shared<Copy>(segment);
    if (damaged) std::swap(copy->spans().slots_by_id[0], copy->spans().slots_by_id[1]);
    const auto view = view_known_segment(copy->counts, copy->bytes());
    EXPECT_TRUE(view);
    return {Segment::from_view(view.value(), copy), nullptr};
}

TEST(IndexReset, SealedHasAllThatIsLiveAndLeavesTheIndexAsItIs) {
    Index index(kOptions);
    EXPECT_TRUE(index.snapshot()->sealed().empty());
    fill(index, 1, 150);
    const IndexStats before = index.snapshot()->stats();
    ASSERT_GT(before.tail, 1);
    const std::vector<LiveSegment> sealed = index.snapshot()->sealed();
    EXPECT_EQ(std::int64_t(sealed.size()), before.segments + 1);
    std::int64_t live = 0;
    for (const LiveSegment& part : sealed) live += part.live();
    EXPECT_EQ(live, before.images);
    EXPECT_EQ(index.snapshot()->stats().tail, before.tail);
}

TEST(IndexReset, ATailOfWhichAllIsGoneIsNoSegment) {
    Index index(kOptions);
    std::mt19937 random(1);
    const std::vector<Record> records = make_records(random, 2);
    index.apply(records, {});
    index.apply({}, std::vector{records[0].id, records[1].id});
    EXPECT_TRUE(index.snapshot()->sealed().empty());
}

TEST(IndexReset, AnswersAreThoseOfTheIndexThatTheSegmentsCameFrom) {
    Index index(kOptions);
    fill(index, 2, 150);
    Index other(kOptions);
    fill(other, 3, 40);
    other.reset(index.snapshot()->sealed(), SegmentOrigin::kFile);
    EXPECT_EQ(all_matches(other), all_matches(index));
    EXPECT_EQ(other.snapshot()->stats().tail, 0);

    // It lives on like any other.
    std::mt19937 random(4);
    const std::vector<Record> more = make_records(random, 90);
    for (Index* both : {&index, &other})
        both->apply(more, std::vector{ImageId{4}, ImageId{7}});
    EXPECT_EQ(all_matches(other), all_matches(index));
    while (other.merge_once()) {
    }
    EXPECT_EQ(all_matches(other), all_matches(index));

    other.reset({}, SegmentOrigin::kBuilt);
    EXPECT_TRUE(ids_in(other).empty());
}

TEST(IndexReset, ADamagedSegmentOfAFileIsNeverMergedAndTheOthersAre) {
    std::vector<LiveSegment> segments;
    std::set<ImageId> expected;
    for (unsigned i = 0; i < 6; ++i) {
        Index index(kOptions);
        std::mt19937 random(10 + i);
        std::vector<Record> records = make_records(random, 40);
        for (Record& record : records) {
            record.id = ImageId{to_int(record.id) + 1000 * i};
            expected.insert(record.id);
        }
        segments.push_back(
            as_from_file(*make_segment(records, kOptions.index_m), i == 2));
    }
    const std::shared_ptr<const Segment> damaged = segments[2].segment;
    Index index(kOptions);
    index.reset(std::move(segments), SegmentOrigin::kFile);
    EXPECT_TRUE(index.merge_once());
    EXPECT_FALSE(index.merge_once());
    EXPECT_EQ(index.snapshot()->stats().segments, 2);
    EXPECT_EQ(ids_in(index), expected);
    const std::vector<LiveSegment> left = index.snapshot()->sealed();
    EXPECT_EQ(std::ranges::count(left, damaged, &LiveSegment::segment), 1);
}

TEST(IndexReset, WhereTooManyAreDamagedNothingIsMerged) {
    std::vector<LiveSegment> segments;
    for (unsigned i = 0; i < 4; ++i) {
        std::mt19937 random(20 + i);
        std::vector<Record> records = make_records(random, 40);
        for (Record& record : records) record.id = ImageId{to_int(record.id) + 1000 * i};
        segments.push_back(
            as_from_file(*make_segment(records, kOptions.index_m), i == 0));
    }
    Index index(kOptions);
    index.reset(std::move(segments), SegmentOrigin::kFile);
    EXPECT_FALSE(index.merge_once());
    EXPECT_EQ(index.snapshot()->stats().segments, 4);
}

}  // namespace
}  // namespace haarmony::image
