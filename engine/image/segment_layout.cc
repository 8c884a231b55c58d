#include "engine/image/segment_layout.h"

#include <cassert>
#include <type_traits>

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

std::span<const std::byte> bytes_of(const SegmentView& view) {
    // The first section begins where the segment does.
    return {reinterpret_cast<const std::byte*>(view.terms.data()),
            segment_bytes(view.counts).total};
}

}  // namespace haarmony::image
