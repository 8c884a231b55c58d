// Weighted sums of bits for the 256 pictures of a block at once: the loop over lists of
// Figure 4.2, turned on its side.
//   [bit_sums.h] -> segment_layout.h -> segment_search.h
//
// A list is a row of bits, one per picture. What a picture's rows weigh together is kept as
// planes of bits too, and full adders add three whole rows at a time (Wallace, 1964).
//
// Shape   a row is kBlockWords words for each block; slot s of a block is bit s % 64 of its
//         word s / 64. Plane p holds bit p of every sum.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe; the vector code is chosen once for the machine.
// Source  sec. 4.3.1, Figure 4.2; C. S. Wallace, A suggestion for a fast multiplier, 1964.
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
// The most rows that one sum has.
inline constexpr int kMaxRows = 512;

using BlockBits = std::array<std::uint64_t, kBlockWords>;

// Which rows have a one at which place of their weight: made once for a query and a segment,
// used for every block.
class BitSumPlan {
  public:
    BitSumPlan() = default;
    // Sums may begin at `most_before` already.
    // Requires: at most kMaxRows weights; their sum with most_before below 2^kMaxPlanes.
    BitSumPlan(std::span<const std::uint32_t> weights, std::uint32_t most_before);

    [[nodiscard]] int planes() const { return planes_; }
    // The rows whose weight has bit `plane`, rising. Requires: 0 <= plane < planes().
    [[nodiscard]] std::span<const std::uint16_t> column(int plane) const {
        return std::span(rows_).subspan(begin_[plane], begin_[plane + 1] - begin_[plane]);
    }

  private:
    int planes_ = 0;
    std::array<std::size_t, kMaxPlanes + 1> begin_{};
    std::vector<std::uint16_t> rows_;
};

// Neighbouring blocks that are summed at once, at most: what a row has of them is four cache
// lines that follow each other, as the processor fetches them best.
inline constexpr int kBlocksAtOnce = 8;

// The sums of neighbouring blocks: bit s of plane p is bit p of the sum of slot s, the slots
// being counted from the first block on.
struct BitSums {
    using Plane = std::array<std::uint64_t, kBlocksAtOnce * kBlockWords>;
    alignas(64) std::array<Plane, kMaxPlanes> planes;

    // One sum, read off the planes [0, planes_used).
    // Requires: 0 <= slot < kBlocksAtOnce * kBlockSlots, planes_used <= kMaxPlanes.
    [[nodiscard]] std::uint32_t at(int slot, int planes_used) const {
        std::uint32_t sum = 0;
        for (int p = 0; p < planes_used; ++p) {
            sum |= static_cast<std::uint32_t>(planes[p][slot / 64] >> (slot % 64) & 1U)
                   << p;
        }
        return sum;
    }
};

// What will be summed next: the memory is asked for its rows meanwhile.
struct Ahead {
    std::size_t offset = 0;
    int blocks = 0;  // 0: nothing
};

// Adds to the sums of `blocks` neighbouring blocks the weights of their rows, of which row r
// begins at rows[r] + offset. `sums` comes with what is added to, in planes
// [0, first_planes), and has planes [0, plan.planes()) afterwards; nothing else of it is
// read or changed.
// Requires: one row for each weight of the plan; 1 <= blocks <= kBlocksAtOnce; first_planes
// <= plan.planes(); no sum above the plan's most_before. Cost: about six vector operations
// for each one-bit of the weights and each block.
void add_rows(const BitSumPlan& plan,
              std::span<const std::uint64_t* const> rows,
              std::size_t offset,
              int blocks,
              int first_planes,
              const Ahead& ahead,
              BitSums& sums);

// The same, word by word: the scalar twin of the vector code, identical in every bit.
void add_rows_scalar(const BitSumPlan& plan,
                     std::span<const std::uint64_t* const> rows,
                     std::size_t offset,
                     int blocks,
                     int first_planes,
                     BitSums& sums);

// Which sums of a block are at least `bound`; none where the planes cannot say as much.
// Requires: 0 <= block < kBlocksAtOnce.
[[nodiscard]] BlockBits at_least(const BitSums& sums,
                                 int planes_used,
                                 int block,
                                 std::uint32_t bound);

// Gives each sum of four slots' group to those four: what stands in slots
// [64 * quarter, 64 * quarter + 64) of block `from` of `groups` goes to all 256 slots of
// block `to` of `out`, planes [0, planes_used). Requires: 0 <= quarter < 4.
void spread(const BitSums& groups,
            int planes_used,
            int from,
            int quarter,
            int to,
            BitSums& out);

using UnpackedSums = std::array<std::uint16_t, kBlockSlots>;
// All sums of a block, slot after slot: what at() gives for each.
void unpack(const BitSums& sums, int planes_used, int block, UnpackedSums& out);

}  // namespace haarmony::image
