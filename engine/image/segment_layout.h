// What a segment is made of, and where it stands in its bytes: one block of memory that is
// built once, written to a file as it is, and mapped from there.
//   search_arrays.h -> [segment_layout.h] -> segment_search.h
//
// Shape   blocks of 256 neighbouring slots. Every list of the six search arrays is kept in
//         one of three ways, by what takes fewer bytes:
//           dense  a row of bits, one per slot, for each prefix tier in which many have it;
//           warm   for each block the slots that have it, one byte each;
//           rare   slots and ranks, three bytes each.
//         Warm and rare lists share coarse rows of bits besides: a bit says that one of the
//         lists of the row has one of four neighbouring slots, so that few pictures are looked
//         for in the lists themselves.
// Tiers   signatures are cut to their m largest coefficients, so a list has as many versions
//         as there are m. Three of them can be read off at once: m = 20, 40 and index_m. For
//         another m the next tier is a superset, and the ranks, which come last in the
//         bytes and are read for nothing else, say what belongs.
// Errors  see view_segment().
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

inline constexpr int kMaxSegmentSlots = 1 << 17;
inline constexpr int kMaxTiers = 3;
// Neighbouring slots that share a bit of a coarse row, and blocks that share a word of it.
inline constexpr int kCoarseSlots = 4;
// Offsets of warm runs are counted anew in each group of blocks, so that 16 bits do.
inline constexpr int kGroupBlocks = 16;

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
    std::uint32_t coarse = 0;          // rows of bits that warm and rare lists share
    std::uint32_t warm = 0;            // lists
    std::uint32_t rare = 0;            // lists
    std::uint64_t dense_postings = 0;  // in the top tier
    std::uint64_t warm_postings = 0;
    std::uint64_t rare_postings = 0;

    [[nodiscard]] int blocks() const { return (int(slots) + kBlockSlots - 1) / kBlockSlots; }
    [[nodiscard]] int groups() const { return (blocks() + kGroupBlocks - 1) / kGroupBlocks; }
    [[nodiscard]] std::size_t block_words() const {
        return std::size_t(blocks()) * kBlockWords;
    }
    // From one row to the next: an odd number of cache lines, so that the same block of many
    // rows does not fall into one set of the cache.
    [[nodiscard]] std::size_t row_words() const {
        return odd_lines(block_words());
    }
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

// Where a key's list is, in 32 bits: a dense one and, for the tiers below, a warm or rare
// one.
class DirectoryEntry {
  public:
    static constexpr int kNone = -1;

    DirectoryEntry() = default;
    explicit DirectoryEntry(std::uint32_t bits) : bits_(bits) {}
    DirectoryEntry(int dense, int sparse)
        : bits_(static_cast<std::uint32_t>(dense + 1) |
                static_cast<std::uint32_t>(sparse + 1) << kDenseBits) {}

    [[nodiscard]] int dense() const { return int(bits_ & ((1U << kDenseBits) - 1)) - 1; }
    // Warm lists are counted first, then the rare ones.
    [[nodiscard]] int sparse() const { return int(bits_ >> kDenseBits) - 1; }
    [[nodiscard]] std::uint32_t bits() const { return bits_; }

  private:
    static constexpr int kDenseBits = 15;
    std::uint32_t bits_ = 0;
};
inline constexpr int kMaxDenseLists = (1 << 15) - 2;

// The warm postings of one list in one block: where they begin within their group of
// blocks, and how many belong to the first and to the first two tiers.
class WarmRun {
  public:
    explicit WarmRun(std::uint32_t bits) : bits_(bits) {}
    WarmRun(std::uint32_t begin, std::uint32_t first, std::uint32_t first_two)
        : bits_(begin | first << 16 | first_two << 24) {}

    static constexpr std::uint32_t kMaxCount = 255;

    [[nodiscard]] std::uint32_t begin() const { return bits_ & 0xFFFFU; }
    [[nodiscard]] std::uint32_t in_tier(int tier) const {
        return tier == 0 ? bits_ >> 16 & 0xFFU : bits_ >> 24;
    }
    [[nodiscard]] std::uint32_t bits() const { return bits_; }

  private:
    std::uint32_t bits_;
};

// A rare posting: 17 bits of slot and 7 of rank.
struct RarePosting {
    static constexpr std::size_t kBytes = 3;
    int slot = 0;
    int rank = 0;
};
[[nodiscard]] inline RarePosting read_rare(const std::uint8_t* at) {
    const std::uint32_t bits =
        at[0] | std::uint32_t{at[1]} << 8 | std::uint32_t{at[2]} << 16;
    return {int(bits & (kMaxSegmentSlots - 1)), int(bits >> 17)};
}
inline void write_rare(const RarePosting& posting, std::uint8_t* at) {
    const std::uint32_t bits = std::uint32_t(posting.slot) | std::uint32_t(posting.rank)
                                                                 << 17;
    at[0] = static_cast<std::uint8_t>(bits);
    at[1] = static_cast<std::uint8_t>(bits >> 8);
    at[2] = static_cast<std::uint8_t>(bits >> 16);
}

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
    Span<std::uint32_t> directory;                          // [key]: DirectoryEntry
    std::array<Span<std::uint64_t>, kMaxTiers> rows;        // [dense][row_words]
    std::array<Span<std::uint64_t>, kMaxTiers> presence;    // [dense][presence_words]
    Span<std::uint64_t> coarse_rows;                        // [coarse][coarse_row_words]
    Span<std::uint16_t> coarse_row;                         // [warm + rare]: its row
    Span<std::uint32_t> warm_begin;                         // [warm][groups + 1]
    Span<std::uint32_t> warm_runs;                          // [warm][blocks + 1]: WarmRun
    Span<std::uint8_t> warm_slots;                          // within the block
    Span<std::uint32_t> rare_begin;                         // [rare + 1]
    Span<std::uint8_t> rare_postings;                       // slots rising in each list
    // From here on: what only another m, or a merge, asks for.
    Span<std::uint32_t> dense_keys;        // [dense in the top tier]
    Span<std::uint32_t> sparse_keys;       // [warm + rare]
    Span<std::uint32_t> dense_rank_begin;  // [dense][blocks]: of the block's first posting
    Span<std::uint8_t> dense_ranks;        // of each bit of the top tier's rows
    Span<std::uint8_t> warm_ranks;         // of each warm slot
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

// Where the run of a warm list in a block begins; that of the block after the last ends it.
template <bool kMutable>
[[nodiscard]] std::size_t warm_run_begin(const SegmentSpans<kMutable>& spans,
                                         std::size_t list,
                                         std::size_t block) {
    const auto groups = static_cast<std::size_t>(spans.counts.groups());
    const auto blocks = static_cast<std::size_t>(spans.counts.blocks());
    return spans.warm_begin[list * (groups + 1) + block / kGroupBlocks] +
           WarmRun(spans.warm_runs[list * (blocks + 1) + block]).begin();
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

// The segment in bytes that came from elsewhere. kUndecodable naming the first thing found that
// no builder writes; nothing that passes makes a search read outside of the bytes.
// Requires: aligned to 64.
[[nodiscard]] Result<SegmentView> view_segment(const SegmentCounts& counts,
                                               std::span<const std::byte> bytes);

}  // namespace haarmony::image
