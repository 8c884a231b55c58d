#include "engine/image/row_writer.h"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace haarmony::image {
namespace {

bool test(std::span<const std::uint64_t> row, std::size_t bit) {
    return (row[bit / 64] >> (bit % 64) & 1U) != 0;
}

// List l has every (l + 1)-th slot, with these ranks; of list 0 more ranks come in 64 slots
// than can wait.
constexpr std::size_t kLists = 3;
bool has(std::size_t list, std::size_t slot) { return slot % (list + 1) == 0; }
std::uint8_t rank_of(std::size_t list, std::size_t slot) {
    return static_cast<std::uint8_t>((7 * slot + list) % 60);
}

TEST(RowWriter, WritesEveryBitTierAndRankOfBlocksWholeAndBroken) {
    for (const std::uint32_t slots : {1U, 63U, 64U, 65U, 256U, 257U, 700U}) {
        SCOPED_TRACE(slots);
        SegmentCounts counts;
        counts.index_m = 60;
        counts.slots = slots;
        counts.dense = {1, 2, 3};
        counts.coarse = 2;
        std::vector<std::uint32_t> sizes;
        for (std::size_t list = 0; list < kLists; ++list)
            sizes.push_back((slots + std::uint32_t(list)) / std::uint32_t(list + 1));
        counts.dense_postings = std::accumulate(sizes.begin(), sizes.end(), 0U);
        struct alignas(64) Line {
            std::array<std::byte, 64> bytes{};
        };
        std::vector<Line> lines(segment_bytes(counts).total / sizeof(Line));
        const SegmentUnderConstruction spans =
            spans_of(counts, std::as_writable_bytes(std::span(lines)));

        RowWriter writer(spans, sizes);
        for (std::size_t slot = 0; slot < slots; ++slot) {
            for (std::size_t list = 0; list < kLists; ++list) {
                const std::uint8_t rank = rank_of(list, slot);
                const int tier = spans.tiers.holding(rank + 1);
                if (has(list, slot))
                    writer.put_dense(list, rank, static_cast<std::uint8_t>(tier));
            }
            if (slot % 9 == 0) writer.put_coarse(1);
            writer.next_slot();
        }

        std::size_t place = 0;
        for (std::size_t list = 0; list < kLists; ++list) {
            for (std::size_t slot = 0; slot < slots; ++slot) {
                const std::size_t block = slot / kBlockSlots;
                const auto blocks = std::size_t(counts.blocks());
                if (slot % kBlockSlots == 0) {
                    ASSERT_EQ(spans.dense_rank_begin[list * blocks + block], place);
                }
                for (std::size_t t = list; t < kMaxTiers; ++t) {
                    const bool in =
                        has(list, slot) && rank_of(list, slot) < spans.tiers.m[t];
                    ASSERT_EQ(
                        test(spans.rows[t].subspan(list * counts.row_words()), slot), in)
                        << "list " << list << ", slot " << slot << ", tier " << t;
                    if (!in) continue;
                    ASSERT_TRUE(
                        test(spans.presence[t].subspan(list * counts.presence_words()),
                             block));
                }
                if (has(list, slot)) {
                    ASSERT_EQ(spans.dense_ranks[place++], rank_of(list, slot));
                }
            }
        }
        EXPECT_EQ(place, counts.dense_postings);
        const auto coarse = spans.coarse_rows.subspan(counts.coarse_row_words());
        for (std::size_t group = 0; group * kCoarseSlots < slots; ++group) {
            bool expected = false;
            for (std::size_t slot = group * kCoarseSlots;
                 slot < slots && slot < (group + 1) * kCoarseSlots;
                 ++slot)
                expected = expected || slot % 9 == 0;
            ASSERT_EQ(test(coarse, group), expected) << "group " << group;
            ASSERT_FALSE(test(spans.coarse_rows, group));
        }
    }
}

}  // namespace
}  // namespace haarmony::image
