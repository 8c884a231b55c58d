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
#include <utility>

#include "engine/image/picture_order.h"

namespace haarmony::image {
namespace {

constexpr std::align_val_t kAlignment{64};

// A list is dense in a tier where one picture in that many has it. In the top tier a row of
// bits is the smaller form above one in nine or so; below it, where rows save time as well,
// earlier.
constexpr std::array<std::uint32_t, kMaxTiers> kDenseShare = {16, 14, 10};

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
        // A warm run cannot say that all pictures of a block have a coefficient. Where it
        // would have to, the list is made dense, and what was laid out is laid out anew.
        do {
            classify();
            share_coarse_rows();
            count_warm_runs();
        } while (crowded_);
        lay_out();
        fill();
        return {counts_, std::move(bytes_)};
    }

  private:
    struct ListSize {
        std::array<std::uint32_t, kMaxTiers> up_to_tier{};
    };

    void count_and_order();
    void classify();
    void share_coarse_rows();
    void count_warm_runs();
    void lay_out();
    void fill();
    void fill_columns();
    void fill_warm_runs();
    void fill_bits_and_rare();
    void fill_dense_rank_begin();
    void fill_ranks_and_warm();
    void sort_rare();

    [[nodiscard]] std::size_t warm_cell(int warm, int block, int tier) const {
        return (std::size_t(warm) * std::size_t(counts_.blocks()) + std::size_t(block)) *
                   kMaxTiers +
               std::size_t(tier);
    }
    // Whether the posting is in the list that the key has beside its dense one.
    [[nodiscard]] bool is_sparse(const DirectoryEntry& entry, int tier) const {
        return entry.dense() == DirectoryEntry::kNone || tier < dense_from_[entry.dense()];
    }

    const PictureColumns& columns_;
    const PostingSource& postings_;
    Tiers tiers_;
    std::array<std::uint8_t, kMaxCoefficients> tier_of_rank_{};

    std::vector<ListSize> sizes_;           // [key]
    std::vector<std::uint32_t> place_of_;   // [slot]
    std::vector<std::uint32_t> slot_of_;    // [place]
    std::vector<bool> forced_dense_;         // [key], in every tier
    std::vector<DirectoryEntry> directory_;  // [key]
    std::vector<int> dense_from_;           // [dense]: the lowest tier
    std::vector<std::uint32_t> dense_keys_;
    std::vector<std::uint32_t> sparse_keys_;
    std::vector<std::uint16_t> coarse_row_;   // [sparse]
    std::vector<std::uint16_t> warm_counts_;  // [warm][block][tier]
    bool crowded_ = false;

    SegmentCounts counts_;
    AlignedBytes bytes_;
    SegmentUnderConstruction spans_;
};

void Builder::count_and_order() {
    sizes_.resize(kKeyCount);
    forced_dense_.resize(kKeyCount);
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
        for (int t = 1; t < tiers_.count; ++t) size.up_to_tier[t] += size.up_to_tier[t - 1];
    }
    place_of_ = picture_order(columns_.terms, signs);
    slot_of_.resize(place_of_.size());
    for (std::uint32_t slot = 0; slot < place_of_.size(); ++slot)
        slot_of_[place_of_[slot]] = slot;
}

void Builder::classify() {
    // The lowest tier from which on each key is dense; tiers_.count for none.
    std::vector<std::uint8_t> from(kKeyCount);
    counts_.dense = {};
    for (std::uint32_t key = 0; key < kKeyCount; ++key) {
        const auto& size = sizes_[key].up_to_tier;
        int tier = 0;
        while (tier < tiers_.count && !forced_dense_[key] &&
               std::uint64_t{size[tier]} *
                       kDenseShare[tier + kMaxTiers - tiers_.count] <
                   counts_.slots) {
            ++tier;
        }
        from[key] = static_cast<std::uint8_t>(tier);
        for (int t = tier; t < tiers_.count; ++t) ++counts_.dense[t];
    }

    // A warm list pays for its runs what a rare one pays for its longer postings.
    const std::uint32_t warm_cost = 4 * (std::uint32_t(counts_.groups()) + 1) +
                                    4 * (std::uint32_t(counts_.blocks()) + 1);
    dense_keys_.clear();
    dense_from_.clear();
    std::vector<std::uint32_t> warm_keys;
    std::vector<std::uint32_t> rare_keys;
    counts_.dense_postings = counts_.warm_postings = counts_.rare_postings = 0;
    std::vector<int> dense(kKeyCount, DirectoryEntry::kNone);
    for (int t = 0; t <= tiers_.count; ++t) {
        for (std::uint32_t key = 0; key < kKeyCount; ++key) {
            if (from[key] != t) continue;
            const auto& size = sizes_[key].up_to_tier;
            if (t < tiers_.count) {
                dense[key] = static_cast<int>(dense_keys_.size());
                dense_keys_.push_back(key);
                dense_from_.push_back(t);
                counts_.dense_postings += size[tiers_.top()];
            }
            const std::uint32_t below = t == 0 ? 0 : size[t - 1];
            if (below == 0) continue;
            // A rare posting is three bytes with its rank, a warm one two.
            if (below > warm_cost) {
                warm_keys.push_back(key);
                counts_.warm_postings += below;
            } else {
                rare_keys.push_back(key);
                counts_.rare_postings += below;
            }
        }
    }
    assert(dense_keys_.size() <= std::size_t{kMaxDenseLists});
    counts_.warm = static_cast<std::uint32_t>(warm_keys.size());
    counts_.rare = static_cast<std::uint32_t>(rare_keys.size());
    sparse_keys_ = std::move(warm_keys);
    sparse_keys_.insert(sparse_keys_.end(), rare_keys.begin(), rare_keys.end());
    std::vector<int> sparse(kKeyCount, DirectoryEntry::kNone);
    for (std::size_t i = 0; i < sparse_keys_.size(); ++i)
        sparse[sparse_keys_[i]] = static_cast<int>(i);
    directory_.resize(kKeyCount);
    for (std::uint32_t key = 0; key < kKeyCount; ++key)
        directory_[key] = DirectoryEntry(dense[key], sparse[key]);
}

// Each list, the longest first, joins the row that is emptiest. A list that is dense above
// has a row there.
void Builder::share_coarse_rows() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> lists;  // size, sparse list
    std::uint64_t postings = 0;
    for (std::uint32_t list = 0; list < sparse_keys_.size(); ++list) {
        const std::uint32_t key = sparse_keys_[list];
        if (directory_[key].dense() != DirectoryEntry::kNone) continue;
        lists.emplace_back(sizes_[key].up_to_tier[tiers_.top()], list);
        postings += lists.back().first;
    }
    std::ranges::sort(lists, std::greater<>());
    coarse_row_.assign(sparse_keys_.size(), 0);
    const auto wanted = static_cast<std::uint32_t>(
        std::ceil(double(postings) / (kCoarseFill * counts_.slots)));
    counts_.coarse = std::min(wanted, static_cast<std::uint32_t>(lists.size()));
    if (counts_.coarse == 0 && !sparse_keys_.empty()) counts_.coarse = 1;
    using Row = std::pair<std::uint64_t, std::uint16_t>;  // fill, row
    std::priority_queue<Row, std::vector<Row>, std::greater<>> rows;
    for (std::uint32_t row = 0; row < counts_.coarse; ++row)
        rows.emplace(0, static_cast<std::uint16_t>(row));
    for (const auto& [size, list] : lists) {
        const auto [fill, row] = rows.top();
        rows.pop();
        coarse_row_[list] = row;
        rows.emplace(fill + size, row);
    }
}

void Builder::count_warm_runs() {
    warm_counts_.assign(warm_cell(int(counts_.warm), 0, 0), 0);
    crowded_ = false;
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            const DirectoryEntry entry = directory_[posting.key];
            const int tier = tier_of_rank_[posting.rank];
            if (entry.sparse() == DirectoryEntry::kNone ||
                entry.sparse() >= int(counts_.warm) || !is_sparse(entry, tier))
                continue;
            const int block = int(slot_of_[posting.place]) / kBlockSlots;
            ++warm_counts_[warm_cell(entry.sparse(), block, tier)];
        }
    });
    for (int warm = 0; warm < int(counts_.warm); ++warm) {
        for (int block = 0; block < counts_.blocks(); ++block) {
            const std::uint16_t* const tiers = &warm_counts_[warm_cell(warm, block, 0)];
            if (tiers[0] + tiers[1] + tiers[2] <= int(WarmRun::kMaxCount)) continue;
            crowded_ = true;
            forced_dense_[sparse_keys_[warm]] = true;
        }
    }
}

void Builder::lay_out() {
    bytes_ = allocate(segment_bytes(counts_).total);
    spans_ = spans_of(counts_, bytes_.span());
}

void Builder::fill() {
    fill_columns();
    std::ranges::copy(dense_keys_, spans_.dense_keys.begin());
    std::ranges::copy(sparse_keys_, spans_.sparse_keys.begin());
    std::ranges::transform(
        directory_, spans_.directory.begin(), &DirectoryEntry::bits);
    std::ranges::copy(coarse_row_, spans_.coarse_row.begin());
    fill_warm_runs();
    fill_bits_and_rare();
    fill_dense_rank_begin();
    fill_ranks_and_warm();
}

void Builder::fill_columns() {
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

// From the counts to where each run begins; the counts become places to fill.
void Builder::fill_warm_runs() {
    const int blocks = counts_.blocks();
    const int groups = counts_.groups();
    std::uint32_t next = 0;
    for (int warm = 0; warm < int(counts_.warm); ++warm) {
        const auto begin =
            spans_.warm_begin.subspan(std::size_t(warm * (groups + 1)), groups + 1);
        const auto runs =
            spans_.warm_runs.subspan(std::size_t(warm * (blocks + 1)), blocks + 1);
        for (int block = 0; block < blocks; ++block) {
            std::uint32_t& group = begin[block / kGroupBlocks];
            if (block % kGroupBlocks == 0) group = next;
            std::uint16_t* const tiers = &warm_counts_[warm_cell(warm, block, 0)];
            const std::uint32_t first = tiers[0];
            const std::uint32_t first_two = first + tiers[1];
            const std::uint32_t all = first_two + tiers[2];
            runs[block] = WarmRun(next - group, first, first_two).bits();
            tiers[0] = 0;
            tiers[1] = static_cast<std::uint16_t>(first);
            tiers[2] = static_cast<std::uint16_t>(first_two);
            next += all;
        }
        if (blocks % kGroupBlocks == 0) begin[groups] = next;
        runs[blocks] = WarmRun(next - begin[blocks / kGroupBlocks], 0, 0).bits();
        begin[groups] = next;
    }
}

void Builder::fill_bits_and_rare() {
    std::uint32_t next = 0;
    std::vector<std::uint32_t> rare_next;
    for (std::uint32_t rare = 0; rare < counts_.rare; ++rare) {
        const std::uint32_t key = sparse_keys_[counts_.warm + rare];
        const int dense = directory_[key].dense();
        const int top = dense == DirectoryEntry::kNone ? tiers_.top() : dense_from_[dense] - 1;
        spans_.rare_begin[rare] = next;
        rare_next.push_back(next);
        next += sizes_[key].up_to_tier[top];
    }
    spans_.rare_begin[counts_.rare] = next;

    const std::size_t row_words = counts_.row_words();
    const std::size_t presence_words = counts_.presence_words();
    const std::size_t coarse_words = counts_.coarse_row_words();
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            const DirectoryEntry entry = directory_[posting.key];
            const int tier = tier_of_rank_[posting.rank];
            const std::uint32_t slot = slot_of_[posting.place];
            if (entry.dense() != DirectoryEntry::kNone) {
                const std::uint32_t block = slot / kBlockSlots;
                for (int t = std::max(tier, dense_from_[entry.dense()]); t < tiers_.count;
                     ++t) {
                    const auto list = static_cast<std::size_t>(entry.dense());
                    spans_.rows[t][list * row_words + slot / 64] |= std::uint64_t{1}
                                                                    << (slot % 64);
                    spans_.presence[t][list * presence_words + block / 64] |=
                        std::uint64_t{1} << (block % 64);
                }
            }
            if (entry.dense() == DirectoryEntry::kNone) {
                const std::size_t row = coarse_row_[std::size_t(entry.sparse())];
                const std::uint32_t bit = slot / kCoarseSlots;
                spans_.coarse_rows[row * coarse_words + bit / 64] |= std::uint64_t{1}
                                                                     << (bit % 64);
            }
            if (entry.sparse() >= int(counts_.warm) && is_sparse(entry, tier)) {
                std::uint32_t& place = rare_next[std::size_t(entry.sparse()) - counts_.warm];
                write_rare({int(slot), posting.rank},
                           &spans_.rare_postings[place++ * RarePosting::kBytes]);
            }
        }
    });
    sort_rare();
}

void Builder::sort_rare() {
    std::vector<RarePosting> list;
    for (std::uint32_t rare = 0; rare < counts_.rare; ++rare) {
        const std::uint32_t begin = spans_.rare_begin[rare];
        const std::uint32_t end = spans_.rare_begin[rare + 1];
        list.clear();
        for (std::uint32_t i = begin; i < end; ++i)
            list.push_back(read_rare(&spans_.rare_postings[i * RarePosting::kBytes]));
        std::ranges::sort(list, {}, &RarePosting::slot);
        for (std::uint32_t i = begin; i < end; ++i)
            write_rare(list[i - begin], &spans_.rare_postings[i * RarePosting::kBytes]);
    }
}

void Builder::fill_dense_rank_begin() {
    std::uint32_t next = 0;
    const auto rows = spans_.rows[std::size_t(tiers_.top())];
    const auto blocks = static_cast<std::size_t>(counts_.blocks());
    for (std::size_t list = 0; list < dense_keys_.size(); ++list) {
        for (std::size_t block = 0; block < blocks; ++block) {
            spans_.dense_rank_begin[list * blocks + block] = next;
            const auto bits =
                rows.subspan(list * counts_.row_words() + block * kBlockWords, kBlockWords);
            for (const std::uint64_t word : bits)
                next += static_cast<std::uint32_t>(std::popcount(word));
        }
    }
    assert(next == counts_.dense_postings);
}

void Builder::fill_ranks_and_warm() {
    postings_(place_of_, [&](std::span<const PlacedPosting> some) {
        for (const PlacedPosting& posting : some) {
            const DirectoryEntry entry = directory_[posting.key];
            const int tier = tier_of_rank_[posting.rank];
            const std::uint32_t slot = slot_of_[posting.place];
            const std::uint32_t block = slot / kBlockSlots;
            if (entry.dense() != DirectoryEntry::kNone) {
                const auto list = static_cast<std::size_t>(entry.dense());
                spans_.dense_ranks[dense_rank_place(spans_, list, slot)] =
                    posting.rank;
            }
            if (entry.sparse() == DirectoryEntry::kNone ||
                entry.sparse() >= int(counts_.warm) || !is_sparse(entry, tier))
                continue;
            const std::size_t place =
                warm_run_begin(spans_, std::size_t(entry.sparse()), block) +
                warm_counts_[warm_cell(entry.sparse(), int(block), tier)]++;
            spans_.warm_slots[place] = static_cast<std::uint8_t>(slot % kBlockSlots);
            spans_.warm_ranks[place] = posting.rank;
        }
    });
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
