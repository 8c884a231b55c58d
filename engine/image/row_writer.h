// Writes the rows of a segment and the ranks of their bits, slot after slot.
//   segment_layout.h -> [row_writer.h] -> segment_builder.h
//
// The rows stand kilobytes apart, so that a bit set in place is a miss in every cache. Here
// each dense list has a cache line, in which the bits of 64 slots and their ranks wait, and
// each coarse row a word, in which those of a block do.
//
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads none: the rows of a segment are written by one thread.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/segment_layout.h"

namespace haarmony::image {

class RowWriter {
  public:
    // The spans' bytes are 0, but for dense_keys and directory, and outlive this.
    // `list_sizes`: postings of each dense list in the top tier.
    RowWriter(const SegmentUnderConstruction& spans,
              std::span<const std::uint32_t> list_sizes);

    // The slot has a posting of a dense list, whose rank belongs to `tier`.
    void put_dense(std::size_t list, std::uint8_t rank, std::uint8_t tier) {
        Line& line = lines_[list];
        line.bits[tier] |= bit_;
        if (line.waiting == kMostWaiting) write_ranks(line);
        line.ranks[line.waiting++] = rank;
    }
    // The slot has a posting of a list of this coarse row.
    void put_coarse(std::size_t row) { coarse_[row] |= coarse_bit_; }
    // On to the next slot; after the last there is one more call.
    void next_slot();

  private:
    static constexpr std::size_t kMostWaiting = 35;
    struct alignas(64) Line {
        std::array<std::uint64_t, kMaxTiers> bits{};  // of 64 slots, of the tier alone
        std::uint32_t next_rank = 0;                  // its place in dense_ranks
        std::uint8_t waiting = 0;
        std::array<std::uint8_t, kMostWaiting> ranks{};
    };
    static_assert(sizeof(Line) == 64);

    void begin_block();
    void write_word();
    void write_block();
    void write_ranks(Line& line);

    const SegmentUnderConstruction& spans_;
    std::size_t slot_ = 0;
    std::uint64_t bit_ = 1;
    std::uint64_t coarse_bit_ = 1;
    std::vector<Line> lines_;                              // [dense]
    std::vector<std::array<BlockBits, kMaxTiers>> block_;  // [dense][tier]
    std::vector<std::uint64_t> coarse_;                    // [coarse], of the block
    static_assert(kBlockSlots / kCoarseSlots == 64);
};

}  // namespace haarmony::image
