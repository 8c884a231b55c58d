// view_segment(): what bytes of elsewhere have to be before anyone searches or merges them,
// beside what segment_bounds.cc looks at.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <utility>
#include <vector>

#include "engine/image/segment_damage.h"
#include "engine/image/segment_layout.h"

namespace haarmony::image {
namespace {

// The bounds of a block are those of its pictures, neither wider nor narrower.
Result<void> check_averages(const SegmentView& view) {
    for (std::size_t c = 0; c < kChannels; ++c) {
        for (std::size_t block = 0; block < view.lowest[c].size(); ++block) {
            const auto behind = view.terms.subspan(block * kBlockSlots);
            const auto terms =
                behind.first(std::min<std::size_t>(behind.size(), kBlockSlots));
            const auto [lowest, highest] =
                std::ranges::minmax(terms, {}, [&](const PictureTerms& picture) {
                    return picture.average[c];
                });
            if (view.lowest[c][block] != lowest.average[c])
                return corrupt(
                    at("lowest average of block", block, view.lowest[c][block]));
            if (view.highest[c][block] != highest.average[c])
                return corrupt(
                    at("highest average of block", block, view.highest[c][block]));
        }
    }
    return {};
}

// Ids are positive and rise along slots_by_id; so each slot stands there once.
Result<void> check_ids(const SegmentView& view) {
    std::int64_t last = 0;
    std::size_t place = 0;
    for (const std::uint32_t slot : view.slots_by_id) {
        if (view.ids[slot] <= last)
            return corrupt(at("id in order", place, view.ids[slot]));
        last = view.ids[slot];
        ++place;
    }
    return {};
}

// Keys and dense lists belong to each other one by one.
Result<void> check_directory(const SegmentView& view) {
    for (std::size_t key = 0; key < view.directory.size(); ++key) {
        const DirectoryEntry entry(view.directory[key]);
        if (key % kCoefficientCount == 0 && entry.bits() != 0)
            return corrupt(at("directory entry", key, entry.bits()));
        const int list = entry.dense();
        if (list != DirectoryEntry::kNone && view.dense_keys[std::size_t(list)] != key)
            return corrupt(
                at("key of list", std::size_t(list), view.dense_keys[std::size_t(list)]));
    }
    for (std::size_t list = 0; list < view.dense_keys.size(); ++list) {
        const std::uint32_t key = view.dense_keys[list];
        if (key >= kKeyCount || DirectoryEntry(view.directory[key]).dense() != int(list))
            return corrupt(at("key of list", list, key));
    }
    return {};
}

// Whether no bit of the row is set from `bits` on.
bool ends_at(std::span<const std::uint64_t> row, std::size_t bits) {
    const std::size_t word = bits / 64;
    if (bits % 64 != 0 && row[word] >> (bits % 64) != 0) return false;
    const auto behind = row.subspan((bits + 63) / 64);
    return std::ranges::all_of(behind, [](std::uint64_t bit) { return bit == 0; });
}

// Where no picture is, no bit is; and a block is present in a row where it has a bit there.
Result<void> check_rows(const SegmentView& view) {
    const SegmentCounts& counts = view.counts;
    const auto blocks = std::size_t(counts.blocks());
    std::vector<std::uint64_t> presence(counts.presence_words());
    for (int t = 0; t < view.tiers.count; ++t) {
        for (std::size_t list = 0; list < counts.dense[t]; ++list) {
            const auto row =
                view.rows[t].subspan(list * counts.row_words(), counts.row_words());
            if (!ends_at(row, counts.slots))
                return corrupt(at("bits of list", list, "set behind the last slot"));
            std::ranges::fill(presence, 0);
            for (std::size_t block = 0; block < blocks; ++block) {
                const auto bits = row.subspan(block * kBlockWords, kBlockWords);
                if (std::ranges::any_of(bits,
                                        [](std::uint64_t word) { return word != 0; }))
                    presence[block / 64] |= std::uint64_t{1} << (block % 64);
            }
            if (!std::ranges::equal(
                    presence,
                    view.presence[t].subspan(list * presence.size(), presence.size())))
                return corrupt(at("presence of list", list, "not that of its bits"));
        }
    }
    const std::size_t groups = (counts.slots + kCoarseSlots - 1) / kCoarseSlots;
    for (std::size_t row = 0; row < counts.coarse; ++row) {
        if (!ends_at(view.coarse_rows.subspan(row * counts.coarse_row_words(),
                                              counts.coarse_row_words()),
                     groups))
            return corrupt(at("bits of coarse row", row, "set behind the last slot"));
    }
    return {};
}

// The ranks of each block of each dense row stand behind those of the block before.
Result<void> check_dense_rank_begin(const SegmentView& view) {
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
    if (ranks != view.dense_ranks.size())
        return corrupt(at("end of ranks", 0, std::int64_t(ranks)));
    return {};
}

// Which ranks of a picture's channel were met, each at most once.
class RanksMet {
  public:
    // False where the rank was met before, or cannot be.
    bool add(std::uint8_t rank, std::uint32_t index_m) {
        if (rank >= index_m) return false;
        std::uint64_t& word = words_[rank / 64];
        const std::uint64_t bit = std::uint64_t{1} << (rank % 64);
        const bool first = (word & bit) == 0;
        word |= bit;
        return first;
    }
    // Whether they are 0 .. n - 1 for some n.
    [[nodiscard]] bool complete() const {
        const auto is_prefix = [](std::uint64_t word) {
            return (word & (word + 1)) == 0;
        };
        return is_prefix(words_[0]) && is_prefix(words_[1]) &&
               (words_[1] == 0 || ~words_[0] == 0);
    }

  private:
    std::array<std::uint64_t, (kMaxCoefficients + 63) / 64> words_{};
};
using PictureRanks = std::array<RanksMet, kChannels>;

// Every tier's row of a list has those slots whose ranks belong to the tier.
Result<void> check_dense_ranks(const SegmentView& view, std::span<PictureRanks> met) {
    const SegmentCounts& counts = view.counts;
    const int top = view.tiers.top();
    std::size_t next = 0;
    for (std::size_t list = 0; list < view.dense_keys.size(); ++list) {
        const std::size_t channel = view.dense_keys[list] / (2 * kCoefficientCount);
        for (std::size_t word = 0; word < counts.block_words(); ++word) {
            const std::size_t place = list * counts.row_words() + word;
            std::array<std::uint64_t, kMaxTiers> expected{};
            for (std::uint64_t rest = view.rows[top][place]; rest != 0;
                 rest &= rest - 1) {
                const auto bit = std::size_t(std::countr_zero(rest));
                const std::uint8_t rank = view.dense_ranks[next];
                if (!met[word * 64 + bit][channel].add(rank, counts.index_m))
                    return corrupt(at("dense rank", next, rank));
                for (int t = 0; t < top; ++t) {
                    if (rank < view.tiers.m[t]) expected[t] |= std::uint64_t{1} << bit;
                }
                ++next;
            }
            for (int t = 0; t < top; ++t) {
                if (list < counts.dense[t] && view.rows[t][place] != expected[t])
                    return corrupt(at("bits of list", list, "not those of its ranks"));
            }
        }
    }
    return {};
}

// A picture's own coefficients stand in order of rank, those of each tier first.
Result<void> check_own_ranks(const SegmentView& view, std::span<PictureRanks> met) {
    // The slot in which a key was met last.
    std::vector<std::uint32_t> last(kKeyCount, view.counts.slots);
    std::size_t i = 0;
    for (std::uint32_t slot = 0; slot < view.counts.slots; ++slot) {
        for (int c = 0; c < kChannels; ++c) {
            const auto& ends = view.own_counts[slot][c];
            const std::size_t begin = i;
            int least = 0;
            for (int t = 0; t < view.tiers.count; ++t) {
                for (; i < begin + ends[t]; ++i) {
                    const std::uint32_t key = coefficient_key(c, view.own[i]);
                    const DirectoryEntry entry(view.directory[key]);
                    if (entry.bits() == 0 || std::exchange(last[key], slot) == slot)
                        return corrupt(at("coefficient", i, view.own[i]));
                    const std::uint8_t rank = view.own_ranks[i];
                    // Those of a list that is dense above were met among its ranks.
                    const bool met_before = entry.dense() != DirectoryEntry::kNone;
                    if (rank < least || rank >= view.tiers.m[t] ||
                        !(met_before || met[slot][c].add(rank, view.counts.index_m)))
                        return corrupt(at("own rank", i, rank));
                    least = rank + 1;
                }
                least = std::max(least, view.tiers.m[t]);
            }
        }
    }
    return {};
}

Result<void> check_ranks(const SegmentView& view) {
    std::vector<PictureRanks> met(view.counts.slots);
    if (Result<void> sound = check_dense_ranks(view, met); !sound) return sound;
    if (Result<void> sound = check_own_ranks(view, met); !sound) return sound;
    for (std::size_t slot = 0; slot < met.size(); ++slot) {
        if (!std::ranges::all_of(met[slot], &RanksMet::complete))
            return corrupt(at("ranks of slot", slot, "not complete"));
    }
    return {};
}

}  // namespace

Result<SegmentView> view_segment(const SegmentCounts& counts,
                                 std::span<const std::byte> bytes) {
    const Result<SegmentView> within = view_known_segment(counts, bytes);
    if (!within) return within.error();
    const SegmentView& view = within.value();
    for (const auto check : {check_averages,
                             check_ids,
                             check_directory,
                             check_rows,
                             check_dense_rank_begin,
                             check_ranks}) {
        if (Result<void> sound = check(view); !sound) return std::move(sound).error();
    }
    return view;
}

}  // namespace haarmony::image
