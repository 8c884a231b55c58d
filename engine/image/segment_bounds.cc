// view_known_segment(): what keeps a search inside of the bytes, whatever they are. Each check
// here is for one thing that a search, or Segment::find(), uses as a place.
#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string>

#include "engine/image/segment_damage.h"
#include "engine/image/segment_layout.h"

namespace haarmony::image {
namespace {

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

// Bounds whose lower one is the higher bound nothing.
Result<void> check_averages_bound(const SegmentView& view) {
    for (std::size_t c = 0; c < kChannels; ++c) {
        for (std::size_t block = 0; block < view.lowest[c].size(); ++block) {
            if (view.lowest[c][block] > view.highest[c][block])
                return corrupt(
                    at("lowest average of block", block, view.lowest[c][block]));
        }
    }
    return {};
}

Result<void> check_slots(const SegmentView& view) {
    if (std::ranges::max(view.slots_by_id) < view.counts.slots) return {};
    const auto outside = std::ranges::find_if(
        view.slots_by_id, [&](std::uint32_t slot) { return slot >= view.counts.slots; });
    return corrupt(
        at("slot by id", std::size_t(outside - view.slots_by_id.begin()), *outside));
}

Result<void> check_directory_entries(const SegmentView& view) {
    const auto dense = int(view.counts.dense[std::size_t(view.tiers.top())]);
    const auto coarse = int(view.counts.coarse);
    for (std::size_t key = 0; key < view.directory.size(); ++key) {
        const DirectoryEntry entry(view.directory[key]);
        if (entry.dense() >= dense || entry.coarse() >= coarse)
            return corrupt(at("directory entry", key, entry.bits()));
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
    return {};
}

// Without a way out of the loop, so that it runs as fast as memory does.
bool are_coefficients(std::span<const std::int16_t> own) {
    std::uint16_t farthest = 0;
    for (const std::int16_t index : own) {
        // In 16 bits alone: eight at a time.
        const auto bits = static_cast<std::uint16_t>(index);
        const auto sign = static_cast<std::uint16_t>(index >> 15);
        const auto magnitude = static_cast<std::uint16_t>((bits ^ sign) - sign);
        farthest = std::max(farthest, static_cast<std::uint16_t>(magnitude - 1));
    }
    // That of 0 is the largest of all.
    return own.empty() || farthest < kCoefficientCount - 1;
}

Result<void> check_coefficients(const SegmentView& view) {
    if (are_coefficients(view.own)) return {};
    const auto wrong = std::ranges::find_if(view.own, [](std::int16_t index) {
        return !are_coefficients({&index, 1});
    });
    return corrupt(at("coefficient", std::size_t(wrong - view.own.begin()), *wrong));
}

// A rank of a block stands at most kBlockSlots - 1 behind the block's first. Only where that
// could be behind the last rank of all, bits are counted.
Result<void> check_dense_ranks_reach(const SegmentView& view) {
    const auto blocks = std::size_t(view.counts.blocks());
    const auto top = std::size_t(view.tiers.top());
    const std::uint64_t ranks = view.dense_ranks.size();
    const auto ends_in_time = [&](std::uint32_t begin) {
        return std::uint64_t{begin} + kBlockSlots <= ranks;
    };
    for (std::size_t list = 0; list < view.counts.dense[top]; ++list) {
        const auto begins = view.dense_rank_begin.subspan(list * blocks, blocks);
        if (ends_in_time(std::ranges::max(begins))) continue;
        for (std::size_t block = 0; block < blocks; ++block) {
            if (ends_in_time(begins[block])) continue;
            std::uint64_t end = begins[block];
            for (std::size_t i = 0; i < kBlockWords; ++i) {
                const std::size_t word =
                    list * view.counts.row_words() + block * kBlockWords + i;
                const std::uint64_t bits = view.rows[top][word];
                end += std::uint64_t(std::popcount(bits));
                // A bit of a tier below has its rank among those of the top one.
                for (std::size_t t = 0; t < top; ++t) {
                    if (list < view.counts.dense[t] && (view.rows[t][word] & ~bits) != 0)
                        return corrupt(
                            at("bits of list", list, "not those of its ranks"));
                }
            }
            if (end > ranks)
                return corrupt(
                    at("ranks of block", list * blocks + block, begins[block]));
        }
    }
    return {};
}

}  // namespace

Result<SegmentView> view_known_segment(const SegmentCounts& counts,
                                       std::span<const std::byte> bytes) {
    if (!counts_are_possible(counts)) return corrupt("its counts are impossible");
    if (segment_bytes(counts).total != bytes.size())
        return corrupt("its size is " + std::to_string(bytes.size()));
    const SegmentView view = spans_of(counts, bytes);
    for (const auto check : {check_averages_bound,
                             check_slots,
                             check_directory_entries,
                             check_own,
                             check_coefficients,
                             check_dense_ranks_reach}) {
        if (Result<void> sound = check(view); !sound) return std::move(sound).error();
    }
    return view;
}

}  // namespace haarmony::image
