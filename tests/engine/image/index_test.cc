#include "engine/image/index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/image/segment.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

// An index and the plain map that it must agree with.
class Twin {
  public:
    explicit Twin(const IndexOptions& options) : index_(options) {}

    void apply(const std::vector<Record>& upserts, const std::vector<ImageId>& removals) {
        for (const Record& record : upserts) {
            reference_[to_int(record.id)] = {record.signature, record.log_aspect};
        }
        for (const ImageId id : removals) reference_.erase(to_int(id));
        index_.apply(upserts, removals);
    }

    void expect_equal(const Signature& signature, int m, const Wanted& wanted) const {
        std::vector<ImageId> ids;
        for (const std::int64_t id : wanted.only.value_or(std::set<std::int64_t>{})) {
            ids.push_back(ImageId{id});
        }
        const IdSet only(ids);
        const SearchScope scope{wanted.limit, wanted.only ? &only : nullptr};
        for (const char* name : {"painted", "scanned"}) {
            const Profile profile = *built_in_profile(name);
            SCOPED_TRACE(testing::Message()
                         << name << ", m " << m << ", limit " << wanted.limit);
            const SearchResult expected =
                search_literally(reference_, signature, profile, m, wanted);
            Query query = make_query(signature, profile, m);
            query.log_aspect = wanted.log_aspect;
            query.aspect_weight = wanted.aspect_weight;
            const SearchResult found = index_.snapshot()->search(query, scope);
            ASSERT_EQ(found.matches, expected.matches);
            ASSERT_EQ(found.searched, expected.searched);
            SearchScope exhaustive = scope;
            exhaustive.exhaustive = true;
            ASSERT_EQ(index_.snapshot()->search(query, exhaustive).matches,
                      expected.matches);

            std::vector<Match> all = index_.snapshot()->score_all(query, scope.only);
            ASSERT_EQ(std::int64_t(all.size()), expected.searched);
            std::ranges::sort(all, better);
            all.resize(std::min(all.size(), std::size_t(wanted.limit)));
            ASSERT_EQ(all, expected.matches);
        }
    }

    Index& index() { return index_; }
    [[nodiscard]] const Reference& reference() const { return reference_; }

  private:
    Index index_;
    Reference reference_;
};

struct Settings {
    IndexOptions options;
    SignatureShape shape;
    unsigned seed;
};

class IndexUnderRandomChanges : public testing::TestWithParam<Settings> {};

// Small ranges of ids, places and averages: pictures are replaced and removed all the time,
// lists are long, and scores tie.
TEST_P(IndexUnderRandomChanges, FindsWhatTheMetricFinds) {
    const Settings& settings = GetParam();
    std::mt19937 random(settings.seed);
    const auto below = [&random](int bound) {
        return static_cast<int>(random() % bound);
    };
    Twin twin(settings.options);
    for (int step = 0; step < 60; ++step) {
        std::vector<Record> upserts;
        std::vector<ImageId> removals;
        for (int i = below(7); i > 0; --i) {
            upserts.push_back({ImageId{1 + below(40)},
                               random_signature(random, settings.shape),
                               below(3) * 1000});
        }
        for (int i = below(5); i > 0; --i) removals.push_back(ImageId{1 + below(45)});
        twin.apply(upserts, removals);
        if (below(3) == 0) twin.index().merge_once();

        const Signature query = random_signature(random, settings.shape);
        const int m = 1 + below(settings.options.index_m);
        Wanted wanted{.limit = below(int(twin.reference().size()) + 5)};
        twin.expect_equal(query, m, wanted);
        wanted.log_aspect = 1500;
        wanted.aspect_weight = 1 + below(200);
        wanted.only.emplace();
        for (int i = below(20); i > 0; --i) wanted.only->insert(1 + below(60));
        twin.expect_equal(query, m, wanted);
        if (HasFatalFailure()) FAIL() << "step " << step;
        EXPECT_EQ(twin.index().snapshot()->stats().images,
                  std::int64_t(twin.reference().size()));
    }
    const Signature query = random_signature(random, settings.shape);
    for (int limit = 0; limit <= int(twin.reference().size()) + 5; ++limit) {
        twin.expect_equal(query, settings.options.index_m, {.limit = limit});
    }
    for (int m = 1; m <= settings.options.index_m; ++m) twin.expect_equal(query, m, {});
}

INSTANTIATE_TEST_SUITE_P(
    Settings,
    IndexUnderRandomChanges,
    testing::Values(Settings{{.index_m = 60, .tail_capacity = 4}, {20, 40, 2}, 151},
                    Settings{{.index_m = 5, .tail_capacity = 1}, {20, 40, 2}, 152},
                    Settings{{.index_m = 100, .tail_capacity = 7}, {100, 200, 3}, 153},
                    Settings{{.index_m = 60, .tail_capacity = 1000}, {60, 90, 1}, 154},
                    Settings{{.index_m = 1, .tail_capacity = 3}, {3, 3, 1}, 155}));

Record record_of(std::int64_t id, int average) {
    Record record{ImageId{id}, {}};
    record.signature.channels[0].average = average;
    return record;
}

SearchResult search_all(const Index& index) {
    return index.snapshot()->search(make_query({}, *built_in_profile("painted"), 1),
                                    {1000});
}

std::vector<Record> records_of(int count) {
    std::vector<Record> records;
    for (int id = 1; id <= count; ++id) records.push_back(record_of(id, id));
    return records;
}

TEST(Index, StartsEmpty) {
    const Index index({});
    EXPECT_EQ(index.index_m(), 60);
    const SearchResult result = search_all(index);
    EXPECT_TRUE(result.matches.empty());
    EXPECT_EQ(result.searched, 0);
    const IndexStats stats = index.snapshot()->stats();
    EXPECT_EQ(stats.images, 0);
    EXPECT_EQ(stats.segments, 0);
    EXPECT_EQ(stats.tail, 0);
    EXPECT_GT(stats.bytes, 0);
}

TEST(Index, LaterEntriesOfACallWinAndRemovalsComeLast) {
    Index index({});
    index.apply(std::vector{record_of(1, 10), record_of(2, 20), record_of(1, 30)},
                std::vector{ImageId{2}});
    const SearchResult result = search_all(index);
    ASSERT_EQ(result.matches.size(), 1U);
    EXPECT_EQ(result.matches[0], (Match{ImageId{1}, 404 * 30}));
}

TEST(Index, UnknownRemovalsAreNoError) {
    Index index({});
    index.apply({}, std::vector{ImageId{5}, ImageId{5}});
    index.apply(std::vector{record_of(5, 1)}, {});
    EXPECT_EQ(search_all(index).searched, 1);
}

TEST(Index, ASnapshotStaysAsItWas) {
    Index index({.index_m = 60, .tail_capacity = 2});
    const auto empty = index.snapshot();
    index.apply(std::vector{record_of(1, 1)}, {});
    const auto one = index.snapshot();
    for (int id = 2; id < 40; ++id) {
        index.apply(std::vector{record_of(id, 1)}, std::vector{ImageId{id - 1}});
        while (index.merge_once()) {
        }
    }
    const Query query = make_query({}, *built_in_profile("painted"), 1);
    EXPECT_EQ(empty->search(query, {9}).searched, 0);
    EXPECT_EQ(one->search(query, {9}).matches, (std::vector<Match>{{ImageId{1}, 404}}));
    EXPECT_EQ(search_all(index).matches, (std::vector<Match>{{ImageId{39}, 404}}));
}

TEST(Index, SealsTheTailWhenItIsFull) {
    Index index({.index_m = 60, .tail_capacity = 3});
    index.apply(records_of(3), {});
    EXPECT_EQ(index.snapshot()->stats().segments, 0);
    EXPECT_EQ(index.snapshot()->stats().tail, 3);
    index.apply(std::vector{record_of(4, 4)}, std::vector{ImageId{1}});
    const IndexStats stats = index.snapshot()->stats();
    EXPECT_EQ(stats.segments, 1);
    EXPECT_EQ(stats.tail, 0);
    EXPECT_EQ(stats.images, 3);
    EXPECT_EQ(stats.tombstones, 0);
}

TEST(Index, AHugeLoadIsSealedAtOnceInFullSegments) {
    Index index({.index_m = 1, .tail_capacity = 10});
    constexpr int kCount = kMaxSegmentSlots + 100;
    index.apply(records_of(kCount), {});
    const IndexStats stats = index.snapshot()->stats();
    EXPECT_EQ(stats.images, kCount);
    EXPECT_EQ(stats.segments, 2);
    EXPECT_EQ(stats.tail, 0);
    const Query query = make_query({}, *built_in_profile("painted"), 1);
    const auto best = index.snapshot()->search(query, {2}).matches;
    EXPECT_EQ(best, (std::vector<Match>{{ImageId{1}, 404}, {ImageId{2}, 808}}));
    EXPECT_FALSE(index.merge_once());
}

TEST(Index, MergingEndsWithFewSegmentsAndNoTombstones) {
    Index index({.index_m = 60, .tail_capacity = 1});
    for (int id = 1; id <= 64; ++id) {
        index.apply(std::vector{record_of(id, id), record_of(id + 100, id)}, {});
    }
    EXPECT_EQ(index.snapshot()->stats().segments, 64);
    std::vector<ImageId> removals;
    for (int id = 1; id <= 64; ++id) removals.push_back(ImageId{id});
    index.apply({}, removals);
    EXPECT_EQ(index.snapshot()->stats().tombstones, 64);
    const SearchResult before = search_all(index);
    int merges = 0;
    while (index.merge_once()) ++merges;
    const IndexStats stats = index.snapshot()->stats();
    EXPECT_GT(merges, 0);
    EXPECT_LE(stats.segments, 6);
    EXPECT_EQ(stats.tombstones, 0);
    EXPECT_EQ(stats.images, 64);
    EXPECT_EQ(search_all(index).matches, before.matches);
}

TEST(Index, OfRemovedPicturesMergesToNothing) {
    Index index({.index_m = 60, .tail_capacity = 1});
    index.apply(records_of(5), {});
    std::vector<ImageId> all;
    for (int id = 1; id <= 5; ++id) all.push_back(ImageId{id});
    index.apply({}, all);
    EXPECT_TRUE(index.merge_once());
    EXPECT_FALSE(index.merge_once());
    EXPECT_EQ(index.snapshot()->stats().segments, 0);
    EXPECT_EQ(search_all(index).searched, 0);
}

TEST(Index, BytesAreThoseOfItsSegmentsAndItsTail) {
    Index index({.index_m = 60, .tail_capacity = 1});
    std::mt19937 random(161);
    std::vector<Record> records;
    std::vector<const Record*> pointers;
    for (int id = 1; id <= 2000; ++id)
        records.push_back({ImageId{id}, random_signature(random, {.max_index = 4000})});
    for (const Record& record : records) pointers.push_back(&record);
    const IndexStats empty = index.snapshot()->stats();
    index.apply(records, {});
    const IndexStats stats = index.snapshot()->stats();
    const SegmentBytes bytes = Segment::from_records(pointers, 60)->bytes();
    EXPECT_EQ(stats.bytes - empty.bytes, std::int64_t(bytes.total));
    EXPECT_EQ(stats.rank_bytes, std::int64_t(bytes.total - bytes.without_ranks));
}

}  // namespace
}  // namespace haarmony::image
