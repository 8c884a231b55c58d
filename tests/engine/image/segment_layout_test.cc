#include "engine/image/segment_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/image/profile.h"
#include "engine/image/segment.h"
#include "engine/image/segment_search.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

using ::testing::HasSubstr;

// Few places: some lists are popular. Many places: all others are rare.
std::vector<Record> make_records(std::mt19937& random, int count) {
    std::vector<Record> records;
    for (int i = 0; i < count; ++i) {
        const SignatureShape popular{60, 120};
        const SignatureShape rare{60};
        Record record;
        record.id = ImageId{3 * i + 1};
        record.signature = random_signature(random, i % 3 == 0 ? rare : popular);
        record.log_aspect = i;
        records.push_back(record);
    }
    return records;
}

std::shared_ptr<const Segment> make_segment(std::span<const Record> records,
                                            int index_m) {
    std::vector<const Record*> pointers;
    for (const Record& record : records) pointers.push_back(&record);
    return Segment::from_records(pointers, index_m);
}

std::span<const std::byte> bytes_of(const Segment& segment) {
    return {reinterpret_cast<const std::byte*>(segment.view().terms.data()),
            segment.bytes().total};
}

// A segment's bytes, to be damaged.
class Copy {
  public:
    explicit Copy(const Segment& segment)
        : counts(segment.view().counts), size_(bytes_of(segment).size()) {
        bytes_.reset(static_cast<std::byte*>(::operator new[](size_, kAlignment)));
        std::ranges::copy(bytes_of(segment), bytes_.get());
    }

    [[nodiscard]] std::span<std::byte> bytes() { return {bytes_.get(), size_}; }
    [[nodiscard]] SegmentUnderConstruction spans() { return spans_of(counts, bytes()); }
    [[nodiscard]] Result<SegmentView> view() {
        return view_segment(counts, std::span<const std::byte>(bytes()));
    }
    void expect_damage(const std::string& named) {
        const Result<SegmentView> result = view();
        ASSERT_FALSE(result.has_value()) << named;
        EXPECT_EQ(result.error().code, ErrorCode::kUndecodable);
        EXPECT_THAT(result.error().message, HasSubstr("damaged: " + named));
    }

    SegmentCounts counts;

  private:
    static constexpr std::align_val_t kAlignment{64};
    struct Free {
        void operator()(std::byte* bytes) const {
            ::operator delete[](bytes, kAlignment);
        }
    };
    std::size_t size_;
    std::unique_ptr<std::byte[], Free> bytes_;
};

// Every test damages a fresh copy of one segment: three tiers, three blocks, the last of
// them not full, dense and coarse lists of each kind.
class DamagedSegment : public ::testing::Test {
  protected:
    static constexpr int kIndexM = 50;
    static constexpr int kSlots = 600;

    static const Segment& whole() {
        static const std::shared_ptr<const Segment> segment = [] {
            std::mt19937 random(401);
            return make_segment(make_records(random, kSlots), kIndexM);
        }();
        return *segment;
    }
    // The first key that `wanted` is true of.
    template <typename Wanted>
    std::size_t key_where(const Wanted& wanted) {
        for (std::size_t key = 1; key < spans.directory.size(); ++key) {
            if (wanted(DirectoryEntry(spans.directory[key]))) return key;
        }
        ADD_FAILURE() << "no such key";
        return 0;
    }
    // The first channel of a slot with that many own coefficients.
    struct OwnList {
        std::size_t slot = 0;
        std::size_t channel = 0;
        std::size_t begin = 0;
    };
    OwnList own_list_of(int least) {
        std::size_t begin = 0;
        for (std::size_t slot = 0; slot < kSlots; ++slot) {
            for (std::size_t c = 0; c < kChannels; ++c) {
                const int count = spans.own_counts[slot][c][kMaxTiers - 1];
                if (count >= least) return {slot, c, begin};
                begin += std::size_t(count);
            }
        }
        ADD_FAILURE() << "no such list";
        return {};
    }

    static std::string number(std::size_t value) { return std::to_string(value); }

    Copy copy{whole()};
    SegmentUnderConstruction spans = copy.spans();
};

TEST_F(DamagedSegment, IsNoneAsLongAsNothingIsDamaged) {
    const Result<SegmentView> view = copy.view();
    ASSERT_TRUE(view.has_value()) << view.error().message;
    EXPECT_EQ(view->counts, whole().view().counts);
    EXPECT_GT(view->counts.dense[0], 0U);
    EXPECT_GT(view->counts.dense[1], view->counts.dense[0]);
    EXPECT_GT(view->counts.dense[2], view->counts.dense[1]);
    EXPECT_GT(view->counts.coarse, 0U);
}

TEST_F(DamagedSegment, HasImpossibleCounts) {
    const auto expect_impossible = [&](auto damage) {
        Copy of_this(whole());
        damage(of_this.counts);
        of_this.expect_damage("its counts are impossible");
    };
    const std::uint64_t most = std::uint64_t{kSlots} * kChannels * kIndexM;
    constexpr auto kHuge = std::numeric_limits<std::uint32_t>::max();
    expect_impossible([](auto& counts) { counts.index_m = 0; });
    expect_impossible([](auto& counts) { counts.index_m = kMaxCoefficients + 1; });
    expect_impossible([](auto& counts) { counts.index_m = kHuge; });
    expect_impossible([](auto& counts) { counts.slots = 0; });
    expect_impossible([](auto& counts) { counts.slots = kMaxSegmentSlots + 1; });
    expect_impossible([](auto& counts) { counts.slots = kHuge; });
    expect_impossible([](auto& counts) { counts.dense[2] = DirectoryEntry::kMost + 1; });
    expect_impossible([](auto& counts) { counts.dense[1] = counts.dense[0] - 1; });
    expect_impossible([](auto& counts) { counts.dense[1] = counts.dense[2] + 1; });
    expect_impossible([](auto& counts) { counts.coarse = DirectoryEntry::kMost + 1; });
    expect_impossible([&](auto& counts) { counts.dense_postings = most + 1; });
    expect_impossible([&](auto& counts) { counts.own_postings = most + 1; });
    // Fewer tiers than there are dense lists for.
    expect_impossible([](auto& counts) { counts.index_m = 40; });
    expect_impossible([](auto& counts) { counts.index_m = 20; });
}

TEST_F(DamagedSegment, HasAnotherSizeThanItsCountsSay) {
    const std::span<const std::byte> bytes = copy.bytes();
    for (const std::size_t size : {std::size_t{0}, std::size_t{64}, bytes.size() - 1}) {
        const auto result = view_segment(copy.counts, bytes.first(size));
        ASSERT_FALSE(result.has_value());
        EXPECT_THAT(result.error().message, HasSubstr("its size is " + number(size)));
    }
    copy.counts.slots += 64;
    copy.expect_damage("its size is " + number(bytes.size()));
}

TEST_F(DamagedSegment, HasBoundsThatAreNotThoseOfItsBlocks) {
    for (const int by : {-1, 1}) {
        spans.lowest[1][2] += by;
        copy.expect_damage("lowest average of block 2");
        spans.lowest[1][2] -= by;
        spans.highest[2][0] += by;
        copy.expect_damage("highest average of block 0");
        spans.highest[2][0] -= by;
    }
    spans.terms[0].average[0] = std::numeric_limits<std::int32_t>::max();
    copy.expect_damage("highest average of block 0");
}

TEST_F(DamagedSegment, HasASlotThatIsNotThere) {
    spans.slots_by_id[7] = kSlots;
    copy.expect_damage("slot by id 7 is " + number(kSlots));
}

TEST_F(DamagedSegment, HasIdsOutOfOrder) {
    std::swap(spans.slots_by_id[7], spans.slots_by_id[8]);
    copy.expect_damage("id in order 8");
    spans.slots_by_id[7] = spans.slots_by_id[8];
    copy.expect_damage("id in order 8");
}

TEST_F(DamagedSegment, HasAnIdThatIsNotPositive) {
    spans.ids[spans.slots_by_id[0]] = 0;
    copy.expect_damage("id in order 0 is 0");
    spans.ids[spans.slots_by_id[0]] = -5;
    copy.expect_damage("id in order 0 is -5");
}

TEST_F(DamagedSegment, HasAnEntryOfNoList) {
    const std::size_t free = key_where([](auto entry) { return entry.bits() == 0; });
    const int dense = int(copy.counts.dense[2]);
    const int coarse = int(copy.counts.coarse);
    for (const DirectoryEntry entry :
         {DirectoryEntry::of_dense(dense), DirectoryEntry::of_coarse(coarse)}) {
        spans.directory[free] = entry.bits();
        copy.expect_damage("directory entry " + number(free) + " is " +
                           number(entry.bits()));
    }
}

TEST_F(DamagedSegment, HasAListForTheAverage) {
    spans.directory[kCoefficientCount] = DirectoryEntry::of_coarse(0).bits();
    copy.expect_damage("directory entry " + number(kCoefficientCount));
}

TEST_F(DamagedSegment, HasTwoKeysOfOneDenseList) {
    const std::size_t free = key_where([](auto entry) { return entry.bits() == 0; });
    spans.directory[free] = DirectoryEntry::of_dense(2).bits();
    copy.expect_damage("key of list 2 is " + number(spans.dense_keys[2]));
}

TEST_F(DamagedSegment, HasADenseListOfNoKey) {
    spans.directory[spans.dense_keys[1]] = 0;
    copy.expect_damage("key of list 1 is " + number(spans.dense_keys[1]));
}

TEST_F(DamagedSegment, HasAKeyThatIsNone) {
    const std::uint32_t key = spans.dense_keys[1];
    spans.directory[key] = 0;
    spans.dense_keys[1] = kKeyCount;
    copy.expect_damage("key of list 1 is " + number(kKeyCount));
}

TEST_F(DamagedSegment, HasBitsBehindTheLastSlot) {
    for (int t = 0; t < kMaxTiers; ++t) {
        Copy of_this(whole());
        auto rows = of_this.spans().rows[t];
        rows[copy.counts.row_words() + kSlots / 64] |= std::uint64_t{1} << (kSlots % 64);
        of_this.expect_damage("bits of list 1 is set behind the last slot");
        Copy of_padding(whole());
        rows = of_padding.spans().rows[t];
        rows[2 * copy.counts.row_words() - 1] = 1;
        of_padding.expect_damage("bits of list 1 is set behind the last slot");
    }
    const std::size_t groups = kSlots / kCoarseSlots;
    spans.coarse_rows[copy.counts.coarse_row_words() + groups / 64] |= std::uint64_t{1}
                                                                       << (groups % 64);
    copy.expect_damage("bits of coarse row 1 is set behind the last slot");
}

TEST_F(DamagedSegment, HasBlocksPresentThatAreNot) {
    for (int t = 0; t < kMaxTiers; ++t) {
        for (const std::size_t bit : {0, 2, 3, 64}) {
            Copy of_this(whole());
            const auto presence = of_this.spans().presence[t];
            presence[copy.counts.presence_words() + bit / 64] ^= std::uint64_t{1}
                                                                 << (bit % 64);
            of_this.expect_damage("presence of list 1");
        }
    }
}

TEST_F(DamagedSegment, HasListsOfPicturesThatDoNotFollowOneAnother) {
    ++spans.own_begin[5];
    copy.expect_damage("begin of slot 5 is " + number(spans.own_begin[5]));
    --spans.own_begin[5];
    ++spans.own_begin[kSlots];
    copy.expect_damage("end of slot " + number(kSlots));
}

TEST_F(DamagedSegment, HasCountsThatAreNotThoseOfTheLists) {
    const OwnList list = own_list_of(3);
    OwnCounts& counts = spans.own_counts[list.slot];
    auto& tiers = counts[list.channel];
    --tiers[2];
    if (tiers[1] > tiers[2]) tiers[1] = tiers[2];
    if (tiers[0] > tiers[1]) tiers[0] = tiers[1];
    copy.expect_damage("begin of slot " + number(list.slot + 1));
}

TEST_F(DamagedSegment, HasCountsThatFall) {
    auto& tiers = spans.own_counts[own_list_of(3).slot][0];
    tiers[1] = static_cast<std::uint8_t>(tiers[2] + 1);
    copy.expect_damage("count of slot");
}

TEST_F(DamagedSegment, HasMoreOfATierThanItIsLong) {
    auto& tiers = spans.own_counts[9][0];
    tiers = {21, 40, kIndexM};
    copy.expect_damage("count of slot 9 is 21");
    tiers = {20, 41, kIndexM};
    copy.expect_damage("count of slot 9 is 41");
    tiers = {20, 40, kIndexM + 1};
    copy.expect_damage("count of slot 9 is " + number(kIndexM + 1));
}

TEST_F(DamagedSegment, HasListsThatEndBeforeTheirPart) {
    const std::size_t last = kSlots - 1;
    for (auto& tiers : spans.own_counts[last]) tiers = {};
    ASSERT_LT(spans.own_begin[last], copy.counts.own_postings);
    spans.own_begin[kSlots] = spans.own_begin[last];
    copy.expect_damage("end of slot " + number(kSlots));
}

TEST_F(DamagedSegment, HasCoefficientsThatAreNone) {
    for (const int index : {0, kCoefficientCount, -kCoefficientCount, -32768}) {
        spans.own[3] = static_cast<std::int16_t>(index);
        copy.expect_damage("coefficient 3 is " + std::to_string(index));
    }
}

TEST_F(DamagedSegment, HasACoefficientTwice) {
    const OwnList list = own_list_of(2);
    spans.own[list.begin + 1] = spans.own[list.begin];
    copy.expect_damage("coefficient " + number(list.begin + 1));
}

TEST_F(DamagedSegment, HasACoefficientOfNoList) {
    std::size_t i = 0;
    std::uint32_t key = 0;
    // The first that a coarse row is shared for; its key is found nowhere else before.
    for (std::size_t slot = 0; slot < kSlots && key == 0; ++slot) {
        for (int c = 0; c < kChannels && key == 0; ++c) {
            for (int left = spans.own_counts[slot][c][2]; left > 0; --left, ++i) {
                const std::uint32_t its = coefficient_key(c, spans.own[i]);
                if (DirectoryEntry(spans.directory[its]).coarse() !=
                    DirectoryEntry::kNone) {
                    key = its;
                    break;
                }
            }
        }
    }
    ASSERT_NE(key, 0U);
    spans.directory[key] = 0;
    copy.expect_damage("coefficient " + number(i));
}

TEST_F(DamagedSegment, HasRanksOfABlockThatBeginElsewhere) {
    ++spans.dense_rank_begin[4];
    copy.expect_damage("ranks of block 4 is " + number(spans.dense_rank_begin[4]));
}

// The last list, so that no begin is wrong.
TEST_F(DamagedSegment, HasFewerOrMoreRanksThanBits) {
    const std::size_t last = copy.counts.dense[2] - 1;
    const std::size_t word = last * copy.counts.row_words() + (kSlots - 1) / 64;
    for (const bool more : {false, true}) {
        Copy of_this(whole());
        std::uint64_t& bits = of_this.spans().rows[2][word];
        const int place = more ? std::countr_one(bits) : std::countr_zero(bits);
        ASSERT_LT(place, kSlots % 64);
        bits ^= std::uint64_t{1} << place;
        of_this.expect_damage("end of ranks");
    }
}

TEST_F(DamagedSegment, HasADenseRankThatCannotBe) {
    for (const int rank : {kIndexM, kMaxCoefficients, 255}) {
        spans.dense_ranks[11] = static_cast<std::uint8_t>(rank);
        copy.expect_damage("dense rank 11 is " + std::to_string(rank));
    }
}

TEST_F(DamagedSegment, HasOneRankTwice) {
    // Two lists of one channel that the first picture with both of them is in.
    const std::size_t words = copy.counts.row_words();
    for (std::size_t slot = 0; slot < kSlots; ++slot) {
        std::vector<std::size_t> places;
        for (std::size_t list = 0; list < copy.counts.dense[0]; ++list) {
            const bool in =
                (spans.rows[2][list * words + slot / 64] >> (slot % 64) & 1) != 0;
            if (in && spans.dense_keys[list] < 2 * kCoefficientCount)
                places.push_back(dense_rank_place(spans, list, slot));
        }
        if (places.size() < 2) continue;
        spans.dense_ranks[places[1]] = spans.dense_ranks[places[0]];
        copy.expect_damage("dense rank " + number(places[1]));
        return;
    }
    FAIL() << "no picture is in two dense lists";
}

TEST_F(DamagedSegment, HasRowsOfATierThatAreNotThoseOfTheRanks) {
    for (const int t : {0, 1}) {
        for (const bool more : {false, true}) {
            Copy of_this(whole());
            const auto rows = of_this.spans().rows;
            // More: a bit that the top tier has, and this one has not.
            std::size_t word = 0;
            const auto wanted = [&] {
                return more ? rows[2][word] & ~rows[t][word] : rows[t][word];
            };
            // A word of many, so that the block stays present.
            while (wanted() == 0 || std::popcount(rows[t][word]) < 2) ++word;
            rows[t][word] ^= wanted() & -wanted();
            of_this.expect_damage("bits of list " +
                                  number(word / copy.counts.row_words()) +
                                  " is not those of its ranks");
        }
    }
}

TEST_F(DamagedSegment, HasOwnRanksThatAreNotOfTheirTierOrOrder) {
    const OwnList list = own_list_of(2);
    const auto damage = [&](std::size_t place, std::uint8_t rank) {
        Copy of_this(whole());
        of_this.spans().own_ranks[list.begin + place] = rank;
        of_this.expect_damage("own rank " + number(list.begin + place) + " is " +
                              number(rank));
    };
    damage(0, kIndexM);
    damage(0, 255);
    damage(1, spans.own_ranks[list.begin]);
    // A coefficient that is counted in the first tier.
    for (std::size_t i = 0, slot = 0; slot < kSlots; ++slot) {
        i = spans.own_begin[slot];
        if (spans.own_counts[slot][0][0] == 0) continue;
        Copy of_this(whole());
        of_this.spans().own_ranks[i] = 20;
        of_this.expect_damage("own rank " + number(i) + " is 20");
        break;
    }
}

TEST_F(DamagedSegment, LacksARank) {
    // The last coefficient of its tier and channel moves one up: no order tells.
    for (std::size_t slot = 0; slot < kSlots; ++slot) {
        const auto& tiers = spans.own_counts[slot][0];
        if (tiers[2] == 0) continue;
        const std::size_t last = spans.own_begin[slot] + tiers[2] - 1;
        const bool coarse =
            DirectoryEntry(spans.directory[coefficient_key(0, spans.own[last])])
                .dense() == DirectoryEntry::kNone;
        if (!coarse || tiers[2] == tiers[1] || spans.own_ranks[last] != kIndexM - 3)
            continue;
        spans.own_ranks[last] = kIndexM - 1;
        const auto damaged = copy.view();
        ASSERT_FALSE(damaged.has_value());
        if (damaged.error().message.find("ranks of slot") == std::string::npos) {
            spans.own_ranks[last] = kIndexM - 3;
            continue;
        }
        copy.expect_damage("ranks of slot " + number(slot) + " is not complete");
        return;
    }
    FAIL() << "no picture has its last rank to itself";
}

// Everything that a search, or a merge, reads of the view; the sum of what a merge sends.
std::uint64_t read_all(const SegmentView& view, const Profile& profile, Signature asked) {
    const int blocks = view.counts.blocks();
    std::uint64_t sum = 0;
    for (const int wanted_m : {1, 20, 30, 40, 100}) {
        const int m = std::min(wanted_m, int(view.counts.index_m));
        const Query query = make_query(asked, profile, m);
        const SegmentSearch search(view, query, {});
        TopK top(10);
        WorstKept worst;
        Visitor visitor(search, top, worst);
        for (int first = 0; first < blocks; first += kBlocksAtOnce) {
            std::array<bool, kBlocksAtOnce> due{};
            due.fill(true);
            visitor.visit(first,
                          std::span<const bool>(due).first(
                              std::size_t(std::min(kBlocksAtOnce, blocks - first))));
        }
        std::vector<Match> all;
        search.score_all(all);
        sum += all.size();
    }
    std::vector<std::int32_t> place_of(std::size_t(blocks) * kBlockSlots, -1);
    for (std::size_t slot = 0; slot < view.counts.slots; ++slot)
        place_of[slot] = std::int32_t(slot);
    for_each_posting(view, place_of, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            EXPECT_LT(posting.place, view.counts.slots);
            EXPECT_LT(posting.rank, view.counts.index_m);
            EXPECT_LT(posting.key, std::uint32_t{kKeyCount});
            ++sum;
        }
    });
    return sum;
}

TEST(SegmentLayout, WhateverPassesCanBeSearchedAndMerged) {
    std::mt19937 random(402);
    const Profile profile = *built_in_profile("scanned");
    int accepted = 0;
    int refused = 0;
    for (const int index_m : {1, 20, 33, 60, 100}) {
        const std::vector<Record> records = make_records(random, 40 + 3 * index_m);
        const auto segment = make_segment(records, index_m);
        const Signature& asked = records[1].signature;
        Copy copy(*segment);
        const std::size_t total = copy.bytes().size();
        // The directory is most of the bytes and would get most of the damage.
        const auto directory = std::as_bytes(std::span(copy.spans().directory));
        const auto begin = std::size_t(directory.data() - copy.bytes().data());
        for (int i = 0; i < 400; ++i) {
            std::size_t place = random() % (total - directory.size());
            if (place >= begin) place += directory.size();
            if (i % 4 == 0) place = begin + random() % directory.size();
            std::byte& byte = copy.bytes()[place];
            const std::byte before = byte;
            byte ^= std::byte{static_cast<unsigned char>(1U << (random() % 8))};
            if (const Result<SegmentView> view = copy.view()) {
                ++accepted;
                EXPECT_GT(read_all(*view, profile, asked), 0U);
                auto damaged = Segment::from_view(*view, nullptr);
                const std::array<LiveSegment, 1> parts{{{std::move(damaged), nullptr}}};
                const auto merged = Segment::merge(parts);
                EXPECT_TRUE(view_segment(merged->view().counts, bytes_of(*merged)));
            } else {
                ++refused;
                EXPECT_EQ(view.error().code, ErrorCode::kUndecodable);
            }
            byte = before;
        }
    }
    EXPECT_GT(accepted, 100);
    EXPECT_GT(refused, 100);
}

// Every element of every part is written to, in order: where parts overlapped or left the
// bytes, a later one would have changed an earlier one.
TEST(SegmentLayout, PartsAreApartAlignedAndReadWhereTheyAreWritten) {
    for (const int index_m : {1, 20, 21, 40, 41, 100}) {
        SegmentCounts counts;
        counts.index_m = static_cast<std::uint32_t>(index_m);
        counts.slots = 300;
        const Tiers tiers = tiers_of(index_m);
        for (int t = 0; t < tiers.count; ++t) counts.dense[t] = std::uint32_t(2 + t);
        counts.coarse = 3;
        counts.dense_postings = 77;
        counts.own_postings = 99;
        const SegmentBytes sizes = segment_bytes(counts);
        EXPECT_LT(sizes.without_ranks, sizes.total);
        std::vector<std::byte> memory(sizes.total + 64);
        const auto misplaced = reinterpret_cast<std::uintptr_t>(memory.data()) % 64;
        const auto bytes = std::span(memory).subspan((64 - misplaced) % 64, sizes.total);
        const auto each_part = [](const auto& spans, const auto& visit) {
            visit(std::as_bytes(spans.terms));
            visit(std::as_bytes(spans.ids));
            visit(std::as_bytes(spans.slots_by_id));
            for (const auto& lowest : spans.lowest) visit(std::as_bytes(lowest));
            for (const auto& highest : spans.highest) visit(std::as_bytes(highest));
            visit(std::as_bytes(spans.directory));
            for (int t = 0; t < spans.tiers.count; ++t) {
                visit(std::as_bytes(spans.rows[t]));
                visit(std::as_bytes(spans.presence[t]));
            }
            visit(std::as_bytes(spans.coarse_rows));
            visit(std::as_bytes(spans.own_begin));
            visit(std::as_bytes(spans.own_counts));
            visit(std::as_bytes(spans.own));
            visit(std::as_bytes(spans.dense_keys));
            visit(std::as_bytes(spans.dense_rank_begin));
            visit(std::as_bytes(spans.dense_ranks));
            visit(std::as_bytes(spans.own_ranks));
        };
        const std::byte* end = bytes.data();
        std::vector<std::span<const std::byte>> written;
        each_part(spans_of(counts, bytes), [&](std::span<const std::byte> part) {
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(part.data()) % 64, 0U);
            EXPECT_GE(part.data(), end);
            EXPECT_LT(part.data() - end, 64);
            EXPECT_FALSE(part.empty());
            end = part.data() + part.size();
            written.push_back(part);
        });
        EXPECT_LE(end, bytes.data() + bytes.size());
        std::size_t next = 0;
        each_part(spans_of(counts, std::span<const std::byte>(bytes)),
                  [&](std::span<const std::byte> part) {
                      EXPECT_EQ(part.data(), written[next].data());
                      EXPECT_EQ(part.size(), written[next].size());
                      ++next;
                  });
        EXPECT_EQ(next, written.size());
    }
}

TEST(SegmentLayout, TiersEndAtIndexM) {
    const auto tiers = [](int index_m) {
        const Tiers all = tiers_of(index_m);
        return std::vector<int>(all.m.begin(), all.m.begin() + all.count);
    };
    EXPECT_THAT(tiers(1), testing::ElementsAre(1));
    EXPECT_THAT(tiers(20), testing::ElementsAre(20));
    EXPECT_THAT(tiers(21), testing::ElementsAre(20, 21));
    EXPECT_THAT(tiers(40), testing::ElementsAre(20, 40));
    EXPECT_THAT(tiers(41), testing::ElementsAre(20, 40, 41));
    EXPECT_THAT(tiers(100), testing::ElementsAre(20, 40, 100));
    EXPECT_EQ(tiers_of(100).holding(20), 0);
    EXPECT_EQ(tiers_of(100).holding(21), 1);
    EXPECT_EQ(tiers_of(100).holding(41), 2);
}

TEST(SegmentLayout, EntriesOfTheDirectoryAreWhatTheyWereMadeOf) {
    EXPECT_EQ(DirectoryEntry().dense(), DirectoryEntry::kNone);
    EXPECT_EQ(DirectoryEntry().coarse(), DirectoryEntry::kNone);
    for (const int list : {0, 1, DirectoryEntry::kMost - 1}) {
        EXPECT_EQ(DirectoryEntry::of_dense(list).dense(), list);
        EXPECT_EQ(DirectoryEntry::of_dense(list).coarse(), DirectoryEntry::kNone);
        EXPECT_EQ(DirectoryEntry::of_coarse(list).coarse(), list);
        EXPECT_EQ(DirectoryEntry::of_coarse(list).dense(), DirectoryEntry::kNone);
    }
}

}  // namespace
}  // namespace haarmony::image
