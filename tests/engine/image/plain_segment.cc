#include "tests/engine/image/plain_segment.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <set>
#include <utility>
#include <vector>

#include "engine/image/picture_order.h"

namespace haarmony::image {
namespace {

struct InList {
    std::size_t slot = 0;
    int rank = 0;
};
using Lists = std::map<std::uint32_t, std::vector<InList>>;  // [key], by slot

std::vector<const Record*> in_order(std::span<const Record> records, int index_m) {
    std::vector<PictureTerms> terms;
    std::vector<CoarseSigns> signs;
    for (const Record& record : records) {
        PictureTerms& its_terms = terms.emplace_back();
        CoarseSigns& its_signs = signs.emplace_back();
        its_terms.log_aspect = record.log_aspect;
        for (int c = 0; c < kChannels; ++c) {
            its_terms.average[std::size_t(c)] = record.signature.channels[c].average;
            for (const int index : record.signature.channels[c].largest(index_m)) {
                const int bit = CoarseSigns::bit_of(coefficient_key(c, index));
                if (bit >= 0) its_signs.set(bit);
            }
        }
    }
    std::vector<const Record*> ordered;
    for (const std::uint32_t place : picture_order(terms, signs))
        ordered.push_back(&records[place]);
    return ordered;
}

std::size_t length(const std::vector<InList>& list, int m) {
    return static_cast<std::size_t>(
        std::ranges::count_if(list, [m](const InList& in) { return in.rank < m; }));
}

void set_bit(std::span<std::uint64_t> row, std::size_t bit) {
    row[bit / 64] |= std::uint64_t{1} << (bit % 64);
}

struct Directory {
    std::vector<std::uint32_t> dense_keys;
    std::map<std::uint32_t, DirectoryEntry> entries;  // [key]
};

// Dense: one picture in 18 has it, in some tier. The others go, the longest first and of
// equal ones the larger key, into the emptiest row of as many as are 5 % full.
Directory classify(const Lists& lists, SegmentCounts& counts) {
    const Tiers tiers = tiers_of(int(counts.index_m));
    Directory directory;
    for (int t = 0; t < tiers.count; ++t) {
        for (const auto& [key, list] : lists) {
            const std::size_t size = length(list, tiers.m[t]);
            if (size == 0 || size * 18 < counts.slots || directory.entries.contains(key))
                continue;
            directory.entries[key] =
                DirectoryEntry::of_dense(int(directory.dense_keys.size()));
            directory.dense_keys.push_back(key);
            counts.dense_postings += list.size();
        }
        counts.dense[t] = std::uint32_t(directory.dense_keys.size());
    }
    std::set<std::pair<std::size_t, std::uint32_t>, std::greater<>> others;
    std::size_t postings = 0;
    for (const auto& [key, list] : lists) {
        if (directory.entries.contains(key)) continue;
        others.emplace(list.size(), key);
        postings += list.size();
    }
    counts.coarse = std::uint32_t(std::ceil(double(postings) / (0.05 * counts.slots)));
    std::set<std::pair<std::size_t, int>> rows;  // how full, which
    for (int row = 0; row < int(counts.coarse); ++row) rows.emplace(0, row);
    for (const auto& [size, key] : others) {
        const auto [fill, row] = *rows.begin();
        rows.erase(rows.begin());
        rows.emplace(fill + size, row);
        directory.entries[key] = DirectoryEntry::of_coarse(row);
    }
    return directory;
}

// Whether a row of the tier that the rank is of has the posting.
bool in_row(const SegmentCounts& counts, DirectoryEntry entry, int rank) {
    const Tiers tiers = tiers_of(int(counts.index_m));
    return entry.dense() != DirectoryEntry::kNone &&
           entry.dense() < int(counts.dense[std::size_t(tiers.holding(rank + 1))]);
}

template <typename Visit>
void for_each_coefficient(const Record& record, int index_m, Visit visit) {
    for (int c = 0; c < kChannels; ++c) {
        int rank = 0;
        for (const std::int16_t index : record.signature.channels[c].largest(index_m))
            visit(c, rank++, index);
    }
}

void fill_rows(const Lists& lists,
               const Directory& directory,
               const SegmentUnderConstruction& spans) {
    const SegmentCounts& counts = spans.counts;
    for (const auto& [key, list] : lists) {
        const DirectoryEntry entry = directory.entries.at(key);
        spans.directory[key] = entry.bits();
        for (const InList& in : list) {
            if (entry.dense() == DirectoryEntry::kNone) {
                set_bit(spans.coarse_rows.subspan(std::size_t(entry.coarse()) *
                                                  counts.coarse_row_words()),
                        in.slot / kCoarseSlots);
                continue;
            }
            const auto row = std::size_t(entry.dense());
            for (int t = 0; t < spans.tiers.count; ++t) {
                if (in.rank >= spans.tiers.m[t] || row >= counts.dense[t]) continue;
                set_bit(spans.rows[t].subspan(row * counts.row_words()), in.slot);
                set_bit(spans.presence[t].subspan(row * counts.presence_words()),
                        in.slot / kBlockSlots);
            }
        }
    }
    std::uint32_t rank = 0;
    std::size_t begin = 0;
    for (const std::uint32_t key : directory.dense_keys) {
        std::size_t next = 0;
        const std::vector<InList>& list = lists.at(key);
        for (std::size_t block = 0; block < std::size_t(counts.blocks()); ++block) {
            spans.dense_rank_begin[begin++] = rank;
            for (; next < list.size() && list[next].slot / kBlockSlots == block; ++next)
                spans.dense_ranks[rank++] = std::uint8_t(list[next].rank);
        }
    }
}

}  // namespace

BuiltSegment plain_segment(std::span<const Record> records, int index_m) {
    const std::vector<const Record*> pictures = in_order(records, index_m);
    SegmentCounts counts;
    counts.index_m = std::uint32_t(index_m);
    counts.slots = std::uint32_t(pictures.size());
    Lists lists;
    for (std::size_t slot = 0; slot < pictures.size(); ++slot) {
        for_each_coefficient(*pictures[slot], index_m, [&](int c, int rank, int index) {
            lists[coefficient_key(c, index)].push_back({slot, rank});
        });
    }
    const Directory directory = classify(lists, counts);
    for (const auto& [key, list] : lists) {
        for (const InList& in : list)
            counts.own_postings +=
                in_row(counts, directory.entries.at(key), in.rank) ? 0 : 1;
    }
    const std::size_t size = segment_bytes(counts).total;
    BuiltSegment built{counts, {{new (std::align_val_t{64}) std::byte[size], {}}, size}};
    std::memset(built.bytes.bytes.get(), 0, size);
    const SegmentUnderConstruction spans = spans_of(counts, built.bytes.span());
    std::ranges::copy(directory.dense_keys, spans.dense_keys.begin());
    fill_rows(lists, directory, spans);
    for (int c = 0; c < kChannels; ++c) {
        std::ranges::fill(spans.lowest[c], std::numeric_limits<std::int32_t>::max());
        std::ranges::fill(spans.highest[c], std::numeric_limits<std::int32_t>::min());
    }
    std::map<ImageId, std::uint32_t> slots_by_id;
    std::uint32_t own = 0;
    for (std::size_t slot = 0; slot < pictures.size(); ++slot) {
        const Record& picture = *pictures[slot];
        slots_by_id[picture.id] = std::uint32_t(slot);
        spans.ids[slot] = to_int(picture.id);
        spans.terms[slot].log_aspect = picture.log_aspect;
        for (std::size_t c = 0; c < kChannels; ++c) {
            const std::int32_t average = picture.signature.channels[c].average;
            spans.terms[slot].average[c] = average;
            auto& lowest = spans.lowest[c][slot / kBlockSlots];
            auto& highest = spans.highest[c][slot / kBlockSlots];
            lowest = std::min(lowest, average);
            highest = std::max(highest, average);
        }
        spans.own_begin[slot] = own;
        for_each_coefficient(picture, index_m, [&](int c, int rank, std::int16_t index) {
            if (in_row(counts, directory.entries.at(coefficient_key(c, index)), rank))
                return;
            spans.own[own] = index;
            spans.own_ranks[own++] = std::uint8_t(rank);
            for (int t = spans.tiers.holding(rank + 1); t < kMaxTiers; ++t)
                ++spans.own_counts[slot][std::size_t(c)][std::size_t(t)];
        });
    }
    spans.own_begin[pictures.size()] = own;
    std::uint32_t place = 0;
    for (const auto& [id, slot] : slots_by_id) spans.slots_by_id[place++] = slot;
    return built;
}

}  // namespace haarmony::image
