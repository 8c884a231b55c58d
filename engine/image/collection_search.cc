#include "engine/image/collection_search.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/image/segment_search.h"

namespace haarmony::image {
namespace {

// Blocks that are visited before all others.
constexpr std::size_t kFirstBlocks = 16;

// A slot for each picture that a search may find, in whole blocks; empty for all slots.
std::vector<std::uint64_t> allowed_slots(const LiveSegment& part, const IdSet* only) {
    std::vector<std::uint64_t> allowed;
    if (part.removed == nullptr && only == nullptr) return allowed;
    const Segment& segment = *part.segment;
    allowed.resize(segment.view().counts.block_words());
    const auto set = [&](int slot) {
        allowed[std::size_t(slot) / 64] |= std::uint64_t{1} << (slot % 64);
    };
    // Looking an id up costs more than looking at a slot.
    constexpr std::int64_t kLookUp = 16;
    if (only != nullptr && only->size() * kLookUp < segment.size()) {
        only->for_each([&](ImageId id) {
            if (const std::optional<int> slot = segment.find(id)) set(*slot);
        });
    } else {
        for (int slot = 0; slot < segment.size(); ++slot) {
            if (only == nullptr || only->contains(segment.id(slot))) set(slot);
        }
    }
    if (part.removed != nullptr) {
        const auto removed = part.removed->words();
        for (std::size_t word = 0; word < removed.size(); ++word)
            allowed[word] &= ~removed[word];
    }
    return allowed;
}

std::int64_t count_bits(std::span<const std::uint64_t> words) {
    std::int64_t count = 0;
    for (const std::uint64_t word : words) count += std::popcount(word);
    return count;
}

// One segment's part of a search.
class PartSearch {
  public:
    PartSearch(const LiveSegment& part,
               const Query& query,
               const Rounding& rounding,
               const IdSet* only)
        : allowed_(allowed_slots(part, only)),
          live_(allowed_.empty() ? part.segment->size() : count_bits(allowed_)),
          search_(part.segment->view(), query, rounding, allowed_) {
        for (int block = 0; block < search_.blocks(); ++block)
            bounds_.push_back(has_allowed(block) ? search_.bound(block) : kNever);
    }

    static constexpr Score kNever = std::numeric_limits<Score>::max();

    [[nodiscard]] std::int64_t live() const { return live_; }
    // No picture of the block that may be found has a smaller score; kNever where there is
    // none, or once it has been visited.
    [[nodiscard]] std::span<const Score> bounds() const { return bounds_; }

    void visit_first(int block, BestKept& best, SearchEffort& effort) {
        bounds_[std::size_t(block)] = kNever;
        Visitor visitor(search_, best);
        constexpr bool kDue = true;
        visitor.visit(block, {&kDue, 1}, {});
        visitor.finish();
        effort += visitor.effort();
    }

    // All blocks that were not visited first and may hold a match, some neighbours at a time.
    void visit_rest(BestKept& best, bool exhaustive, SearchEffort& effort) {
        Visitor visitor(search_, best);
        Run run = next_run(0, best, exhaustive);
        while (run.blocks.count > 0) {
            const Run ahead =
                next_run(run.blocks.first + run.blocks.count, best, exhaustive);
            visitor.visit(run.blocks.first,
                          std::span(run.due).first(std::size_t(run.blocks.count)),
                          ahead.blocks);
            run = ahead;
        }
        visitor.finish();
        effort += visitor.effort();
        effort.blocks += search_.blocks();
    }

  private:
    [[nodiscard]] bool has_allowed(int block) const {
        if (allowed_.empty()) return true;
        const std::uint64_t* const words =
            allowed_.data() + std::size_t(block) * kBlockWords;
        return (words[0] | words[1] | words[2] | words[3]) != 0;
    }

    // Neighbouring blocks of one group of kBlocksAtOnce, the first and the last of them due.
    struct Run {
        Blocks blocks;
        std::array<bool, kBlocksAtOnce> due{};
    };
    // The next from `block` on; none where its count is 0.
    [[nodiscard]] Run next_run(int block, const BestKept& best, bool exhaustive) const {
        const auto is_due = [&](int b) {
            const Score bound = bounds_[std::size_t(b)];
            return bound != kNever && (exhaustive || bound <= best.worst());
        };
        Run run;
        while (block < search_.blocks() && !is_due(block)) ++block;
        run.blocks.first = block;
        const int end =
            std::min(search_.blocks(), (block / kBlocksAtOnce + 1) * kBlocksAtOnce);
        for (; block < end; ++block) {
            if (!is_due(block)) continue;
            run.due[std::size_t(block - run.blocks.first)] = true;
            run.blocks.count = block - run.blocks.first + 1;
        }
        return run;
    }

    std::vector<std::uint64_t> allowed_;
    std::int64_t live_;
    SegmentSearch search_;
    std::vector<Score> bounds_;  // [block]
};

void run(Executor* executor,
         std::size_t count,
         const std::function<void(std::size_t)>& work) {
    InlineExecutor alone;
    (executor == nullptr ? static_cast<Executor&>(alone) : *executor)
        .parallel_for(count, work);
}

struct Promise {
    Score bound = 0;
    std::size_t part = 0;
    int block = 0;
};

// The blocks from the best bound on, as far as they are asked for.
class Promises {
  public:
    Promises(const std::vector<std::optional<PartSearch>>& parts, Score worst) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const std::span<const Score> bounds = parts[p]->bounds();
            for (std::size_t block = 0; block < bounds.size(); ++block) {
                if (bounds[block] != PartSearch::kNever && bounds[block] <= worst)
                    heap_.push_back({bounds[block], p, int(block)});
            }
        }
        std::ranges::make_heap(heap_, std::greater<>(), &Promise::bound);
    }

    std::optional<Promise> next() {
        if (heap_.empty()) return std::nullopt;
        std::ranges::pop_heap(heap_, std::greater<>(), &Promise::bound);
        const Promise best = heap_.back();
        heap_.pop_back();
        return best;
    }

  private:
    std::vector<Promise> heap_;
};

std::vector<Match> score_tail(const Collection& collection,
                              const Query& query,
                              const IdSet* only) {
    std::vector<Match> matches;
    const LiveTail& tail = collection.tail;
    tail.records->score_all(query, query.m, tail.count, tail.removed, only, matches);
    return matches;
}

}  // namespace

SearchResult search(const Collection& collection,
                    const Query& query,
                    const SearchScope& scope) {
    SearchResult result;
    const std::vector<Match> newest = score_tail(collection, query, scope.only);
    result.searched = std::int64_t(newest.size());

    const Rounding rounding(query);
    std::vector<std::optional<PartSearch>> parts(collection.segments.size());
    run(scope.executor, parts.size(), [&](std::size_t p) {
        parts[p].emplace(collection.segments[p], query, rounding, scope.only);
    });
    for (const auto& part : parts) result.searched += part->live();
    if (scope.limit == 0) return result;

    BestKept best(scope.limit);
    for (const Match& match : newest) best.offer(match);
    if (!scope.exhaustive) {
        Promises promises(parts, best.worst());
        for (std::size_t i = 0; i < kFirstBlocks; ++i) {
            const std::optional<Promise> promise = promises.next();
            if (!promise || promise->bound > best.worst()) break;
            parts[promise->part]->visit_first(promise->block, best, result.effort);
        }
    }
    std::vector<SearchEffort> efforts(parts.size());
    run(scope.executor, parts.size(), [&](std::size_t p) {
        parts[p]->visit_rest(best, scope.exhaustive, efforts[p]);
    });
    for (const SearchEffort& effort : efforts) result.effort += effort;
    result.matches = best.take();
    return result;
}

std::vector<Match> score_all(const Collection& collection,
                             const Query& query,
                             const IdSet* only) {
    std::vector<Match> matches = score_tail(collection, query, only);
    const Rounding rounding(query);
    for (const LiveSegment& part : collection.segments) {
        const std::vector<std::uint64_t> allowed = allowed_slots(part, only);
        const SegmentSearch prepared(part.segment->view(), query, rounding, allowed);
        prepared.score_all(matches);
    }
    return matches;
}

}  // namespace haarmony::image
