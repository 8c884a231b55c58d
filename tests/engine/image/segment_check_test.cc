// What a segment is refused for, ranks aside.
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
        DamagedCopy of_this(whole());
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
        EXPECT_THAT(result.error().message,
                    ::testing::HasSubstr("its size is " + number(size)));
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
        DamagedCopy of_this(whole());
        auto rows = of_this.spans().rows[t];
        rows[copy.counts.row_words() + kSlots / 64] |= std::uint64_t{1} << (kSlots % 64);
        of_this.expect_damage("bits of list 1 is set behind the last slot");
        DamagedCopy of_padding(whole());
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
            DamagedCopy of_this(whole());
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

}  // namespace
}  // namespace haarmony::image
