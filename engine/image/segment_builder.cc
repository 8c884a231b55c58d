#include "engine/image/segment_builder.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <new>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "engine/image/picture_order.h"

namespace haarmony::image {
namespace {

constexpr std::align_val_t kAlignment{64};

// A list is dense in a tier where one picture in that many has it: from there on a row of
// bits is smaller than what the pictures would keep of it themselves.
constexpr std::uint32_t kDenseShare = 18;
// Pictures that have some list of a coarse row, each list counted: of four neighbours, one in
// five or so has one.
constexpr double kCoarseFill = 0.05;

AlignedBytes allocate(std::size_t size) {
    AlignedBytes bytes{{new (kAlignment) std::byte[size], {}}, size};
    std::memset(bytes.bytes.get(), 0, size);
    return bytes;
}

class Builder {
  public:
    Builder(int index_m, const PictureColumns& columns, const PostingSource& postings)
        : columns_(columns), postings_(postings), tiers_(tiers_of(index_m)) {
        counts_.index_m = static_cast<std::uint32_t>(index_m);
        counts_.slots = static_cast<std::uint32_t>(columns.ids.size());
        for (int rank = 0; rank < index_m; ++rank)
            tier_of_rank_[rank] = static_cast<std::uint8_t>(tiers_.holding(rank + 1));
    }

    BuiltSegment build() {
        count_and_order();
        classify();
        share_coarse_rows();
        count_own();
        bytes_ = allocate(segment_bytes(counts_).total);
        spans_ = spans_of(counts_, bytes_.span());
        fill_columns();
        fill_bits();
        fill_dense_rank_begin();
        fill_ranks_and_own();
        sort_own();
        return {counts_, std::move(bytes_)};
    }

  private:
    struct ListSize {
        std::array<std::uint32_t, kMaxTiers> up_to_tier{};
    };

    void count_and_order();
    void classify();
    void share_coarse_rows();
    void count_own();
    void fill_columns();
    void fill_bits();
    void fill_dense_rank_begin();
    void fill_ranks_and_own();
    void sort_own();

    // Whether the picture itself has to keep the posting.
    [[nodiscard]] bool is_own(const DirectoryEntry& entry, int tier) const {
        return entry.dense() == DirectoryEntry::kNone ||
               tier < dense_from_[entry.dense()];
    }

    const PictureColumns& columns_;
    const PostingSource& postings_;
    Tiers tiers_;
    std::array<std::uint8_t, kMaxCoefficients> tier_of_rank_{};

    std::vector<ListSize> sizes_;            // [key]
    std::vector<std::uint32_t> place_of_;    // [slot]
    std::vector<std::uint32_t> slot_of_;     // [place]
    std::vector<DirectoryEntry> directory_;  // [key]
    std::vector<int> dense_from_;            // [dense]: the lowest tier
    std::vector<std::uint32_t> dense_keys_;
    std::vector<OwnCounts> own_counts_;  // [slot]

    SegmentCounts counts_;
    AlignedBytes bytes_;
    SegmentUnderConstruction spans_;
};

void Builder::count_and_order() {
    sizes_.resize(kKeyCount);
    std::vector<std::int8_t> coarse_bit(kKeyCount);
    for (std::uint32_t key = 0; key < kKeyCount; ++key)
        coarse_bit[key] = static_cast<std::int8_t>(CoarseSigns::bit_of(key));
    std::vector<CoarseSigns> signs(counts_.slots);
    place_of_.resize(counts_.slots);
    std::iota(place_of_.begin(), place_of_.end(), 0U);
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            ++sizes_[posting.key].up_to_tier[tier_of_rank_[posting.rank]];
            const int bit = coarse_bit[posting.key];
            if (bit >= 0) signs[posting.place].set(bit);
        }
    });
    for (ListSize& size : sizes_) {
        for (int t = 1; t < tiers_.count; ++t)
            size.up_to_tier[t] += size.up_to_tier[t - 1];
    }
    place_of_ = picture_order(columns_.terms, signs);
    slot_of_.resize(place_of_.size());
    for (std::uint32_t slot = 0; slot < place_of_.size(); ++slot)
        slot_of_[place_of_[slot]] = slot;
}

// Dense lists stand in the order of the lowest tier in which they are dense.
void Builder::classify() {
    directory_.resize(kKeyCount);
    for (int tier = 0; tier < tiers_.count; ++tier) {
        for (std::uint32_t key = 0; key < kKeyCount; ++key) {
            const std::uint64_t size = sizes_[key].up_to_tier[tier];
            if (size * kDenseShare < counts_.slots || size == 0) continue;
            if (directory_[key].dense() != DirectoryEntry::kNone) continue;
            directory_[key] = DirectoryEntry::of_dense(int(dense_keys_.size()));
            dense_keys_.push_back(key);
            dense_from_.push_back(tier);
            counts_.dense_postings += sizes_[key].up_to_tier[tiers_.top()];
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
        const std::uint32_t size = sizes_[key].up_to_tier[tiers_.top()];
        if (size == 0 || directory_[key].dense() != DirectoryEntry::kNone) continue;
        lists.emplace_back(size, key);
        postings += size;
    }
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

void Builder::count_own() {
    own_counts_.resize(counts_.slots);
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            const int tier = tier_of_rank_[posting.rank];
            if (!is_own(directory_[posting.key], tier)) continue;
            const int channel = int(posting.key / (2 * kCoefficientCount));
            ++counts_.own_postings;
            for (int t = tier; t < kMaxTiers; ++t)
                ++own_counts_[slot_of_[posting.place]][channel][t];
        }
    });
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

void Builder::fill_bits() {
    const std::size_t row_words = counts_.row_words();
    const std::size_t presence_words = counts_.presence_words();
    const std::size_t coarse_words = counts_.coarse_row_words();
    const auto set = [](std::span<std::uint64_t> row, std::size_t bit) {
        row[bit / 64] |= std::uint64_t{1} << (bit % 64);
    };
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            const DirectoryEntry entry = directory_[posting.key];
            const std::uint32_t slot = slot_of_[posting.place];
            if (entry.dense() == DirectoryEntry::kNone) {
                const auto row = std::size_t(entry.coarse());
                set(spans_.coarse_rows.subspan(row * coarse_words), slot / kCoarseSlots);
                continue;
            }
            const auto list = std::size_t(entry.dense());
            for (int t = std::max<int>(tier_of_rank_[posting.rank], dense_from_[list]);
                 t < tiers_.count;
                 ++t) {
                set(spans_.rows[t].subspan(list * row_words), slot);
                set(spans_.presence[t].subspan(list * presence_words),
                    slot / kBlockSlots);
            }
        }
    });
}

void Builder::fill_dense_rank_begin() {
    std::uint32_t next = 0;
    const auto rows = spans_.rows[std::size_t(tiers_.top())];
    const auto blocks = static_cast<std::size_t>(counts_.blocks());
    for (std::size_t list = 0; list < dense_keys_.size(); ++list) {
        for (std::size_t block = 0; block < blocks; ++block) {
            spans_.dense_rank_begin[list * blocks + block] = next;
            const auto bits = rows.subspan(
                list * counts_.row_words() + block * kBlockWords, kBlockWords);
            for (const std::uint64_t word : bits)
                next += static_cast<std::uint32_t>(std::popcount(word));
        }
    }
    assert(next == counts_.dense_postings);
}

void Builder::fill_ranks_and_own() {
    std::ranges::copy(own_counts_, spans_.own_counts.begin());
    std::uint32_t next = 0;
    for (std::size_t slot = 0; slot < counts_.slots; ++slot) {
        spans_.own_begin[slot] = next;
        for (const auto& tiers : own_counts_[slot]) next += tiers[kMaxTiers - 1];
    }
    spans_.own_begin[counts_.slots] = next;

    std::vector<std::array<std::uint8_t, kChannels>> filled(counts_.slots);
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            const DirectoryEntry entry = directory_[posting.key];
            const std::uint32_t slot = slot_of_[posting.place];
            if (entry.dense() != DirectoryEntry::kNone) {
                const auto list = static_cast<std::size_t>(entry.dense());
                spans_.dense_ranks[dense_rank_place(spans_, list, slot)] = posting.rank;
            }
            if (!is_own(entry, tier_of_rank_[posting.rank])) continue;
            const int channel = int(posting.key / (2 * kCoefficientCount));
            std::size_t place = spans_.own_begin[slot] + filled[slot][channel]++;
            for (int c = 0; c < channel; ++c)
                place += own_counts_[slot][c][kMaxTiers - 1];
            const int index = int(posting.key % kCoefficientCount);
            const bool negative = posting.key / kCoefficientCount % 2 != 0;
            spans_.own[place] = static_cast<std::int16_t>(negative ? -index : index);
            spans_.own_ranks[place] = posting.rank;
        }
    });
}

// Postings come in any order; a picture keeps its own by rank.
void Builder::sort_own() {
    std::vector<std::pair<std::uint8_t, std::int16_t>> list;
    for (std::size_t slot = 0; slot < counts_.slots; ++slot) {
        std::size_t begin = spans_.own_begin[slot];
        for (const auto& tiers : own_counts_[slot]) {
            const std::size_t count = tiers[kMaxTiers - 1];
            const auto ranks = spans_.own_ranks.subspan(begin, count);
            const auto own = spans_.own.subspan(begin, count);
            begin += count;
            if (std::ranges::is_sorted(ranks)) continue;
            list.clear();
            for (std::size_t i = 0; i < count; ++i) list.emplace_back(ranks[i], own[i]);
            std::ranges::sort(list);
            for (std::size_t i = 0; i < count; ++i) std::tie(ranks[i], own[i]) = list[i];
        }
    }
}

}  // namespace

void AlignedBytesDeleter::operator()(std::byte* bytes) const {
    ::operator delete[](bytes, kAlignment);
}

BuiltSegment build_segment(int index_m,
                           const PictureColumns& columns,
                           const PostingSource& postings) {
    assert(!columns.ids.empty() && columns.ids.size() <= std::size_t{kMaxSegmentSlots});
    return Builder(index_m, columns, postings).build();
}

}  // namespace haarmony::image
