// What a segment's ranks are refused for.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "tests/engine/image/damaged_segment.h"

namespace haarmony::image {
namespace {

using DamagedRanks = DamagedSegment;

TEST_F(DamagedRanks, HasRanksOfABlockThatBeginElsewhere) {
    ++spans.dense_rank_begin[4];
    copy.expect_damage("ranks of block 4 is " + number(spans.dense_rank_begin[4]));
}

// The last list, so that no begin is wrong.
TEST_F(DamagedRanks, HasFewerOrMoreRanksThanBits) {
    const std::size_t last = copy.counts.dense[2] - 1;
    const std::size_t word = last * copy.counts.row_words() + (kSlots - 1) / 64;
    for (const bool more : {false, true}) {
        DamagedCopy of_this(whole());
        std::uint64_t& bits = of_this.spans().rows[2][word];
        const int place = more ? std::countr_one(bits) : std::countr_zero(bits);
        ASSERT_LT(place, kSlots % 64);
        bits ^= std::uint64_t{1} << place;
        // One bit more is one rank behind the end.
        of_this.expect_damage(more ? "ranks of block " +
                                         number(spans.dense_rank_begin.size() - 1)
                                   : "end of ranks");
    }
}

TEST_F(DamagedRanks, HasADenseRankThatCannotBe) {
    for (const int rank : {kIndexM, kMaxCoefficients, 255}) {
        spans.dense_ranks[11] = static_cast<std::uint8_t>(rank);
        copy.expect_damage("dense rank 11 is " + std::to_string(rank));
    }
}

TEST_F(DamagedRanks, HasOneRankTwice) {
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

TEST_F(DamagedRanks, HasRowsOfATierThatAreNotThoseOfTheRanks) {
    for (const int t : {0, 1}) {
        for (const bool more : {false, true}) {
            DamagedCopy of_this(whole());
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

TEST_F(DamagedRanks, HasOwnRanksThatAreNotOfTheirTierOrOrder) {
    const OwnList list = own_list_of(2);
    const auto damage = [&](std::size_t place, std::uint8_t rank) {
        DamagedCopy of_this(whole());
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
        DamagedCopy of_this(whole());
        of_this.spans().own_ranks[i] = 20;
        of_this.expect_damage("own rank " + number(i) + " is 20");
        break;
    }
}

TEST_F(DamagedRanks, LacksARank) {
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

}  // namespace
}  // namespace haarmony::image
