// The searchable collection: immutable sealed segments and one small mutable tail
// (image search, behind collection_search.h). Readers take a snapshot and never wait.
//
// Shape    segments hold search arrays with the first `index_m` coefficients per channel;
//          removed pictures are tombstone bits, never a special value.
// Errors   none at run time.
// Threads  snapshot() and merge_once() may be called from any thread at any time;
//          apply() too, but calls of apply() follow one another. A snapshot is immutable
//          and may be searched from any number of threads. No lock is held while scoring,
//          while building a segment in merge_once(), or while decoding.
// Source   sec. 4.3.1, 4.3.2; Figure 4.2.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "engine/core/executor.h"
#include "engine/core/ids.h"
#include "engine/image/id_set.h"
#include "engine/image/query.h"
#include "engine/image/record.h"

namespace haarmony::image {

struct IndexOptions {
    int index_m = 60;  // coefficients per channel that are kept, 1..kMaxCoefficients
    int tail_capacity = 1024;  // records scanned one by one before they are sealed
};

struct IndexStats {
    std::int64_t images = 0;      // live
    std::int64_t tombstones = 0;  // removed or replaced, still occupying a slot
    std::int64_t segments = 0;
    std::int64_t tail = 0;   // slots of the tail in use
    std::int64_t bytes = 0;  // of search arrays, ids, averages and the tail
    // Of these, what only another m than 20, 40 and index_m, or a merge, reads.
    std::int64_t rank_bytes = 0;
};

// How many matches are wanted, and among which pictures.
struct SearchScope {
    int limit = 0;                 // >= 0
    const IdSet* only = nullptr;   // null: all
    Executor* executor = nullptr;  // who helps with a large collection; null: nobody
    // Leaves nothing out that need not be looked at: the answer is the same. For measuring.
    bool exhaustive = false;
};

struct LiveSegment;  // segment.h
class IndexSnapshot;

// Where the bytes of segments come from.
enum class SegmentOrigin {
    kBuilt,  // by this program, in this process
    kFile,   // view_known_segment() let them pass
};

class Index {
  public:
    explicit Index(const IndexOptions& options);
    ~Index();
    Index(const Index&) = delete;
    Index& operator=(const Index&) = delete;

    // Adds or replaces (same id) `upserts`, then removes `removals`; unknown ids are no
    // error. Later entries win over earlier ones with the same id. All of it becomes
    // visible at once.
    void apply(std::span<const Record> upserts, std::span<const ImageId> removals);

    // Holds what the segments hold from now on, and nothing else.
    // Requires: this index_m, no id live in two segments; no apply() at the same time.
    void reset(std::vector<LiveSegment> segments, SegmentOrigin origin);

    // Merges the segments that are due and publishes the result; returns whether there was
    // anything to merge. Long: meant for a background thread. What came from a file is checked
    // completely before its first merge, and stays as it is where it is damaged.
    bool merge_once();

    [[nodiscard]] std::shared_ptr<const IndexSnapshot> snapshot() const;
    [[nodiscard]] int index_m() const;

  private:
    class State;
    std::unique_ptr<State> state_;
};

class IndexSnapshot {
  public:
    virtual ~IndexSnapshot() = default;

    // The best matches, exactly, best first, ties to the smaller id. Terms of the query
    // beyond index_m do not exist in the index: a caller makes the query with m <= index_m.
    [[nodiscard]] virtual SearchResult search(const Query& query,
                                              const SearchScope& scope) const = 0;
    // Every picture with its score, in no order: what ranks of several metrics are made of.
    [[nodiscard]] virtual std::vector<Match> score_all(const Query& query,
                                                       const IdSet* only) const = 0;
    [[nodiscard]] virtual IndexStats stats() const = 0;
    // All that is live, as segments: as they are, and the tail in one of its own.
    // Cost: that segment's.
    [[nodiscard]] virtual std::vector<LiveSegment> sealed() const = 0;
};

}  // namespace haarmony::image
