#include "engine/image/segment_search.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>

namespace haarmony::image {
namespace {

// The slots of a block that exist.
BlockBits existing(int slots, int block) {
    BlockBits bits;
    const int here = slots - block * kBlockSlots;
    for (int word = 0; word < kBlockWords; ++word) {
        const int in_word = std::clamp(here - word * 64, 0, 64);
        bits[word] =
            in_word == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << in_word) - 1;
    }
    return bits;
}

std::size_t count_bits(const BlockBits& bits) {
    std::size_t count = 0;
    for (const std::uint64_t word : bits) count += std::size_t(std::popcount(word));
    return count;
}

// From so many sums of a block on, all are unpacked at once: it takes as long as to read that
// many bit by bit.
constexpr std::size_t kUnpackedFrom = 8;
// Candidates that are compared in the order of their bounds.
constexpr std::size_t kSortedCandidates = 32;

// Calls visit(slot within the block) for each bit.
template <typename Visit>
void for_each_bit(const BlockBits& bits, const Visit& visit) {
    for (std::size_t word = 0; word < bits.size(); ++word) {
        for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1)
            visit(static_cast<std::uint32_t>(word * 64 + std::countr_zero(rest)));
    }
}

}  // namespace

SegmentSearch::SegmentSearch(const SegmentView& view,
                             const Query& query,
                             const Rounding& rounding,
                             std::span<const std::uint64_t> allowed)
    : view_(&view),
      query_(&query),
      rounding_(&rounding),
      allowed_(allowed),
      tier_(view.tiers.holding(query.m)),
      exact_(view.tiers.m[tier_] == query.m) {
    assert(query.m >= 1 && query.m <= int(view.counts.index_m));
    assert(allowed.empty() || allowed.size() == view.counts.block_words());
    find_rows();
    bound_blocks();
}

void SegmentSearch::Rows::add(const std::uint64_t* row, std::uint32_t its_units) {
    words.push_back(row);
    units.push_back(its_units);
    most += its_units;
}

void SegmentSearch::find_rows() {
    const SegmentCounts& counts = view_->counts;
    for (const QueryTerm& term : query_->terms) {
        if (term.weight == 0) continue;
        const std::uint32_t units = rounding_->units(term.weight);
        const DirectoryEntry entry(view_->directory[term.key]);
        if (entry.dense() != DirectoryEntry::kNone) {
            const auto list = static_cast<std::uint32_t>(entry.dense());
            int tier = tier_;
            while (list >= counts.dense[tier]) ++tier;
            const std::uint64_t* const words =
                view_->rows[tier].data() + list * counts.row_words();
            fine_.add(words, units);
            presence_.push_back(view_->presence[tier].data() +
                                list * counts.presence_words());
            hwy::Prefetch(presence_.back());
            // Bits of a tier above are of too many pictures: these know better.
            if (tier == tier_) {
                dense_.push_back({words, term.weight, list});
            } else {
                own_.add(term.key, term.weight);
            }
        } else if (entry.coarse() != DirectoryEntry::kNone) {
            coarse_.add(view_->coarse_rows.data() +
                            std::size_t(entry.coarse()) * counts.coarse_row_words(),
                        units);
            own_.add(term.key, term.weight);
        }
    }
    coarse_.plan = BitSumPlan(coarse_.units, 0);
    fine_.plan = BitSumPlan(fine_.units, coarse_.most);
}

// The rows of presence have a bit for each block: blocks are added up as pictures are.
void SegmentSearch::bound_blocks() {
    bounds_.resize(std::size_t(blocks()));
    BitSums sums;
    UnpackedSums unpacked;
    for (std::size_t first = 0; first < bounds_.size(); first += kBlockSlots) {
        add_rows(fine_.plan, presence_, first / 64, 1, 0, {}, sums);
        unpack(sums, fine_.plan.planes(), 0, unpacked);
        const std::size_t count =
            std::min(bounds_.size() - first, std::size_t{kBlockSlots});
        for (std::size_t i = 0; i < count; ++i) {
            bounds_[first + i] =
                lowest_terms_of_averages(first + i) -
                rounding_->weight(unpacked[i] + coarse_.most) * kAverageOne;
        }
    }
}

Score SegmentSearch::terms_of_averages(std::size_t slot) const {
    const PictureTerms& picture = view_->terms[slot];
    return score(*query_, picture.average, picture.log_aspect, 0);
}

Score SegmentSearch::lowest_terms_of_averages(std::size_t block) const {
    Score lowest = 0;
    for (int c = 0; c < kChannels; ++c) {
        const std::int64_t nearest = std::clamp(
            query_->average[c], view_->lowest[c][block], view_->highest[c][block]);
        lowest += query_->average_weight[c] * std::abs(query_->average[c] - nearest);
    }
    return lowest;
}

BlockBits SegmentSearch::allowed_in(int block) const {
    if (allowed_.empty()) return existing(int(view_->counts.slots), block);
    BlockBits bits;
    std::ranges::copy(allowed_.subspan(std::size_t(block) * kBlockWords, kBlockWords),
                      bits.begin());
    return bits;
}

std::int64_t SegmentSearch::matches(std::size_t slot) const {
    return dense_matches(slot) + own_matches(slot);
}

std::int64_t SegmentSearch::dense_matches(std::size_t slot) const {
    std::int64_t matched = 0;
    for (const DenseTerm& term : dense_) {
        const auto bit =
            static_cast<std::int32_t>(term.words[slot / 64] >> (slot % 64) & 1U);
        if (exact_) {
            matched += term.weight & -bit;
        } else if (bit != 0) {
            const std::size_t place = dense_rank_place(*view_, term.list, slot);
            if (view_->dense_ranks[place] < query_->m) matched += term.weight;
        }
    }
    return matched;
}

std::int64_t SegmentSearch::own_matches(std::size_t slot) const {
    std::int64_t matched = 0;
    std::size_t begin = view_->own_begin[slot];
    for (int c = 0; c < kChannels; ++c) {
        const auto& counts = view_->own_counts[slot][c];
        std::size_t count = counts[tier_];
        if (!exact_) {
            // They are in falling order of magnitude.
            const auto ranks = view_->own_ranks.subspan(begin, count);
            const auto end = std::ranges::lower_bound(ranks, query_->m);
            count = std::size_t(end - ranks.begin());
        }
        matched += own_.sum(c, view_->own.subspan(begin, count));
        begin += counts[std::size_t(view_->tiers.top())];
    }
    return matched;
}

void SegmentSearch::score_all(std::vector<Match>& out) const {
    for (int block = 0; block < blocks(); ++block) {
        for_each_bit(allowed_in(block), [&](std::uint32_t in_block) {
            const std::size_t slot = std::size_t(block) * kBlockSlots + in_block;
            out.push_back({ImageId{view_->ids[slot]},
                           terms_of_averages(slot) - matches(slot) * kAverageOne});
        });
    }
}

Visitor::Visitor(const SegmentSearch& search, BestKept& best)
    : search_(search), best_(best) {}

// The fewest units with which a picture of the block can be not worse than what is kept; ties
// are not worse.
std::uint32_t Visitor::units_needed(int block) const {
    const Score worst = best_.worst();
    if (worst == BestKept::kAny) return 0;
    const Score averages = search_.lowest_terms_of_averages(std::size_t(block));
    // Rounded up: the shift of a negative number rounds down.
    const std::int64_t needed =
        (averages - worst + kAverageOne - 1) >> kAverageFractionBits;
    return search_.rounding_->units_for(needed);
}

void Visitor::visit(int first, std::span<const bool> due, const Blocks& ahead) {
    const int count = static_cast<int>(due.size());
    assert(count >= 1 && first / kBlocksAtOnce == (first + count - 1) / kBlocksAtOnce);
    begin_with_coarse({first, count}, ahead);
    add_rows(search_.fine_.plan,
             search_.fine_.words,
             std::size_t(first) * kBlockWords,
             count,
             search_.coarse_.plan.planes(),
             {std::size_t(ahead.first) * kBlockWords, ahead.count},
             sums_);
    effort_.rows += std::int64_t(due.size() * search_.fine_.words.size());
    compare_candidates();
    judge_reached();
    for (int i = 0; i < count; ++i) {
        if (!due[std::size_t(i)]) continue;
        ++effort_.blocks_visited;
        reach(first, first + i);
    }
}

void Visitor::finish() {
    compare_candidates();
    judge_reached();
    compare_candidates();
}

// A coarse row has the bits of kCoarseSlots blocks where a fine one has those of one.
void Visitor::begin_with_coarse(const Blocks& now, const Blocks& ahead) {
    const auto piece_of = [](int block) { return block / kCoarseSlots; };
    const auto pieces = [&](const Blocks& blocks) {
        return blocks.count == 0 ? 0
                                 : piece_of(blocks.first + blocks.count - 1) + 1 -
                                       piece_of(blocks.first);
    };
    const auto offset = [&](const Blocks& blocks) {
        return std::size_t(piece_of(blocks.first)) * kBlockWords;
    };
    const int planes = search_.coarse_.plan.planes();
    add_rows(search_.coarse_.plan,
             search_.coarse_.words,
             offset(now),
             pieces(now),
             0,
             {offset(ahead), pieces(ahead)},
             coarse_sums_);
    effort_.rows += pieces(now) * std::int64_t(search_.coarse_.words.size());
    for (int i = 0; i < now.count; ++i) {
        const int block = now.first + i;
        spread(coarse_sums_,
               planes,
               piece_of(block) - piece_of(now.first),
               block % kCoarseSlots,
               i,
               sums_);
    }
}

// The pictures of a block whose matches may be enough.
void Visitor::reach(int first, int block) {
    const int planes = search_.fine_.plan.planes();
    BlockBits bits = at_least(sums_, planes, block - first, units_needed(block));
    const BlockBits allowed = search_.allowed_in(block);
    for (int word = 0; word < kBlockWords; ++word) bits[word] &= allowed[word];
    const SegmentView& view = *search_.view_;
    const auto reach_with = [&](const auto& units_of) {
        for_each_bit(bits, [&](std::uint32_t in_block) {
            const auto slot = static_cast<std::uint32_t>(block) * kBlockSlots + in_block;
            hwy::Prefetch(&view.terms[slot]);
            hwy::Prefetch(&view.own_begin[slot]);
            hwy::Prefetch(&view.own_counts[slot]);
            reached_.push_back({slot, units_of(in_block)});
        });
    };
    const std::size_t count = count_bits(bits);
    if (count >= kUnpackedFrom) {
        UnpackedSums units;
        unpack(sums_, planes, block - first, units);
        reach_with(
            [&](std::uint32_t in_block) -> std::uint32_t { return units[in_block]; });
    } else if (count != 0) {
        reach_with([&](std::uint32_t in_block) {
            return sums_.at((block - first) * kBlockSlots + int(in_block), planes);
        });
    }
}

// Of these, the pictures that may be among the best if one knows their averages.
void Visitor::judge_reached() {
    const SegmentView& view = *search_.view_;
    for (const Reached& reached : reached_) {
        const Score averages = search_.terms_of_averages(reached.slot);
        const Score bound =
            averages - search_.rounding_->weight(reached.units) * kAverageOne;
        if (bound > best_.worst()) continue;
        candidates_.push_back({bound, averages, reached.slot});
        constexpr std::size_t kPerLine = 32;
        const std::size_t end = view.own_begin[reached.slot + 1];
        for (std::size_t i = view.own_begin[reached.slot]; i < end; i += kPerLine)
            hwy::Prefetch(&view.own[i]);
    }
    reached_.clear();
}

// The most promising first, so that the others need not be looked at. Where there are many,
// it does not matter in which order the rest is.
void Visitor::compare_candidates() {
    const auto sorted_end =
        candidates_.begin() +
        std::ptrdiff_t(std::min(candidates_.size(), kSortedCandidates));
    if (sorted_end != candidates_.end())
        std::ranges::nth_element(candidates_, sorted_end, {}, &Candidate::bound);
    std::ranges::sort(candidates_.begin(), sorted_end, {}, &Candidate::bound);
    for (const Candidate& candidate : candidates_) {
        if (candidate.bound <= best_.worst()) compare(candidate);
    }
    candidates_.clear();
}

void Visitor::compare(const Candidate& candidate) {
    ++effort_.compared;
    const Score score =
        candidate.averages - search_.matches(candidate.slot) * kAverageOne;
    if (score <= best_.worst())
        best_.offer({ImageId{search_.view_->ids[candidate.slot]}, score});
}

}  // namespace haarmony::image
