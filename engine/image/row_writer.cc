#include "engine/image/row_writer.h"

#include <algorithm>
#include <cassert>

namespace haarmony::image {

RowWriter::RowWriter(const SegmentUnderConstruction& spans,
                     std::span<const std::uint32_t> list_sizes)
    : spans_(spans),
      lines_(list_sizes.size()),
      block_(list_sizes.size()),
      coarse_(spans.counts.coarse) {
    std::uint32_t next_rank = 0;
    for (std::size_t list = 0; list < lines_.size(); ++list) {
        lines_[list].next_rank = next_rank;
        next_rank += list_sizes[list];
    }
    assert(next_rank == spans.counts.dense_postings);
    begin_block();
}

void RowWriter::next_slot() {
    ++slot_;
    const bool last = slot_ == spans_.counts.slots;
    if (slot_ % 64 == 0 || last) write_word();
    if (slot_ % kBlockSlots == 0 || last) write_block();
    if (slot_ % kBlockSlots == 0 && !last) begin_block();
    bit_ = std::uint64_t{1} << (slot_ % 64);
    coarse_bit_ = std::uint64_t{1} << (slot_ % kBlockSlots / kCoarseSlots);
}

void RowWriter::begin_block() {
    const auto blocks = static_cast<std::size_t>(spans_.counts.blocks());
    const std::size_t block = slot_ / kBlockSlots;
    for (std::size_t list = 0; list < lines_.size(); ++list)
        spans_.dense_rank_begin[list * blocks + block] =
            lines_[list].next_rank + lines_[list].waiting;
}

void RowWriter::write_word() {
    const std::size_t word = (slot_ - 1) % kBlockSlots / 64;
    for (std::size_t list = 0; list < lines_.size(); ++list) {
        Line& line = lines_[list];
        std::uint64_t bits = 0;
        for (std::size_t t = 0; t < kMaxTiers; ++t) {
            bits |= line.bits[t];
            block_[list][t][word] = bits;
        }
        line.bits = {};
        write_ranks(line);
    }
}

void RowWriter::write_block() {
    const std::size_t row_words = spans_.counts.row_words();
    const std::size_t presence_words = spans_.counts.presence_words();
    const std::size_t coarse_words = spans_.counts.coarse_row_words();
    const std::size_t block = (slot_ - 1) / kBlockSlots;
    const std::uint64_t presence_bit = std::uint64_t{1} << (block % 64);
    for (int t = 0; t < spans_.tiers.count; ++t) {
        for (std::size_t list = 0; list < spans_.counts.dense[t]; ++list) {
            const BlockBits& bits = block_[list][std::size_t(t)];
            if (bits == BlockBits{}) continue;
            std::ranges::copy(bits,
                              &spans_.rows[t][list * row_words + block * kBlockWords]);
            spans_.presence[t][list * presence_words + block / 64] |= presence_bit;
        }
    }
    for (std::size_t row = 0; row < coarse_.size(); ++row)
        spans_.coarse_rows[row * coarse_words + block] = coarse_[row];
    std::ranges::fill(block_, std::array<BlockBits, kMaxTiers>{});
    std::ranges::fill(coarse_, std::uint64_t{0});
}

void RowWriter::write_ranks(Line& line) {
    std::copy_n(
        line.ranks.begin(), line.waiting, spans_.dense_ranks.begin() + line.next_rank);
    line.next_rank += line.waiting;
    line.waiting = 0;
}

}  // namespace haarmony::image
