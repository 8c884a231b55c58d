// Weighted sums of bits for the 256 pictures of a block at once: the loop over lists of
// Figure 4.2, turned on its side.
//   segment_layout.h -> [bit_sums.h] -> segment_search.h
//
// A list that many pictures share is a row of bits, one per picture. The sum of the weights
// of those rows that have a picture's bit is kept as planes of bits too: plane p holds bit p
// of all 256 sums. Each place of the weights is a column of rows to be added; full adders
// take three rows of a column to one there and one in the next (Wallace, 1964).
//
// Shape    a row is kBlockWords words; slot s of the block is bit s % 64 of word s / 64.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  const-thread-safe.
// Source   sec. 4.3.1, Figure 4.2; C. S. Wallace, A suggestion for a fast multiplier, 1964.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace haarmony::image {

inline constexpr int kBlockSlots = 256;
inline constexpr int kBlockWords = kBlockSlots / 64;
// Sums stay below 2^kMaxPlanes.
inline constexpr int kMaxPlanes = 16;
// Rows of one sum.
inline constexpr int kMaxRows = 512;

using BlockBits = std::array<std::uint64_t, kBlockWords>;

// Which rows have a one at which place of their weight.
class BitSumPlan {
  public:
    BitSumPlan() = default;
    // Sums may begin at `most_before` already.
    // Requires: at most kMaxRows weights; their sum with most_before below 2^kMaxPlanes.
    BitSumPlan(std::span<const std::uint32_t> weights, std::uint32_t most_before);

    [[nodiscard]] int planes() const { return planes_; }
    // The rows whose weight has bit `plane`.
    [[nodiscard]] std::span<const std::uint16_t> column(int plane) const {
        return std::span(rows_).subspan(begin_[plane], begin_[plane + 1] - begin_[plane]);
    }

  private:
    int planes_ = 0;
    std::array<std::size_t, kMaxPlanes + 1> begin_{};
    std::vector<std::uint16_t> rows_;
};

// Neighbouring blocks that are summed at once, at most: what a row has of them is four cache
// lines, and all sums and carries stay near the processor.
inline constexpr int kBlocksAtOnce = 8;

// The sums of neighbouring blocks: bit s of plane p is bit p of the sum of slot s, the slots
// being counted from the first block on.
struct BitSums {
    using Plane = std::array<std::uint64_t, kBlocksAtOnce * kBlockWords>;
    alignas(64) std::array<Plane, kMaxPlanes> planes;

    [[nodiscard]] std::uint32_t at(int slot, int planes_used) const {
        std::uint32_t sum = 0;
        for (int p = 0; p < planes_used; ++p) {
            sum |= static_cast<std::uint32_t>(planes[p][slot / 64] >> (slot % 64) & 1U)
                   << p;
        }
        return sum;
    }
};

// Sums planes [0, plan.planes()) of `blocks` neighbouring blocks whose row r begins at
// rows[r] + offset. `sums` holds what the rows are added to, in planes [0, first_planes).
// Requires: 1 <= blocks <= kBlocksAtOnce. Cost: about six vector operations for each one-bit
// of the weights and each block.
void add_rows(const BitSumPlan& plan,
              std::span<const std::uint64_t* const> rows,
              std::size_t offset,
              int blocks,
              int first_planes,
              BitSums& sums);

// The same, word by word: what the vector code is compared with.
void add_rows_scalar(const BitSumPlan& plan,
                     std::span<const std::uint64_t* const> rows,
                     std::size_t offset,
                     int blocks,
                     int first_planes,
                     BitSums& sums);

// Which sums of a block are at least `bound`.
[[nodiscard]] BlockBits at_least(const BitSums& sums,
                                 int planes_used,
                                 int block,
                                 std::uint32_t bound);

// Gives each bit of quarter `quarter` of block `from` to four neighbouring slots: the sums of
// 64 groups of four become those of the 256 slots of block `to`.
void spread(const BitSums& groups,
            int planes_used,
            int from,
            int quarter,
            int to,
            BitSums& out);

// All sums of a block, slot after slot: what at() gives for each.
using UnpackedSums = std::array<std::uint16_t, kBlockSlots>;
void unpack(const BitSums& sums, int planes_used, int block, UnpackedSums& out);

}  // namespace haarmony::image
