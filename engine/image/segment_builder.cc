#include "engine/image/segment_builder.h"

#include <sys/mman.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <queue>
#include <utility>

#include "engine/image/picture_order.h"
#include "engine/image/row_writer.h"
#include "engine/image/sorted_channel.h"

namespace haarmony::image {
namespace {

constexpr std::align_val_t kAlignment{64};

// A list is dense in a tier where one picture in that many has it: from there on a row of
// bits is smaller than what the pictures would keep of it themselves.
constexpr std::uint32_t kDenseShare = 18;
// Pictures that have some list of a coarse row, each list counted: of four neighbours, one in
// five or so has one.
constexpr double kCoarseFill = 0.05;

// The rows of a block stand pages apart: with pages of 4 KB each is a miss of its own in the
// table of pages, for whoever writes and for every search. Where the system has no larger
// ones, or refuses, nothing is lost but time.
void ask_for_large_pages(std::span<std::byte> bytes) {
    constexpr std::size_t kLargePage = std::size_t{1} << 21;
    void* begin = bytes.data();
    std::size_t size = bytes.size();
    if (std::align(kLargePage, kLargePage, begin, size) == nullptr) return;
    madvise(begin, size / kLargePage * kLargePage, MADV_HUGEPAGE);
}

AlignedBytes allocate(std::size_t size) {
    AlignedBytes bytes{{new (kAlignment) std::byte[size], {}}, size};
    ask_for_large_pages(bytes.span());
    std::memset(bytes.bytes.get(), 0, size);
    return bytes;
}

class Builder {
  public:
    Builder(int index_m, const PictureColumns& columns, const PictureSource& pictures)
        : columns_(columns), pictures_(pictures), tiers_(tiers_of(index_m)) {
        counts_.index_m = static_cast<std::uint32_t>(index_m);
        counts_.slots = static_cast<std::uint32_t>(columns.ids.size());
    }

    BuiltSegment build() {
        count_and_order();
        classify();
        share_coarse_rows();
        bytes_ = allocate(segment_bytes(counts_).total);
        spans_ = spans_of(counts_, bytes_.span());
        fill_columns();
        fill_blocks();
        return {counts_, std::move(bytes_)};
    }

  private:
    void count_and_order();
    void classify();
    void share_coarse_rows();
    void fill_columns();
    void fill_blocks();

    const PictureColumns& columns_;
    const PictureSource& pictures_;
    Tiers tiers_;

    // Of each list, [tier][key]: apart, since what neighbours have in common is their tier.
    std::array<std::vector<std::uint32_t>, kMaxTiers> sizes_;
    std::vector<std::uint32_t> place_of_;    // [slot]
    std::vector<DirectoryEntry> directory_;  // [key]
    std::vector<std::uint32_t> dense_keys_;

    SegmentCounts counts_;
    AlignedBytes bytes_;
    SegmentUnderConstruction spans_;
};

void Builder::count_and_order() {
    for (int t = 0; t < tiers_.count; ++t) sizes_[t].resize(kKeyCount);
    std::vector<CoarseSigns> signs(counts_.slots);
    // Of the picture in hand: the keys of those coefficients that have a bit, one in ten or so.
    std::array<std::uint32_t, kChannels * kMaxCoefficients + 1> coarse{};
    pictures_.give_all([&](std::uint32_t place, const PictureCoefficients& picture) {
        std::size_t coarse_count = 0;
        for (int c = 0; c < kChannels; ++c) {
            std::size_t rank = 0;
            for (int t = 0; t < tiers_.count; ++t) {
                const std::size_t end =
                    std::min(picture[c].size(), std::size_t(tiers_.m[t]));
                for (; rank < end; ++rank) {
                    const std::uint32_t key = coefficient_key(c, picture[c][rank]);
                    ++sizes_[t][key];
                    coarse[coarse_count] = key;
                    coarse_count += CoarseSigns::has_bit(key) ? 1 : 0;
                }
            }
        }
        for (std::size_t i = 0; i < coarse_count; ++i)
            signs[place].set(CoarseSigns::bit_of(coarse[i]));
    });
    for (int t = 1; t < tiers_.count; ++t)
        std::ranges::transform(
            sizes_[t], sizes_[t - 1], sizes_[t].begin(), std::plus<>());
    place_of_ = picture_order(columns_.terms, signs);
}

// Dense lists stand in the order of the lowest tier in which they are dense.
void Builder::classify() {
    directory_.resize(kKeyCount);
    for (int tier = 0; tier < tiers_.count; ++tier) {
        for (std::uint32_t key = 0; key < kKeyCount; ++key) {
            const std::uint64_t size = sizes_[tier][key];
            if (size * kDenseShare < counts_.slots || size == 0) continue;
            if (directory_[key].dense() != DirectoryEntry::kNone) continue;
            directory_[key] = DirectoryEntry::of_dense(int(dense_keys_.size()));
            dense_keys_.push_back(key);
            counts_.dense_postings += sizes_[tiers_.top()][key];
            // What is of lower tiers the pictures keep themselves.
            if (tier > 0) counts_.own_postings += sizes_[tier - 1][key];
        }
        counts_.dense[tier] = static_cast<std::uint32_t>(dense_keys_.size());
    }
    // At most kDenseShare * 300 lists can be so long.
    assert(dense_keys_.size() < std::size_t{DirectoryEntry::kMost});
}

// Each list, the longest first, joins the row that is emptiest.
void Builder::share_coarse_rows() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> lists;  // size, key
    std::uint64_t postings = 0;
    for (std::uint32_t key = 0; key < kKeyCount; ++key) {
        const std::uint32_t size = sizes_[tiers_.top()][key];
        if (size == 0 || directory_[key].dense() != DirectoryEntry::kNone) continue;
        lists.emplace_back(size, key);
        postings += size;
    }
    counts_.own_postings += postings;
    std::ranges::sort(lists, std::greater<>());
    counts_.coarse = static_cast<std::uint32_t>(
        std::ceil(double(postings) / (kCoarseFill * counts_.slots)));
    assert(counts_.coarse < std::uint32_t{DirectoryEntry::kMost});
    using Row = std::pair<std::uint64_t, int>;  // fill, row
    std::priority_queue<Row, std::vector<Row>, std::greater<>> rows;
    for (int row = 0; row < int(counts_.coarse); ++row) rows.emplace(0, row);
    for (const auto& [size, key] : lists) {
        const auto [fill, row] = rows.top();
        rows.pop();
        directory_[key] = DirectoryEntry::of_coarse(row);
        rows.emplace(fill + size, row);
    }
}

void Builder::fill_columns() {
    std::ranges::copy(dense_keys_, spans_.dense_keys.begin());
    std::ranges::transform(directory_, spans_.directory.begin(), &DirectoryEntry::bits);
    for (std::uint32_t slot = 0; slot < counts_.slots; ++slot) {
        const std::uint32_t place = place_of_[slot];
        spans_.ids[slot] = to_int(columns_.ids[place]);
        spans_.slots_by_id[place] = slot;
        spans_.terms[slot] = columns_.terms[place];
    }
    for (int c = 0; c < kChannels; ++c) {
        const auto& lowest = spans_.lowest[c];
        const auto& highest = spans_.highest[c];
        std::ranges::fill(lowest, std::numeric_limits<std::int32_t>::max());
        std::ranges::fill(highest, std::numeric_limits<std::int32_t>::min());
        for (std::uint32_t slot = 0; slot < counts_.slots; ++slot) {
            const std::int32_t average = spans_.terms[slot].average[c];
            const std::uint32_t block = slot / kBlockSlots;
            lowest[block] = std::min(lowest[block], average);
            highest[block] = std::max(highest[block], average);
        }
    }
}

void Builder::fill_blocks() {
    std::vector<std::uint32_t> list_sizes;
    for (const std::uint32_t key : dense_keys_)
        list_sizes.push_back(sizes_[tiers_.top()][key]);
    RowWriter rows(spans_, list_sizes);
    std::size_t slot = 0;
    std::uint32_t own = 0;
    SortedChannel channel(tiers_, counts_.dense, directory_);
    pictures_.give(place_of_, [&](std::uint32_t, const PictureCoefficients& picture) {
        spans_.own_begin[slot] = own;
        for (int c = 0; c < kChannels; ++c) {
            channel.sort(c, picture[c]);
            for (const DensePosting& posting : channel.dense())
                rows.put_dense(posting.list, posting.rank, posting.tier);
            for (const std::uint16_t row : channel.coarse_rows()) rows.put_coarse(row);
            std::ranges::copy(channel.own(), spans_.own.begin() + own);
            std::ranges::copy(channel.own_ranks(), spans_.own_ranks.begin() + own);
            spans_.own_counts[slot][c] = channel.own_in_tier();
            own += static_cast<std::uint32_t>(channel.own().size());
        }
        rows.next_slot();
        ++slot;
    });
    assert(slot == counts_.slots && own == counts_.own_postings);
    spans_.own_begin[slot] = own;
}

}  // namespace

void AlignedBytesDeleter::operator()(std::byte* bytes) const {
    ::operator delete[](bytes, kAlignment);
}

BuiltSegment build_segment(int index_m,
                           const PictureColumns& columns,
                           const PictureSource& pictures) {
    assert(!columns.ids.empty() && columns.ids.size() <= std::size_t{kMaxSegmentSlots});
    return Builder(index_m, columns, pictures).build();
}

}  // namespace haarmony::image
