#include "engine/image/segment_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <string>
#include <utility>

namespace haarmony::image {
namespace {

constexpr std::size_t kAlignment = 64;

// Hands out the parts of a segment's bytes one after another, each aligned.
template <bool kMutable>
class Carver {
  public:
    using Byte = std::conditional_t<kMutable, std::byte, const std::byte>;

    explicit Carver(Byte* bytes) : bytes_(bytes) {}

    template <typename T>
    void carve(std::span<T>& part, std::size_t count) {
        // With no bytes only the sizes are wanted.
        if (bytes_ != nullptr)
            part = std::span<T>(reinterpret_cast<T*>(bytes_ + used_), count);
        used_ = (used_ + count * sizeof(T) + kAlignment - 1) / kAlignment * kAlignment;
    }
    [[nodiscard]] std::size_t used() const { return used_; }

  private:
    Byte* bytes_;
    std::size_t used_ = 0;
};

template <bool kMutable>
SegmentSpans<kMutable> carve_all(const SegmentCounts& counts,
                                 typename Carver<kMutable>::Byte* bytes,
                                 SegmentBytes& sizes) {
    SegmentSpans<kMutable> spans;
    spans.counts = counts;
    spans.tiers = tiers_of(static_cast<int>(counts.index_m));
    Carver<kMutable> carver(bytes);
    const auto slots = std::size_t{counts.slots};
    const auto blocks = static_cast<std::size_t>(counts.blocks());
    const std::size_t dense = counts.dense[std::size_t(spans.tiers.top())];
    carver.carve(spans.terms, slots);
    carver.carve(spans.ids, slots);
    carver.carve(spans.slots_by_id, slots);
    for (auto& lowest : spans.lowest) carver.carve(lowest, blocks);
    for (auto& highest : spans.highest) carver.carve(highest, blocks);
    carver.carve(spans.directory, kKeyCount);
    for (int t = 0; t < spans.tiers.count; ++t) {
        carver.carve(spans.rows[t], counts.dense[t] * counts.row_words());
        carver.carve(spans.presence[t], counts.dense[t] * counts.presence_words());
    }
    carver.carve(spans.coarse_rows, counts.coarse * counts.coarse_row_words());
    carver.carve(spans.own_begin, slots + 1);
    carver.carve(spans.own_counts, slots);
    carver.carve(spans.own, counts.own_postings);
    sizes.without_ranks = carver.used();
    carver.carve(spans.dense_keys, dense);
    carver.carve(spans.dense_rank_begin, dense * blocks);
    carver.carve(spans.dense_ranks, counts.dense_postings);
    carver.carve(spans.own_ranks, counts.own_postings);
    sizes.total = carver.used();
    return spans;
}

Error corrupt(const std::string& what) {
    return {ErrorCode::kUndecodable, "a segment of the index is damaged: " + what};
}

std::string at(const char* what, std::size_t place, std::uint64_t value) {
    return std::string(what) + " " + std::to_string(place) + " is " +
           std::to_string(value);
}

bool counts_are_possible(const SegmentCounts& counts) {
    if (counts.index_m < 1 || counts.index_m > kMaxCoefficients) return false;
    if (counts.slots < 1 || counts.slots > kMaxSegmentSlots) return false;
    const Tiers tiers = tiers_of(static_cast<int>(counts.index_m));
    for (int t = 0; t < kMaxTiers; ++t) {
        if (t >= tiers.count && counts.dense[t] != 0) return false;
        if (counts.dense[t] > DirectoryEntry::kMost) return false;
        if (t > 0 && t < tiers.count && counts.dense[t] < counts.dense[t - 1])
            return false;
    }
    const std::uint64_t postings =
        std::uint64_t{counts.slots} * kChannels * counts.index_m;
    return counts.coarse <= DirectoryEntry::kMost && counts.dense_postings <= postings &&
           counts.own_postings <= postings;
}

// Every slot stands in slots_by_id once, and its ids rise.
Result<void> check_ids(const SegmentView& view) {
    std::int64_t last = 0;
    std::size_t place = 0;
    for (const std::uint32_t slot : view.slots_by_id) {
        if (slot >= view.counts.slots) return corrupt(at("slot by id", place, slot));
        if (view.ids[slot] <= last)
            return corrupt(at("id in order", place, std::uint64_t(view.ids[slot])));
        last = view.ids[slot];
        ++place;
    }
    return {};
}

Result<void> check_directory(const SegmentView& view) {
    const auto dense = int(view.counts.dense[std::size_t(view.tiers.top())]);
    const auto coarse = int(view.counts.coarse);
    for (std::size_t key = 0; key < view.directory.size(); ++key) {
        const DirectoryEntry entry(view.directory[key]);
        if (entry.dense() >= dense || entry.coarse() >= coarse)
            return corrupt(at("directory entry", key, entry.bits()));
    }
    for (std::size_t list = 0; list < view.dense_keys.size(); ++list) {
        const std::uint32_t key = view.dense_keys[list];
        if (key >= kKeyCount || DirectoryEntry(view.directory[key]).dense() != int(list))
            return corrupt(at("key of list", list, key));
    }
    return {};
}

// The lists of the pictures follow one another, and their counts say how long they are.
Result<void> check_own(const SegmentView& view) {
    std::uint64_t next = 0;
    for (std::size_t slot = 0; slot < view.counts.slots; ++slot) {
        if (view.own_begin[slot] != next)
            return corrupt(at("begin of slot", slot, view.own_begin[slot]));
        for (const auto& tiers : view.own_counts[slot]) {
            for (int t = 0; t < kMaxTiers; ++t) {
                const bool rises = t == 0 || tiers[t] >= tiers[t - 1];
                if (!rises ||
                    tiers[t] > (t <= view.tiers.top() ? view.tiers.m[t] : tiers[t - 1]))
                    return corrupt(at("count of slot", slot, tiers[t]));
            }
            next += tiers[std::size_t(view.tiers.top())];
        }
    }
    if (view.own_begin.back() != next || next != view.counts.own_postings)
        return corrupt(at("end of slot", view.counts.slots, view.own_begin.back()));
    for (std::size_t i = 0; i < view.own.size(); ++i) {
        const int index = std::abs(int{view.own[i]});
        if (index < 1 || index >= kCoefficientCount)
            return corrupt(at("coefficient", i, std::uint64_t(index)));
    }
    return {};
}

// The ranks of each block of each dense row stand behind those of the block before.
Result<void> check_dense_ranks(const SegmentView& view) {
    std::uint64_t ranks = 0;
    const auto blocks = std::size_t(view.counts.blocks());
    const auto rows = view.rows[std::size_t(view.tiers.top())];
    for (std::size_t list = 0; list < view.dense_keys.size(); ++list) {
        for (std::size_t block = 0; block < blocks; ++block) {
            const std::size_t place = list * blocks + block;
            if (view.dense_rank_begin[place] != ranks)
                return corrupt(at("ranks of block", place, view.dense_rank_begin[place]));
            const auto bits = rows.subspan(
                list * view.counts.row_words() + block * kBlockWords, kBlockWords);
            for (const std::uint64_t word : bits)
                ranks += std::uint64_t(std::popcount(word));
        }
    }
    if (ranks != view.dense_ranks.size()) return corrupt(at("end of ranks", 0, ranks));
    return {};
}

}  // namespace

int Tiers::holding(int wanted_m) const {
    int tier = 0;
    while (m[tier] < wanted_m) ++tier;
    assert(tier < count);
    return tier;
}

Tiers tiers_of(int index_m) {
    assert(index_m >= 1 && index_m <= kMaxCoefficients);
    Tiers tiers;
    for (const int m : {20, 40}) {
        if (m < index_m) tiers.m[tiers.count++] = m;
    }
    tiers.m[tiers.count++] = index_m;
    return tiers;
}

SegmentBytes segment_bytes(const SegmentCounts& counts) {
    SegmentBytes sizes;
    carve_all<false>(counts, nullptr, sizes);
    return sizes;
}

SegmentUnderConstruction spans_of(const SegmentCounts& counts,
                                  std::span<std::byte> bytes) {
    SegmentBytes sizes;
    auto spans = carve_all<true>(counts, bytes.data(), sizes);
    assert(sizes.total == bytes.size());
    return spans;
}

SegmentView spans_of(const SegmentCounts& counts, std::span<const std::byte> bytes) {
    SegmentBytes sizes;
    auto spans = carve_all<false>(counts, bytes.data(), sizes);
    assert(sizes.total == bytes.size());
    return spans;
}

Result<SegmentView> view_segment(const SegmentCounts& counts,
                                 std::span<const std::byte> bytes) {
    if (!counts_are_possible(counts)) return corrupt("its counts are impossible");
    if (segment_bytes(counts).total != bytes.size())
        return corrupt(at("size", 0, bytes.size()));
    const SegmentView view = spans_of(counts, bytes);
    for (const auto check : {check_ids, check_directory, check_own, check_dense_ranks}) {
        if (Result<void> sound = check(view); !sound) return std::move(sound).error();
    }
    return view;
}

}  // namespace haarmony::image
