// What a segment is made of, and where it stands in its bytes: the six search arrays of many
// pictures in one piece of memory without pointers, built once.
//   signature.h, segment_builder.h -> [segment_layout.h] -> segment_search.h
//
// Shape   blocks of 256 neighbouring slots. A list that many pictures share is dense: a row of
//         bits, one per slot. All others share coarse rows: a bit says that one of the lists
//         of the row has one of four neighbouring slots; which one is found in the picture's
//         own list of such coefficients.
// Tiers   signatures are cut to their m largest coefficients, so a list has as many versions
//         as there are m. Three of them can be read off at once: m = 20, 40 and index_m. For
//         another m the next tier is a superset, and the ranks, which come last in the
//         bytes and are read for nothing else, say what belongs.
// Errors  see view_segment() and view_known_segment().
// Threads const-thread-safe.
// Source  sec. 4.3.1 (search arrays); FORMATS.md, byte by byte.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

#include "engine/core/result.h"
#include "engine/image/bit_sums.h"
#include "engine/image/query.h"

namespace haarmony::image {

// Raised with every change after which the same bytes would mean something else: whoever keeps
// segments in files keeps it beside them.
inline constexpr std::uint32_t kSegmentLayoutVersion = 1;
inline constexpr int kMaxSegmentSlots = 1 << 17;
inline constexpr int kMaxTiers = 3;
// Neighbouring slots that share a bit of a coarse row, and blocks that share a word of it.
inline constexpr int kCoarseSlots = 4;
// The prefixes that an index of that many coefficients keeps lists for, rising; the last is
// index_m.
struct Tiers {
    int count = 0;
    std::array<int, kMaxTiers> m{};

    // The first tier that has all of the m largest. Requires: 1 <= m <= index_m.
    [[nodiscard]] int holding(int wanted_m) const;
    [[nodiscard]] int top() const { return count - 1; }
};
[[nodiscard]] Tiers tiers_of(int index_m);

struct SegmentCounts {
    std::uint32_t index_m = 0;
    std::uint32_t slots = 0;
    // Lists that are dense in a tier are dense in all later ones and stand first there.
    std::array<std::uint32_t, kMaxTiers> dense{};
    std::uint32_t coarse = 0;          // rows of bits that all other lists share
    std::uint64_t dense_postings = 0;  // in the top tier
    std::uint64_t own_postings = 0;    // in the lists of the pictures themselves

    [[nodiscard]] int blocks() const {
        return (int(slots) + kBlockSlots - 1) / kBlockSlots;
    }
    [[nodiscard]] std::size_t block_words() const {
        return std::size_t(blocks()) * kBlockWords;
    }
    // From one row to the next: an odd number of cache lines, so that the same block of many
    // rows does not fall into one set of the cache.
    [[nodiscard]] std::size_t row_words() const { return odd_lines(block_words()); }
    // The same of coarse rows, which have a bit for kCoarseSlots slots.
    [[nodiscard]] std::size_t coarse_row_words() const {
        return odd_lines((block_words() + kCoarseSlots - 1) / kCoarseSlots);
    }
    // Of a row that has one bit for each block.
    [[nodiscard]] std::size_t presence_words() const {
        return std::size_t((blocks() + kBlockSlots - 1) / kBlockSlots) * kBlockWords;
    }
    friend bool operator==(const SegmentCounts&, const SegmentCounts&) = default;

  private:
    static std::size_t odd_lines(std::size_t words) {
        constexpr std::size_t kLine = 8;
        return ((words + kLine - 1) / kLine | 1U) * kLine;
    }
};

// Where a key's list is, in 16 bits: a dense one, a coarse row, or nowhere.
class DirectoryEntry {
  public:
    static constexpr int kNone = -1;
    static constexpr int kMost = (1 << 15) - 1;

    DirectoryEntry() = default;
    explicit DirectoryEntry(std::uint16_t bits) : bits_(bits) {}
    [[nodiscard]] static DirectoryEntry of_dense(int list) {
        return DirectoryEntry(static_cast<std::uint16_t>(list + 1));
    }
    [[nodiscard]] static DirectoryEntry of_coarse(int row) {
        return DirectoryEntry(static_cast<std::uint16_t>(kCoarse | row));
    }

    [[nodiscard]] int dense() const { return (bits_ & kCoarse) != 0 ? kNone : bits_ - 1; }
    [[nodiscard]] int coarse() const {
        return (bits_ & kCoarse) != 0 ? bits_ & ~kCoarse : kNone;
    }
    [[nodiscard]] std::uint16_t bits() const { return bits_; }

  private:
    static constexpr int kCoarse = 1 << 15;
    std::uint16_t bits_ = 0;
};

// How many of a picture's own coefficients of each channel belong to each tier, the lower
// ones included.
using OwnCounts = std::array<std::array<std::uint8_t, kMaxTiers>, kChannels>;

// What is known of a picture beside its coefficients, in one piece: whoever asks for one of
// these numbers asks for all.
struct PictureTerms {
    std::array<std::int32_t, kChannels> average{};
    std::int32_t log_aspect = 0;
};

// The parts of a segment's bytes; kMutable while it is built.
template <bool kMutable>
struct SegmentSpans {
    template <typename T>
    using Span = std::span<std::conditional_t<kMutable, T, const T>>;

    SegmentCounts counts;
    Tiers tiers;
    Span<PictureTerms> terms;                          // [slot]
    Span<std::int64_t> ids;                            // [slot]
    Span<std::uint32_t> slots_by_id;                   // slots in rising order of id
    std::array<Span<std::int32_t>, kChannels> lowest;  // average of each block
    std::array<Span<std::int32_t>, kChannels> highest;
    Span<std::uint16_t> directory;                        // [key]: DirectoryEntry
    std::array<Span<std::uint64_t>, kMaxTiers> rows;      // [dense][row_words]
    std::array<Span<std::uint64_t>, kMaxTiers> presence;  // [dense][presence_words]
    Span<std::uint64_t> coarse_rows;                      // [coarse][coarse_row_words]
    // Coefficients that are not dense, or only in a tier above their own: signed indices,
    // picture after picture, channel after channel, in falling order of magnitude.
    Span<std::uint32_t> own_begin;  // [slot], and the end of the last
    Span<OwnCounts> own_counts;     // [slot]
    Span<std::int16_t> own;
    // From here on: what only another m, or a merge, asks for.
    Span<std::uint32_t> dense_keys;  // [dense in the top tier]
    Span<std::uint32_t>
        dense_rank_begin;            // [dense][blocks]: of the block's first posting
    Span<std::uint8_t> dense_ranks;  // of each bit of the top tier's rows
    Span<std::uint8_t> own_ranks;    // of each of `own`
};
using SegmentView = SegmentSpans<false>;
using SegmentUnderConstruction = SegmentSpans<true>;

// Where the rank of a slot's posting in a dense list stands in dense_ranks.
// Requires: the top tier has the slot's bit.
template <bool kMutable>
[[nodiscard]] std::size_t dense_rank_place(const SegmentSpans<kMutable>& spans,
                                           std::size_t list,
                                           std::size_t slot) {
    const std::size_t block = slot / kBlockSlots;
    const std::size_t in_block = slot % kBlockSlots;
    const auto row = spans.rows[std::size_t(spans.tiers.top())].subspan(
        list * spans.counts.row_words() + block * kBlockWords, kBlockWords);
    std::size_t place =
        spans.dense_rank_begin[list * std::size_t(spans.counts.blocks()) + block];
    for (std::size_t word = 0; word < in_block / 64; ++word)
        place += std::size_t(std::popcount(row[word]));
    const std::uint64_t below = (std::uint64_t{1} << (in_block % 64)) - 1;
    return place + std::size_t(std::popcount(row[in_block / 64] & below));
}

// How many bytes a segment of these counts has; those before the ranks alone.
struct SegmentBytes {
    std::size_t total = 0;
    std::size_t without_ranks = 0;
};
[[nodiscard]] SegmentBytes segment_bytes(const SegmentCounts& counts);

// Requires: `bytes` has segment_bytes(counts).total bytes, aligned to 64.
[[nodiscard]] SegmentUnderConstruction spans_of(const SegmentCounts& counts,
                                                std::span<std::byte> bytes);
[[nodiscard]] SegmentView spans_of(const SegmentCounts& counts,
                                   std::span<const std::byte> bytes);

// All bytes of the segment that the view is of.
[[nodiscard]] std::span<const std::byte> bytes_of(const SegmentView& view);

// The segment in bytes that came from elsewhere. kUndecodable naming the first thing found that
// no builder writes; nothing that passes makes a search or a merge read outside of the bytes.
// Requires: aligned to 64. Cost: every posting is looked at.
[[nodiscard]] Result<SegmentView> view_segment(const SegmentCounts& counts,
                                               std::span<const std::byte> bytes);

// The same of bytes that view_segment() accepted when they were written, and that a checksum
// says are still these: all that is checked is that no search reads outside of the bytes.
// Whoever merges the segment calls view_segment() first.
// Requires: aligned to 64. Cost: a pass over the pictures' own coefficients.
[[nodiscard]] Result<SegmentView> view_known_segment(const SegmentCounts& counts,
                                                     std::span<const std::byte> bytes);

}  // namespace haarmony::image
