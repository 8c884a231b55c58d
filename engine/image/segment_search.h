// The search of one segment, block by block, exactly and without looking at what cannot be
// among the best.
//   segment_layout.h, bit_sums.h -> [segment_search.h] -> collection.h
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
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "engine/image/bit_sums.h"
#include "engine/image/query.h"
#include "engine/image/segment_layout.h"
#include "engine/image/top_k.h"

namespace haarmony::image {

// The worst score that is still of interest, shared by all who search for one query.
class WorstKept {
  public:
    static constexpr Score kAny = std::numeric_limits<Score>::max();

    [[nodiscard]] Score get() const { return score_.load(std::memory_order_relaxed); }
    void lower_to(Score score) {
        Score now = get();
        while (score < now &&
               !score_.compare_exchange_weak(now, score, std::memory_order_relaxed)) {
        }
    }

  private:
    std::atomic<Score> score_{kAny};
};

class SegmentSearch {
  public:
    // The view, the query and `allowed` outlive this. `allowed` has a bit for each slot that
    // may be found, in whole blocks; empty: all slots.
    // Requires: 1 <= query.m <= index_m.
    SegmentSearch(const SegmentView& view,
                  const Query& query,
                  std::span<const std::uint64_t> allowed);

    [[nodiscard]] int blocks() const { return view_->counts.blocks(); }
    // No picture of the block has a smaller score.
    [[nodiscard]] Score bound(int block) const { return bounds_[std::size_t(block)]; }
    // Asks the memory for what visiting the blocks reads first.
    void prefetch(int first, int count) const;

    // Appends the exact scores of all allowed pictures, in the order of slots.
    void score_all(std::vector<Match>& out) const;

  private:
    friend class Visitor;

    // A row of bits and what a bit of it is worth.
    struct Row {
        const std::uint64_t* words = nullptr;
        const std::uint64_t* presence = nullptr;  // null: of a coarse row
        std::int32_t weight = 0;
        int list = 0;       // the dense one
        bool hint = false;  // the bit may be of another list or tier: the picture decides
    };
    // What the pictures themselves are asked for: a small hash table.
    class OwnTerms {
      public:
        void add(std::uint32_t key, std::int32_t weight);
        [[nodiscard]] std::int32_t weight(std::uint32_t key) const {
            for (std::size_t at = place(key);; at = (at + 1) % kSize) {
                if (keys_[at] == key) return weights_[at];
                if (keys_[at] == kFree) return 0;
            }
        }

      private:
        static constexpr std::size_t kSize = 1024;  // three times as many as there may be
        static constexpr std::uint32_t kFree = 0;   // no key: the average's place
        static std::size_t place(std::uint32_t key) { return (key * 0x9E3779B1U) >> 22; }
        std::array<std::uint32_t, kSize> keys_{};
        std::array<std::int32_t, kSize> weights_{};
    };
    // Rows that are added up together.
    struct Rows {
        std::vector<Row> rows;
        std::vector<const std::uint64_t*> words;
        BitSumPlan plan;
        std::uint32_t most = 0;  // units of all of them

        [[nodiscard]] std::vector<std::uint32_t> in_units(std::int64_t unit) const;
        // `before`: units that the sums may have already.
        void make_plan(std::int64_t unit, std::uint32_t before);
    };

    void find_rows();
    void choose_unit();
    void plan_sums();
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
    std::span<const std::uint64_t> allowed_;
    int tier_ = 0;
    bool exact_ = false;  // the tier's lists are those of query.m; else ranks decide

    Rows fine_;    // one bit for each slot
    Rows coarse_;  // one bit for kCoarseSlots slots
    OwnTerms own_;
    // Weights are added up in units, rounded up.
    std::int64_t unit_ = 1;
    std::vector<Score> bounds_;  // [block]
};

// Visits blocks of one segment and offers what it finds.
class Visitor {
  public:
    // All outlive the visitor.
    Visitor(const SegmentSearch& search, TopK& top, WorstKept& worst);

    // Compares the pictures of neighbouring blocks, which all begin at `due`: whether each of
    // them is to be looked at. Together they cost much less than one by one.
    // Requires: 1 <= due.size() <= kBlocksAtOnce; all in one group of that many.
    void visit(int first, std::span<const bool> due);

    [[nodiscard]] const SearchEffort& effort() const { return effort_; }

  private:
    [[nodiscard]] std::int64_t matches_needed(Score averages) const;
    [[nodiscard]] std::uint32_t units_needed(int block) const;
    void begin_with_coarse(int first, int count);
    void compare_all(int first, int block, const BlockBits& reached);
    void compare(std::size_t slot, Score averages);

    const SegmentSearch& search_;
    TopK& top_;
    WorstKept& worst_;
    SearchEffort effort_;
    BitSums sums_;
    BitSums coarse_sums_;
    struct Candidate {
        std::size_t slot = 0;
        Score averages = 0;
    };
    std::vector<Candidate> candidates_;
};

}  // namespace haarmony::image
