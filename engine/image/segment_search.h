// The search of one segment, block by block, exactly and without looking at what cannot be
// among the best.
//   segment_layout.h, bit_sums.h, best_kept.h -> [segment_search.h] -> collection.h
//
// The weights that a picture can match are bounded from above: for a whole block by which of
// the lists any picture of the block is in (at once), or by the largest sum that any picture
// reaches with weights rounded up (refine()). Blocks are visited from the best bound on, and
// only a picture whose bound reaches the worst match kept so far is compared exactly; so the
// result does not depend on the bounds.
//
// Scale    as Score in query.h.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Threads  a prepared search is const-thread-safe; a Visitor belongs to one thread.
// Source   sec. 4.3.1, 4.3.2; Figure 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/best_kept.h"
#include "engine/image/bit_sums.h"
#include "engine/image/query.h"
#include "engine/image/rounding.h"
#include "engine/image/segment_layout.h"
#include "engine/image/term_weights.h"

namespace haarmony::image {

class SegmentSearch {
  public:
    // The view, the query and `allowed` outlive this. `allowed` has a bit for each slot that
    // may be found, in whole blocks; empty: all slots. `rounding` is the query's.
    // Requires: 1 <= query.m <= index_m.
    SegmentSearch(const SegmentView& view,
                  const Query& query,
                  const Rounding& rounding,
                  std::span<const std::uint64_t> allowed);

    [[nodiscard]] int blocks() const { return view_->counts.blocks(); }
    // No picture of the block has a smaller score.
    [[nodiscard]] Score bound(int block) const { return bounds_[std::size_t(block)]; }
    // Appends the exact scores of all allowed pictures, in the order of slots.
    void score_all(std::vector<Match>& out) const;

  private:
    friend class Visitor;

    // Rows of bits that are added up together, and what a bit of each is worth at most.
    struct Rows {
        std::vector<const std::uint64_t*> words;
        std::vector<std::uint32_t> units;
        BitSumPlan plan;
        std::uint32_t most = 0;  // units of all of them

        void add(const std::uint64_t* row, std::uint32_t its_units);
    };
    // A list whose bits are those of the query's tier.
    struct DenseTerm {
        const std::uint64_t* words = nullptr;
        std::int32_t weight = 0;
        std::uint32_t list = 0;
    };

    void find_rows();
    void bound_blocks();
    [[nodiscard]] BlockBits allowed_in(int block) const;
    // Of the average colour and the shape: what the score has beside the matches.
    [[nodiscard]] Score terms_of_averages(std::size_t slot) const;
    [[nodiscard]] Score lowest_terms_of_averages(std::size_t block) const;
    // The weights that the picture in the slot matches, exactly.
    [[nodiscard]] std::int64_t matches(std::size_t slot) const;
    [[nodiscard]] std::int64_t dense_matches(std::size_t slot) const;
    [[nodiscard]] std::int64_t own_matches(std::size_t slot) const;

    const SegmentView* view_;
    const Query* query_;
    const Rounding* rounding_;
    std::span<const std::uint64_t> allowed_;
    int tier_ = 0;
    bool exact_ = false;  // the tier's lists are those of query.m; else ranks decide

    Rows fine_;                                   // one bit for each slot
    Rows coarse_;                                 // one bit for kCoarseSlots slots
    std::vector<const std::uint64_t*> presence_;  // of the fine rows
    std::vector<DenseTerm> dense_;
    TermWeights own_;            // what the pictures themselves are asked for
    std::vector<Score> bounds_;  // [block]
};

// Neighbouring blocks.
struct Blocks {
    int first = 0;
    int count = 0;
};

// Visits blocks of one segment and offers what it finds. What memory has to fetch for a
// picture is asked for one visit before it is read.
class Visitor {
  public:
    // All outlive the visitor.
    Visitor(const SegmentSearch& search, BestKept& best);

    // Adds up the rows of neighbouring blocks, which all begin at `due`: whether the
    // pictures of each are to be looked at. Together they cost much less than one by one.
    // `ahead`: what is visited next, if anything.
    // Requires: 1 <= due.size() <= kBlocksAtOnce; all in one group of that many.
    void visit(int first, std::span<const bool> due, const Blocks& ahead);

    // Compares what the visits so far have left.
    void finish();

    [[nodiscard]] const SearchEffort& effort() const { return effort_; }

  private:
    // A picture on its way: first its matches alone are bounded, then its whole score.
    struct Reached {
        std::uint32_t slot = 0;
        std::uint32_t units = 0;
    };
    struct Candidate {
        Score bound = 0;
        Score averages = 0;
        std::size_t slot = 0;
    };

    [[nodiscard]] std::uint32_t units_needed(int block) const;
    void begin_with_coarse(const Blocks& now, const Blocks& ahead);
    void reach(int first, int block);
    void judge_reached();
    void compare_candidates();
    void compare(const Candidate& candidate);

    const SegmentSearch& search_;
    BestKept& best_;
    SearchEffort effort_;
    BitSums sums_;
    BitSums coarse_sums_;
    std::vector<Reached> reached_;
    std::vector<Candidate> candidates_;
};

}  // namespace haarmony::image
