// The six search arrays as they stand in the dissertation, for a sample of pictures that are
// all compared with one another: signature.h -> [search_arrays.h] -> symmetric_metric.h. The
// collection itself is searched in segments (segment_layout.h).
//
// Shape   one list per sign, channel and place (kKeyCount of them, see coefficient_key()),
//         all in one array, list after list; a posting is the slot of a picture within the
//         block (16 bits) and the rank of the coefficient within its channel (8 bits), so
//         that every m up to index_m is answered from the same lists.
// Errors  none; more than kMaxSlots pictures is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.3.1 (search arrays), Figure 4.2 (the inner loops).
#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/query.h"

namespace haarmony::image {

// A block is small enough for 16-bit slots, and for the running sums of a query (4 bytes a
// slot) to stay in the second-level cache.
inline constexpr int kMaxSlots = 65536;

struct Posting {
    std::uint32_t key = 0;
    int slot = 0;  // 0..kMaxSlots - 1
    int rank = 0;  // 0..index_m - 1
};

class SearchArrays {
  public:
    // `for_each(sink)` must call sink(Posting) for every posting, and do so twice alike:
    // once to count, once to place. No allocation per posting.
    template <typename ForEachPosting>
    SearchArrays(int index_m, const ForEachPosting& for_each);

    // Adds to matched[slot] the weight of every term that the picture in the slot has among
    // its query.m largest (Figure 4.2, the loops over lists).
    // Requires: matched covers all slots. Cost: the postings of the query's lists.
    void add_matches(const Query& query, std::span<std::int32_t> matched) const;

    // Calls visit(Posting) for every posting, list after list.
    template <typename Visit>
    void for_each_posting(const Visit& visit) const;

    [[nodiscard]] int index_m() const { return index_m_; }
    [[nodiscard]] std::int64_t bytes() const;

  private:
    int index_m_;
    std::vector<std::uint32_t> begin_;  // list k is [begin_[k], begin_[k + 1])
    std::vector<std::uint16_t> slots_;
    std::vector<std::uint8_t> ranks_;
};

template <typename ForEachPosting>
SearchArrays::SearchArrays(int index_m, const ForEachPosting& for_each)
    : index_m_(index_m), begin_(std::size_t{kKeyCount} + 1) {
    for_each([this](const Posting& posting) { ++begin_[posting.key + 1]; });
    for (std::size_t key = 0; key < kKeyCount; ++key) begin_[key + 1] += begin_[key];
    slots_.resize(begin_.back());
    ranks_.resize(begin_.back());
    std::vector<std::uint32_t> next = begin_;
    for_each([&](const Posting& posting) {
        assert(posting.slot >= 0 && posting.slot < kMaxSlots);
        const std::uint32_t place = next[posting.key]++;
        slots_[place] = static_cast<std::uint16_t>(posting.slot);
        ranks_[place] = static_cast<std::uint8_t>(posting.rank);
    });
}

template <typename Visit>
void SearchArrays::for_each_posting(const Visit& visit) const {
    for (std::uint32_t key = 0; key < kKeyCount; ++key) {
        for (std::uint32_t i = begin_[key]; i < begin_[key + 1]; ++i) {
            visit(Posting{key, slots_[i], ranks_[i]});
        }
    }
}

}  // namespace haarmony::image
