#include "engine/image/segment_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>
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
SegmentSpans<kMutable> carve_all(
    const SegmentCounts& counts,
    typename Carver<kMutable>::Byte* bytes,
    SegmentBytes& sizes) {
    SegmentSpans<kMutable> spans;
    spans.counts = counts;
    spans.tiers = tiers_of(static_cast<int>(counts.index_m));
    Carver<kMutable> carver(bytes);
    const auto slots = std::size_t{counts.slots};
    const auto blocks = static_cast<std::size_t>(counts.blocks());
    const auto groups = static_cast<std::size_t>(counts.groups());
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
    carver.carve(spans.coarse_row, std::size_t{counts.warm} + counts.rare);
    carver.carve(spans.warm_begin, counts.warm * (groups + 1));
    carver.carve(spans.warm_runs, counts.warm * (blocks + 1));
    carver.carve(spans.warm_slots, counts.warm_postings);
    carver.carve(spans.rare_begin, std::size_t{counts.rare} + 1);
    carver.carve(spans.rare_postings, counts.rare_postings * RarePosting::kBytes);
    sizes.without_ranks = carver.used();
    carver.carve(spans.dense_keys, dense);
    carver.carve(spans.sparse_keys, std::size_t{counts.warm} + counts.rare);
    carver.carve(spans.dense_rank_begin, dense * blocks);
    carver.carve(spans.dense_ranks, counts.dense_postings);
    carver.carve(spans.warm_ranks, counts.warm_postings);
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
        if (counts.dense[t] > kMaxDenseLists) return false;
        if (t > 0 && t < tiers.count && counts.dense[t] < counts.dense[t - 1])
            return false;
    }
    const std::uint64_t postings =
        std::uint64_t{counts.slots} * kChannels * counts.index_m;
    return std::uint64_t{counts.warm} + counts.rare <= kKeyCount &&
           counts.coarse <= counts.warm + counts.rare &&
           counts.dense_postings <= postings && counts.rare_postings <= postings &&
           // A dense list may be a warm one too, in the tiers below.
           counts.warm_postings <= 2 * postings;
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
    const auto sparse = int(view.counts.warm + view.counts.rare);
    std::size_t key = 0;
    for (const std::uint32_t bits : view.directory) {
        const DirectoryEntry entry(bits);
        if (entry.dense() >= dense || entry.sparse() >= sparse)
            return corrupt(at("directory entry", key, bits));
        ++key;
    }
    for (std::size_t list = 0; list < view.coarse_row.size(); ++list) {
        if (view.coarse_row[list] >= view.counts.coarse)
            return corrupt(at("coarse row of list", list, view.coarse_row[list]));
    }
    for (const auto& keys : {view.dense_keys, view.sparse_keys}) {
        const auto* const found =
            std::ranges::find_if(keys.data(), keys.data() + keys.size(), [](auto k) {
                return k >= kKeyCount || k % kCoefficientCount == 0;
            });
        if (found != keys.data() + keys.size())
            return corrupt(at("key of list", std::size_t(found - keys.data()), *found));
    }
    return {};
}

// Where each run begins, in the order of lists and blocks; the last ends with the slots.
Result<void> check_warm(const SegmentView& view) {
    const auto blocks = static_cast<std::size_t>(view.counts.blocks());
    const auto groups = static_cast<std::size_t>(view.counts.groups());
    std::uint64_t last = 0;
    for (std::size_t list = 0; list < view.counts.warm; ++list) {
        const auto begin = view.warm_begin.subspan(list * (groups + 1), groups + 1);
        const auto runs = view.warm_runs.subspan(list * (blocks + 1), blocks + 1);
        WarmRun before(0);
        for (std::size_t block = 0; block <= blocks; ++block) {
            const WarmRun run(runs[block]);
            const std::uint64_t start =
                std::uint64_t{begin[block / kGroupBlocks]} + run.begin();
            const bool ends_well =
                block == 0 ? start == last
                           : start >= last + std::max(before.in_tier(0),
                                                      before.in_tier(1)) &&
                                 start <= last + kBlockSlots;
            if (!ends_well || start > view.warm_slots.size())
                return corrupt(at("warm run", list * (blocks + 1) + block, start));
            last = start;
            before = run;
        }
    }
    if (last != view.warm_slots.size()) return corrupt(at("end of warm runs", 0, last));
    return {};
}

Result<void> check_rare(const SegmentView& view) {
    if (view.rare_begin.front() != 0 || view.rare_begin.back() != view.counts.rare_postings)
        return corrupt(at("end of rare lists", view.counts.rare, view.rare_begin.back()));
    for (std::size_t list = 0; list < view.counts.rare; ++list) {
        const std::uint32_t end = view.rare_begin[list + 1];
        if (end < view.rare_begin[list] || end > view.counts.rare_postings)
            return corrupt(at("end of rare list", list, end));
        int last = -1;
        for (std::uint32_t i = view.rare_begin[list]; i < end; ++i) {
            const RarePosting posting =
                read_rare(view.rare_postings.data() + i * RarePosting::kBytes);
            if (posting.slot <= last || posting.slot >= int(view.counts.slots))
                return corrupt(at("rare posting", i, std::uint64_t(posting.slot)));
            last = posting.slot;
        }
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
            const auto bits =
                rows.subspan(list * view.counts.row_words() + block * kBlockWords,
                             kBlockWords);
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
    for (const auto check :
         {check_ids, check_directory, check_warm, check_rare, check_dense_ranks}) {
        if (Result<void> sound = check(view); !sound) return std::move(sound).error();
    }
    return view;
}

}  // namespace haarmony::image
