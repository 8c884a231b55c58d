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

// Sums of rounded weights stay between these: fine enough that few pictures pass by
// rounding, coarse enough that weights have few one-bits.
constexpr std::int64_t kMostSteps = 1024;
constexpr std::int64_t kFewestSteps = 200;
constexpr std::int64_t kUnitsTried = 16;
// What a share lost by rounding costs in pictures compared, in shares of the summing.
constexpr double kCostOfRounding = 40.0;

constexpr std::size_t kWordsPerLine = 8;
// In units; no sum of units comes near it.
constexpr std::uint32_t kOutOfReach = std::uint32_t{1} << 31;

std::int64_t ceil_divide(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

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

// Calls visit(slot within the block) for each bit.
template <typename Visit>
void for_each_bit(const BlockBits& bits, const Visit& visit) {
    for (std::size_t word = 0; word < bits.size(); ++word) {
        for (std::uint64_t rest = bits[word]; rest != 0; rest &= rest - 1)
            visit(static_cast<std::uint32_t>(word * 64 + std::countr_zero(rest)));
    }
}

bool is_empty(const BlockBits& bits) {
    std::uint64_t any = 0;
    for (const std::uint64_t word : bits) any |= word;
    return any == 0;
}

bool test(const std::uint64_t* row, std::size_t slot) {
    return (row[slot / 64] >> (slot % 64) & 1U) != 0;
}

}  // namespace

SegmentSearch::SegmentSearch(const SegmentView& view,
                             const Query& query,
                             std::span<const std::uint64_t> allowed)
    : view_(&view),
      query_(&query),
      allowed_(allowed),
      tier_(view.tiers.holding(query.m)),
      exact_(view.tiers.m[tier_] == query.m) {
    assert(query.m >= 1 && query.m <= int(view.counts.index_m));
    assert(allowed.empty() || allowed.size() == view.counts.block_words());
    find_rows();
    plan_sums();
    bound_blocks();
}

std::vector<std::uint32_t> SegmentSearch::Rows::in_units(std::int64_t unit) const {
    std::vector<std::uint32_t> units;
    units.reserve(rows.size());
    for (const Row& row : rows)
        units.push_back(static_cast<std::uint32_t>(ceil_divide(row.weight, unit)));
    return units;
}

void SegmentSearch::Rows::make_plan(std::int64_t unit, std::uint32_t before) {
    const std::vector<std::uint32_t> units = in_units(unit);
    most = std::accumulate(units.begin(), units.end(), 0U);
    plan = BitSumPlan(units, before);
    for (const Row& row : rows) words.push_back(row.words);
}

void SegmentSearch::OwnTerms::add(std::uint32_t key, std::int32_t weight) {
    std::size_t at = place(key);
    while (keys_[at] != kFree && keys_[at] != key) at = (at + 1) % kSize;
    keys_[at] = key;
    weights_[at] += weight;
}

void SegmentSearch::find_rows() {
    const SegmentCounts& counts = view_->counts;
    for (const QueryTerm& term : query_->terms) {
        if (term.weight == 0) continue;
        const DirectoryEntry entry(view_->directory[term.key]);
        Row row;
        row.weight = term.weight;
        if (entry.dense() != DirectoryEntry::kNone) {
            int tier = tier_;
            while (entry.dense() >= int(counts.dense[tier])) ++tier;
            row.list = entry.dense();
            row.hint = tier != tier_;
            const auto list = static_cast<std::size_t>(entry.dense());
            row.words = view_->rows[tier].data() + list * counts.row_words();
            row.presence = view_->presence[tier].data() + list * counts.presence_words();
            fine_.rows.push_back(row);
        } else if (entry.coarse() != DirectoryEntry::kNone) {
            row.hint = true;
            row.words = view_->coarse_rows.data() +
                        std::size_t(entry.coarse()) * counts.coarse_row_words();
            coarse_.rows.push_back(row);
        }
        if (row.hint) own_.add(term.key, term.weight);
    }
}

// The unit that makes summing cheap: few one-bits in all, little lost by rounding up.
void SegmentSearch::choose_unit() {
    std::int64_t sum = 0;
    for (const Rows* rows : {&fine_, &coarse_}) {
        for (const Row& row : rows->rows) sum += row.weight;
    }
    double best_cost = std::numeric_limits<double>::max();
    const std::int64_t finest = std::max<std::int64_t>(1, sum / kMostSteps);
    const std::int64_t coarsest = std::max<std::int64_t>(1, sum / kFewestSteps);
    const std::int64_t step =
        std::max<std::int64_t>(1, (coarsest - finest) / kUnitsTried);
    for (std::int64_t unit = finest; unit <= coarsest; unit += step) {
        std::int64_t ones = 0;
        std::int64_t rounded = 0;
        for (const Rows* rows : {&fine_, &coarse_}) {
            for (const std::uint32_t units : rows->in_units(unit)) {
                ones += std::popcount(units);
                rounded += units * unit;
            }
        }
        const double lost = sum == 0 ? 0.0 : double(rounded - sum) / double(sum);
        const double cost = double(ones) * (1.0 + kCostOfRounding * lost);
        if (cost < best_cost) {
            best_cost = cost;
            unit_ = unit;
        }
    }
}

void SegmentSearch::plan_sums() {
    choose_unit();
    coarse_.make_plan(unit_, 0);
    fine_.make_plan(unit_, coarse_.most);
}

// The rows of presence have a bit for each block: blocks are added up as pictures are.
void SegmentSearch::bound_blocks() {
    bounds_.resize(std::size_t(blocks()));
    std::vector<const std::uint64_t*> presence;
    presence.reserve(fine_.rows.size());
    for (const Row& row : fine_.rows) presence.push_back(row.presence);
    BitSums sums;
    UnpackedSums unpacked;
    for (std::size_t first = 0; first < bounds_.size(); first += kBlockSlots) {
        add_rows(fine_.plan, presence, first / 64, 1, 0, sums);
        unpack(sums, fine_.plan.planes(), 0, unpacked);
        const std::size_t count =
            std::min(bounds_.size() - first, std::size_t{kBlockSlots});
        for (std::size_t i = 0; i < count; ++i) {
            bounds_[first + i] =
                lowest_terms_of_averages(first + i) -
                (std::int64_t{unpacked[i]} + coarse_.most) * unit_ * kAverageOne;
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

void SegmentSearch::prefetch(int first, int count) const {
    const std::size_t begin = std::size_t(first) * kBlockWords;
    const std::size_t end = begin + std::size_t(count) * kBlockWords;
    for (const std::uint64_t* row : fine_.words) {
        for (std::size_t word = begin; word < end; word += kWordsPerLine)
            hwy::Prefetch(row + word);
    }
}

std::int64_t SegmentSearch::matches(std::size_t slot) const {
    return dense_matches(slot) + own_matches(slot);
}

std::int64_t SegmentSearch::dense_matches(std::size_t slot) const {
    std::int64_t matched = 0;
    for (const Row& row : fine_.rows) {
        if (row.hint || !test(row.words, slot)) continue;
        if (!exact_) {
            const std::size_t place =
                dense_rank_place(*view_, std::size_t(row.list), slot);
            if (view_->dense_ranks[place] >= query_->m) continue;
        }
        matched += row.weight;
    }
    return matched;
}

std::int64_t SegmentSearch::own_matches(std::size_t slot) const {
    std::int64_t matched = 0;
    std::size_t begin = view_->own_begin[slot];
    for (int c = 0; c < kChannels; ++c) {
        const auto& counts = view_->own_counts[slot][c];
        const std::size_t end = begin + counts[tier_];
        for (std::size_t i = begin; i < end; ++i) {
            if (!exact_ && view_->own_ranks[i] >= query_->m) break;
            matched += own_.weight(coefficient_key(c, view_->own[i]));
        }
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

Visitor::Visitor(const SegmentSearch& search, TopK& top, WorstKept& worst)
    : search_(search), top_(top), worst_(worst) {}

// The smallest matched weight with which a picture of those terms is not worse than what is
// kept; ties are not worse.
std::int64_t Visitor::matches_needed(Score averages) const {
    const Score worst = worst_.get();
    if (worst == WorstKept::kAny) return 0;
    // Rounded up: the shift of a negative number rounds down.
    return (averages - worst + kAverageOne - 1) >> kAverageFractionBits;
}

// In units; what no sum of units below it can do.
std::uint32_t Visitor::units_needed(int block) const {
    const std::int64_t needed =
        matches_needed(search_.lowest_terms_of_averages(std::size_t(block)));
    if (needed <= 0) return 0;
    return static_cast<std::uint32_t>(
        std::min<std::int64_t>(ceil_divide(needed, search_.unit_), kOutOfReach));
}

void Visitor::visit(int first, std::span<const bool> due) {
    const int count = static_cast<int>(due.size());
    assert(count >= 1 && first / kBlocksAtOnce == (first + count - 1) / kBlocksAtOnce);
    begin_with_coarse(first, count);
    add_rows(search_.fine_.plan,
             search_.fine_.words,
             std::size_t(first) * kBlockWords,
             count,
             search_.coarse_.plan.planes(),
             sums_);
    effort_.rows += std::int64_t(due.size() * search_.fine_.rows.size());
    for (int i = 0; i < count; ++i) {
        if (!due[std::size_t(i)]) continue;
        ++effort_.blocks_visited;
        BlockBits reached =
            at_least(sums_, search_.fine_.plan.planes(), i, units_needed(first + i));
        const BlockBits allowed = search_.allowed_in(first + i);
        for (int word = 0; word < kBlockWords; ++word) reached[word] &= allowed[word];
        if (!is_empty(reached)) compare_all(first, first + i, reached);
    }
}

// A coarse row has the bits of kCoarseSlots blocks where a fine one has those of one.
void Visitor::begin_with_coarse(int first, int count) {
    const int begin = first / kCoarseSlots;
    const int pieces = (first + count - 1) / kCoarseSlots + 1 - begin;
    const int planes = search_.coarse_.plan.planes();
    add_rows(search_.coarse_.plan,
             search_.coarse_.words,
             std::size_t(begin) * kBlockWords,
             pieces,
             0,
             coarse_sums_);
    effort_.rows += pieces * std::int64_t(search_.coarse_.rows.size());
    for (int i = 0; i < count; ++i) {
        const int block = first + i;
        spread(coarse_sums_,
               planes,
               block / kCoarseSlots - begin,
               block % kCoarseSlots,
               i,
               sums_);
    }
}

// Step by step, so that what one step reads is asked for in the step before.
void Visitor::compare_all(int first, int block, const BlockBits& reached) {
    const SegmentView& view = *search_.view_;
    const std::size_t before = std::size_t(block) * kBlockSlots;
    for_each_bit(reached, [&](std::uint32_t in_block) {
        hwy::Prefetch(&view.terms[before + in_block]);
        hwy::Prefetch(&view.own_begin[before + in_block]);
        hwy::Prefetch(&view.own_counts[before + in_block]);
    });
    candidates_.clear();
    const int in_sums = (block - first) * kBlockSlots;
    for_each_bit(reached, [&](std::uint32_t in_block) {
        const std::size_t slot = before + in_block;
        const Score averages = search_.terms_of_averages(slot);
        const std::int64_t units =
            sums_.at(in_sums + int(in_block), search_.fine_.plan.planes());
        if (units * search_.unit_ < matches_needed(averages)) return;
        candidates_.push_back({slot, averages});
        constexpr std::size_t kPerLine = 32;
        for (std::size_t i = view.own_begin[slot]; i < view.own_begin[slot + 1];
             i += kPerLine)
            hwy::Prefetch(&view.own[i]);
    });
    for (const Candidate& candidate : candidates_)
        compare(candidate.slot, candidate.averages);
}

void Visitor::compare(std::size_t slot, Score averages) {
    ++effort_.compared;
    const Score score = averages - search_.matches(slot) * kAverageOne;
    if (!top_.admits(score)) return;
    top_.offer({ImageId{search_.view_->ids[slot]}, score});
    if (top_.full()) worst_.lower_to(top_.worst());
}

}  // namespace haarmony::image
