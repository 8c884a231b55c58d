#include "engine/image/segment_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "engine/image/segment.h"
#include "tests/engine/image/plain_segment.h"
#include "tests/engine/image/random_signatures.h"

namespace haarmony::image {
namespace {

using Posting = std::tuple<std::uint32_t, std::int64_t, int>;  // key, id, rank

std::vector<Record> make_records(std::uint32_t seed, int count) {
    std::mt19937 random(seed);
    std::vector<Record> records;
    Signature alike = random_signature(random, {});
    for (int i = 0; i < count; ++i) {
        Record record;
        record.id = ImageId{5 * i + 2};
        // Popular coefficients, rare ones, and many identical pictures.
        const SignatureShape popular{kMaxCoefficients, 300};
        record.signature = i % 4 == 0   ? alike
                           : i % 4 == 1 ? random_signature(random, {})
                                        : random_signature(random, popular);
        if (i == count / 2) alike = random_signature(random, {});
        record.log_aspect = i - count / 2;
        records.push_back(record);
    }
    return records;
}

std::vector<Posting> postings_of(const Record& record, int m) {
    std::vector<Posting> postings;
    for (int c = 0; c < kChannels; ++c) {
        int rank = 0;
        for (const int index : record.signature.channels[c].largest(m))
            postings.emplace_back(coefficient_key(c, index), to_int(record.id), rank++);
    }
    return postings;
}

struct Case {
    int index_m = 0;
    int pictures = 0;
};

class BuiltFromRecords : public ::testing::TestWithParam<Case> {
  protected:
    void SetUp() override {
        const Case& param = GetParam();
        records = make_records(std::uint32_t(500 + param.index_m), param.pictures);
        std::vector<const Record*> pointers;
        for (const Record& record : records) {
            pointers.push_back(&record);
            by_id[to_int(record.id)] = &record;
        }
        segment = Segment::from_records(pointers, param.index_m);
    }

    [[nodiscard]] const SegmentView& view() const { return segment->view(); }
    [[nodiscard]] const Record& in_slot(std::size_t slot) const {
        return *by_id.at(view().ids[slot]);
    }
    [[nodiscard]] static bool test(std::span<const std::uint64_t> row, std::size_t bit) {
        return (row[bit / 64] >> (bit % 64) & 1U) != 0;
    }

    std::vector<Record> records;
    std::map<std::int64_t, const Record*> by_id;
    std::shared_ptr<const Segment> segment;
};

TEST_P(BuiltFromRecords, PassesItsOwnCheck) {
    const std::span bytes(reinterpret_cast<const std::byte*>(view().terms.data()),
                          segment->bytes().total);
    const Result<SegmentView> checked = view_segment(view().counts, bytes);
    EXPECT_TRUE(checked.has_value()) << checked.error().message;
}

TEST_P(BuiltFromRecords, KeepsEveryPictureOnce) {
    ASSERT_EQ(segment->size(), int(records.size()));
    std::set<std::int64_t> ids(view().ids.begin(), view().ids.end());
    EXPECT_EQ(ids.size(), records.size());
    for (std::size_t place = 0; place < records.size(); ++place) {
        const std::size_t slot = view().slots_by_id[place];
        EXPECT_EQ(view().ids[slot], to_int(records[place].id));
        EXPECT_EQ(segment->find(records[place].id), int(slot));
        const PictureTerms& terms = view().terms[slot];
        EXPECT_EQ(terms.log_aspect, records[place].log_aspect);
        for (std::size_t c = 0; c < kChannels; ++c) {
            const std::int32_t average = records[place].signature.channels[c].average;
            EXPECT_EQ(terms.average[c], average);
            EXPECT_LE(view().lowest[c][slot / kBlockSlots], average);
            EXPECT_GE(view().highest[c][slot / kBlockSlots], average);
        }
    }
}

TEST_P(BuiltFromRecords, IsByteForByteThePlainOne) {
    const BuiltSegment expected = plain_segment(records, GetParam().index_m);
    ASSERT_EQ(view().counts, expected.counts);
    const std::span bytes(reinterpret_cast<const std::byte*>(view().terms.data()),
                          segment->bytes().total);
    const auto [different, in_expected] =
        std::ranges::mismatch(bytes, expected.bytes.span());
    EXPECT_TRUE(different == bytes.end())
        << "byte " << different - bytes.begin() << " of " << bytes.size();
}

TEST_P(BuiltFromRecords, HasARowForEachTierOfADenseList) {
    const SegmentCounts& counts = view().counts;
    // [list][slot]: the rank, or that there is none.
    constexpr int kNoRank = kMaxCoefficients;
    const std::size_t lists = view().dense_keys.size();
    std::vector<std::vector<int>> ranks(lists, std::vector<int>(counts.slots, kNoRank));
    for (std::size_t slot = 0; slot < counts.slots; ++slot) {
        for (const auto& [key, id, rank] :
             postings_of(in_slot(slot), GetParam().index_m)) {
            const int list = DirectoryEntry(view().directory[key]).dense();
            if (list == DirectoryEntry::kNone) continue;
            EXPECT_EQ(view().dense_keys[std::size_t(list)], key);
            ranks[std::size_t(list)][slot] = rank;
        }
    }
    std::uint64_t wrong = 0;
    for (int t = 0; t < view().tiers.count; ++t) {
        for (std::size_t list = 0; list < counts.dense[t]; ++list) {
            const auto row = view().rows[t].subspan(list * counts.row_words());
            const auto presence =
                view().presence[t].subspan(list * counts.presence_words());
            std::vector<bool> present(std::size_t(counts.blocks()));
            for (std::size_t slot = 0; slot < counts.slots; ++slot) {
                const bool in = ranks[list][slot] < view().tiers.m[t];
                wrong += test(row, slot) != in ? 1 : 0;
                if (in) present[slot / kBlockSlots] = true;
                if (in && view().dense_ranks[dense_rank_place(view(), list, slot)] !=
                              ranks[list][slot])
                    ++wrong;
            }
            for (std::size_t block = 0; block < present.size(); ++block)
                wrong += test(presence, block) != present[block] ? 1 : 0;
        }
    }
    EXPECT_EQ(wrong, 0U);
}

// Coarse rows say too much only where another list of the row has the group.
TEST_P(BuiltFromRecords, HasABitForEachGroupThatAListOfACoarseRowIsIn) {
    const SegmentCounts& counts = view().counts;
    std::set<std::pair<int, std::size_t>> expected;  // row, group
    for (std::size_t slot = 0; slot < counts.slots; ++slot) {
        for (const auto& [key, id, rank] :
             postings_of(in_slot(slot), GetParam().index_m)) {
            const DirectoryEntry entry(view().directory[key]);
            ASSERT_TRUE(entry.bits() != 0) << "key " << key << " has no list";
            if (entry.coarse() != DirectoryEntry::kNone)
                expected.emplace(entry.coarse(), slot / kCoarseSlots);
        }
    }
    std::set<std::pair<int, std::size_t>> found;
    for (int row = 0; row < int(counts.coarse); ++row) {
        const auto bits = view().coarse_rows.subspan(
            std::size_t(row) * counts.coarse_row_words(), counts.coarse_row_words());
        for (std::size_t bit = 0; bit < bits.size() * 64; ++bit) {
            if (test(bits, bit)) found.emplace(row, bit);
        }
    }
    EXPECT_TRUE(found == expected) << found.size() << " of " << expected.size();
}

// A picture keeps what no row of the coefficient's own tier says.
TEST_P(BuiltFromRecords, KeepsWithThePictureWhatIsNotDenseInItsTier) {
    const Tiers& tiers = view().tiers;
    std::size_t place = 0;
    for (std::size_t slot = 0; slot < view().counts.slots; ++slot) {
        ASSERT_EQ(view().own_begin[slot], place);
        for (std::size_t c = 0; c < kChannels; ++c) {
            std::vector<std::pair<int, int>> expected;  // rank, signed index
            std::array<int, kMaxTiers> counts{};
            int rank = 0;
            for (const int index :
                 in_slot(slot).signature.channels[c].largest(GetParam().index_m)) {
                int tier = 0;
                while (tiers.m[std::size_t(tier)] <= rank) ++tier;
                const int list =
                    DirectoryEntry(view().directory[coefficient_key(int(c), index)])
                        .dense();
                const bool dense = list != DirectoryEntry::kNone &&
                                   list < int(view().counts.dense[std::size_t(tier)]);
                if (!dense) {
                    expected.emplace_back(rank, index);
                    for (int t = tier; t < kMaxTiers; ++t) ++counts[std::size_t(t)];
                }
                ++rank;
            }
            std::vector<std::pair<int, int>> kept;
            for (std::size_t i = 0; i < expected.size(); ++i)
                kept.emplace_back(view().own_ranks[place + i], view().own[place + i]);
            EXPECT_EQ(kept, expected) << "slot " << slot;
            EXPECT_TRUE(std::ranges::equal(view().own_counts[slot][c], counts));
            place += expected.size();
        }
    }
    EXPECT_EQ(view().own_begin[view().counts.slots], place);
    EXPECT_EQ(view().own.size(), place);
}

// What a tier can be asked for does not depend on how the lists are kept.
TEST_P(BuiltFromRecords, HasEveryListWhereItsLengthSays) {
    std::map<std::uint32_t, std::array<int, kMaxTiers>> lengths;
    const Tiers& tiers = view().tiers;
    for (const Record& record : records) {
        for (const auto& [key, id, rank] : postings_of(record, GetParam().index_m)) {
            for (int t = 0; t < tiers.count; ++t) {
                if (rank < tiers.m[t]) ++lengths[key][std::size_t(t)];
            }
        }
    }
    // Dense lists are no shorter in their tier than those that are not dense there.
    for (int t = 0; t < tiers.count; ++t) {
        int shortest_dense = int(records.size());
        int longest_other = 0;
        for (const auto& [key, length] : lengths) {
            const int list = DirectoryEntry(view().directory[key]).dense();
            const bool dense =
                list != DirectoryEntry::kNone && list < int(view().counts.dense[t]);
            const bool dense_below =
                dense && t > 0 && list < int(view().counts.dense[t - 1]);
            if (dense && !dense_below)
                shortest_dense = std::min(shortest_dense, length[std::size_t(t)]);
            if (!dense) longest_other = std::max(longest_other, length[std::size_t(t)]);
        }
        EXPECT_GT(shortest_dense, longest_other) << "tier " << t;
    }
    for (std::uint32_t key = 0; key < view().directory.size(); ++key)
        EXPECT_EQ(view().directory[key] != 0, lengths.contains(key)) << key;
}

std::vector<Case> all_cases() {
    std::vector<Case> cases;
    for (const int index_m : {1, 10, 20, 30, 60, 100}) {
        for (const int pictures : {1, 255, 256, 257})
            cases.push_back({index_m, pictures});
    }
    // What takes long in a debug build: once below the tiers, once with all of them.
    cases.push_back({10, 3000});
    cases.push_back({60, 3000});
    return cases;
}

INSTANTIATE_TEST_SUITE_P(SegmentBuilder,
                         BuiltFromRecords,
                         testing::ValuesIn(all_cases()),
                         [](const auto& tested) {
                             return "M" + std::to_string(tested.param.index_m) + "With" +
                                    std::to_string(tested.param.pictures);
                         });

// Counts pictures from the last to the first.
class LastFirst final : public PictureSource {
  public:
    LastFirst(std::span<const Record* const> records, int index_m)
        : records_(records, index_m), count_(std::uint32_t(records.size())) {}

    void give_all(const PictureSink& sink) const override {
        std::vector<std::uint32_t> places;
        for (std::uint32_t place = count_; place-- > 0;) places.push_back(place);
        give(places, sink);
    }
    void give(std::span<const std::uint32_t> places,
              const PictureSink& sink) const override {
        records_.give(places, sink);
    }

  private:
    RecordPictures records_;
    std::uint32_t count_;
};

TEST(SegmentBuilder, PicturesMayBeCountedInAnyOrder) {
    const std::vector<Record> records = make_records(600, 300);
    PictureColumns columns;
    std::vector<const Record*> pointers;
    for (const Record& record : records) {
        pointers.push_back(&record);
        columns.ids.push_back(record.id);
        PictureTerms terms;
        for (std::size_t c = 0; c < kChannels; ++c)
            terms.average[c] = record.signature.channels[c].average;
        columns.terms.push_back(terms);
    }
    const BuiltSegment rising = build_segment(60, columns, RecordPictures(pointers, 60));
    const BuiltSegment falling = build_segment(60, columns, LastFirst(pointers, 60));
    EXPECT_EQ(rising.counts, falling.counts);
    EXPECT_TRUE(std::ranges::equal(rising.bytes.span(), falling.bytes.span()));
}

}  // namespace
}  // namespace haarmony::image
