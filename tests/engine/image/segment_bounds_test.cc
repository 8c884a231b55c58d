// What view_known_segment() must not let pass, and that the search of what it lets pass stays
// inside of the bytes: they end where the memory ends, so that a sanitizer would tell.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "engine/image/collection.h"
#include "engine/image/collection_search.h"
#include "engine/image/segment_layout.h"
#include "tests/engine/image/segment_bytes.h"

namespace haarmony::image {
namespace {

using ::testing::HasSubstr;

constexpr int kIndexM = 50;
constexpr int kSlots = 600;

const Segment& whole() {
    static const std::shared_ptr<const Segment> segment = [] {
        std::mt19937 random(402);
        return make_segment(make_records(random, kSlots), kIndexM);
    }();
    return *segment;
}

void expect_refused(Copy& copy, const std::string& named) {
    const Result<SegmentView> known = view_known_segment(copy.counts, copy.bytes());
    ASSERT_FALSE(known.has_value()) << named;
    EXPECT_EQ(known.error().code, ErrorCode::kUndecodable);
    EXPECT_THAT(known.error().message, HasSubstr("damaged: " + named));
    EXPECT_FALSE(copy.view().has_value()) << named;
}

// Every way to search a segment that reads other sections than the ways before.
void search_all(const SegmentView& view, std::mt19937& random) {
    Collection collection;
    collection.index_m = kIndexM;
    collection.segments.push_back({Segment::from_view(view, nullptr), nullptr});
    collection.tail.records = std::make_shared<Tail>(1);
    for (const int m : {1, 20, 33, 40, 45, kIndexM}) {
        const Query query = make_query(
            random_signature(random, {60, 120}), *built_in_profile("painted"), m);
        for (const bool exhaustive : {false, true}) {
            SearchScope scope;
            scope.limit = 20;
            scope.exhaustive = exhaustive;
            (void)search(collection, query, scope);
        }
        (void)score_all(collection, query, nullptr);
    }
    for (int id = 0; id < 3 * kSlots + 2; ++id)
        (void)collection.segments[0].segment->find(ImageId{id});
}

TEST(KnownSegment, IsTheSameViewAsThatOfACompleteCheck) {
    Copy copy(whole());
    const auto known = view_known_segment(copy.counts, copy.bytes());
    ASSERT_TRUE(known.has_value()) << known.error().message;
    EXPECT_EQ(known->counts, whole().view().counts);
    EXPECT_TRUE(std::ranges::equal(bytes_of(known.value()), bytes_of(whole())));
}

TEST(KnownSegment, BytesOfAViewAreAllBytesOfItsSegment) {
    EXPECT_EQ(bytes_of(whole().view()).size(), whole().bytes().total);
    EXPECT_EQ(bytes_of(whole().view()).data(), bytes_of(whole()).data());
}

TEST(KnownSegment, IsRefusedWhereASearchWouldLeaveTheBytes) {
    const SegmentCounts& counts = whole().view().counts;
    const auto refuse = [](const std::string& named, const auto& damage) {
        Copy copy(whole());
        const SegmentUnderConstruction spans = copy.spans();
        damage(spans);
        expect_refused(copy, named);
    };
    refuse("slot by id 599 is 600", [](auto& spans) { spans.slots_by_id[599] = 600; });
    refuse("directory entry 7", [&](auto& spans) {
        spans.directory[7] = DirectoryEntry::of_dense(int(counts.dense[2])).bits();
    });
    refuse("directory entry 98303", [&](auto& spans) {
        spans.directory[98303] = DirectoryEntry::of_coarse(int(counts.coarse)).bits();
    });
    refuse("begin of slot 1", [](auto& spans) { spans.own_begin[1] = 0xffffffffU; });
    refuse("end of slot 600", [](auto& spans) { ++spans.own_begin[kSlots]; });
    refuse("count of slot 599 is 255",
           [](auto& spans) { spans.own_counts[599][2][2] = 255; });
    const auto last = std::size_t(counts.own_postings - 1);
    for (const int index : {0, kCoefficientCount, -kCoefficientCount, -32768}) {
        refuse("coefficient " + std::to_string(last) + " is " + std::to_string(index),
               [&](auto& spans) { spans.own[last] = std::int16_t(index); });
    }
    const std::size_t places = whole().view().dense_rank_begin.size();
    for (const std::size_t place : {std::size_t{0}, places / 2, places - 1}) {
        refuse("ranks of block " + std::to_string(place) + " is 4294967295",
               [&](auto& spans) { spans.dense_rank_begin[place] = 0xffffffffU; });
        refuse("ranks of block " + std::to_string(place), [&](auto& spans) {
            spans.dense_rank_begin[place] = std::uint32_t(counts.dense_postings);
            // A block without bits has no rank anywhere.
            const std::size_t blocks = std::size_t(counts.blocks());
            spans.rows[2][place / blocks * counts.row_words() +
                          place % blocks * kBlockWords] |= 1;
        });
    }
    refuse("lowest average of block 2",
           [](auto& spans) { spans.lowest[0][2] = spans.highest[0][2] + 1; });
}

TEST(KnownSegment, HasCountsAndASizeThatArePossible) {
    Copy counts(whole());
    counts.counts.slots = kMaxSegmentSlots + 1;
    expect_refused(counts, "its counts are impossible");
    Copy size(whole());
    size.counts.own_postings += 1000;
    expect_refused(size, "its size is");
}

// A row of a lower tier has its ranks where the top one has them: a bit that is not there has
// none, and the last one's would be behind the end.
TEST(KnownSegment, IsRefusedWhereALowerTierHasABitWhoseRankWouldBeBehindTheEnd) {
    Copy copy(whole());
    const SegmentUnderConstruction spans = copy.spans();
    // The last list of the middle tier is made the one that ends where all end.
    const std::size_t list = copy.counts.dense[1] - 1;
    const auto blocks = std::size_t(copy.counts.blocks());
    const std::size_t word = list * copy.counts.row_words();
    spans.dense_rank_begin[list * blocks] =
        std::uint32_t(copy.counts.dense_postings) - 256 + 1;
    spans.rows[1][word] = ~std::uint64_t{0};
    spans.rows[2][word] = 0;
    expect_refused(copy, "bits of list " + std::to_string(list));
}

// Bytes changed at random: refused, or searched without leaving the bytes.
TEST(KnownSegment, SearchesOfDamagedBytesStayInsideOfThem) {
    std::mt19937 random(403);
    int passed = 0;
    for (int round = 0; round < 200; ++round) {
        Copy copy(whole());
        const std::span<std::byte> bytes = copy.bytes();
        const std::size_t changes = 1 + random() % 8;
        for (std::size_t i = 0; i < changes; ++i)
            bytes[random() % bytes.size()] = std::byte(random());
        const auto known = view_known_segment(copy.counts, bytes);
        if (!known) continue;
        ++passed;
        search_all(known.value(), random);
    }
    // Most bytes are bits of rows, and any bits will do.
    EXPECT_GT(passed, 50);
}

// Files are read by what this says: another answer here asks for another version.
TEST(KnownSegment, LayoutIsTheOneOfItsVersion) {
    SegmentCounts counts;
    counts.index_m = 60;
    counts.slots = 1000;
    counts.dense = {10, 20, 30};
    counts.coarse = 40;
    counts.dense_postings = 5000;
    counts.own_postings = 6000;
    const AlignedBytes memory{AlignedBytes{
        std::unique_ptr<std::byte[], AlignedBytesDeleter>(
            new (std::align_val_t{64}) std::byte[segment_bytes(counts).total]),
        segment_bytes(counts).total}};
    const SegmentView view = spans_of(counts, std::span<const std::byte>(memory.span()));
    const auto offset = [&](const auto& section) {
        return reinterpret_cast<const std::byte*>(section.data()) - memory.bytes.get();
    };
    EXPECT_EQ(kSegmentLayoutVersion, 1U);
    const std::vector<std::ptrdiff_t> offsets{offset(view.terms),
                                              offset(view.ids),
                                              offset(view.slots_by_id),
                                              offset(view.lowest[0]),
                                              offset(view.highest[0]),
                                              offset(view.directory),
                                              offset(view.rows[0]),
                                              offset(view.presence[0]),
                                              offset(view.rows[2]),
                                              offset(view.coarse_rows),
                                              offset(view.own_begin),
                                              offset(view.own_counts),
                                              offset(view.own),
                                              offset(view.dense_keys),
                                              offset(view.dense_rank_begin),
                                              offset(view.dense_ranks),
                                              offset(view.own_ranks)};
    EXPECT_EQ(offsets,
              (std::vector<std::ptrdiff_t>{0,
                                           16000,
                                           24000,
                                           28032,
                                           28224,
                                           28416,
                                           225024,
                                           226944,
                                           231744,
                                           238464,
                                           241024,
                                           245056,
                                           254080,
                                           266112,
                                           266240,
                                           266752,
                                           271808}));
}

}  // namespace
}  // namespace haarmony::image
