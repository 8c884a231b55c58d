// What is read off the planes of sums: one sum, all of them, comparisons, and sums for four.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "engine/image/bit_sums.h"
#include "tests/engine/image/bit_planes.h"
#include "tests/engine/image/each_target.h"

namespace haarmony::image {
namespace {

TEST(BitSums, AtReadsTheSumOfASlot) {
    std::mt19937_64 random(409);
    const BitSumsPtr planes = random_planes(random);
    for (const int used : {0, 1, 7, kMaxPlanes}) {
        const Sums sums = random_sums((1U << used) - 1, random);
        write(sums, used, *planes);
        for (int slot = 0; slot < kSlotsAtOnce; ++slot)
            ASSERT_EQ(planes->at(slot, used), sums[std::size_t(slot)]) << slot;
    }
}

TEST(AtLeast, IsTheComparisonOfEverySum) {
    std::mt19937_64 random(410);
    for (int used = 0; used <= kMaxPlanes; ++used) {
        const std::uint32_t most = (1U << used) - 1;
        const Sums sums = random_sums(most, random);
        const BitSumsPtr planes = random_planes(random);
        write(sums, used, *planes);
        std::vector<std::uint32_t> bounds = {0,
                                             1,
                                             most / 2,
                                             most,
                                             most + 1,
                                             most + 2,
                                             2 * most + 1,
                                             kLargestSum + 1,
                                             std::numeric_limits<std::uint32_t>::max()};
        // One that is met exactly, and its neighbours.
        for (const int change : {-1, 0, 1})
            bounds.push_back(sums[300] + std::uint32_t(change));
        for (int block = 0; block < kBlocksAtOnce; ++block) {
            for (const std::uint32_t bound : bounds) {
                const BlockBits bits = at_least(*planes, used, block, bound);
                for (std::size_t slot = 0; slot < kBlockSlots; ++slot) {
                    const std::uint32_t sum =
                        sums[std::size_t(block) * kBlockSlots + slot];
                    ASSERT_EQ((bits[slot / 64] >> (slot % 64) & 1U) != 0, sum >= bound)
                        << used << " planes, sum " << sum << ", bound " << bound;
                }
            }
        }
    }
}

TEST(Spread, GivesEachSumToFourNeighboursAndTouchesNothingElse) {
    std::mt19937_64 random(411);
    for (const int used : {0, 1, 9, kMaxPlanes}) {
        const Sums groups = random_sums((1U << used) - 1, random);
        const BitSumsPtr from_planes = random_planes(random);
        write(groups, used, *from_planes);
        for (int from = 0; from < kBlocksAtOnce; ++from) {
            for (int quarter = 0; quarter < 4; ++quarter) {
                const int to = static_cast<int>(random() % kBlocksAtOnce);
                const BitSumsPtr before = random_planes(random);
                const BitSumsPtr expected = copy_of(*before);
                for (int slot = 0; slot < kBlockSlots; ++slot) {
                    const std::uint32_t sum =
                        groups[std::size_t(from * kBlockSlots + quarter * 64 + slot / 4)];
                    const int at = to * kBlockSlots + slot;
                    for (int p = 0; p < used; ++p) {
                        std::uint64_t& word = expected->planes[std::size_t(p)][at / 64];
                        word &= ~(std::uint64_t{1} << (at % 64));
                        word |= std::uint64_t{sum >> p & 1U} << (at % 64);
                    }
                }
                for_each_target([&](const char* name) {
                    const BitSumsPtr actual = copy_of(*before);
                    spread(*from_planes, used, from, quarter, to, *actual);
                    ASSERT_EQ(first_difference(*actual, *expected), "none")
                        << name << ", block " << from << ", quarter " << quarter
                        << ", to " << to;
                });
            }
        }
    }
}

TEST(Unpack, IsTheSumOfEverySlotOnEveryTarget) {
    std::mt19937_64 random(413);
    for (int used = 0; used <= kMaxPlanes; ++used) {
        const Sums sums = random_sums((1U << used) - 1, random);
        const BitSumsPtr planes = random_planes(random);
        write(sums, used, *planes);
        for_each_target([&](const char* name) {
            for (int block = 0; block < kBlocksAtOnce; ++block) {
                UnpackedSums unpacked;
                unpacked.fill(0xABCD);
                unpack(*planes, used, block, unpacked);
                for (std::size_t slot = 0; slot < kBlockSlots; ++slot) {
                    ASSERT_EQ(unpacked[slot],
                              sums[std::size_t(block) * kBlockSlots + slot])
                        << name << ", " << used << " planes, block " << block;
                }
            }
        });
    }
}

}  // namespace
}  // namespace haarmony::image
