// An immutable block of at most kMaxSlots pictures: search arrays, averages, shapes and ids.
//
// Shape   slots are in rising order of id, so that an id is found by binary search.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads const-thread-safe.
// Source  sec. 4.3.1, 4.3.2; Figure 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/id_set.h"
#include "engine/image/record.h"
#include "engine/image/search_arrays.h"
#include "engine/image/tombstones.h"
#include "engine/image/top_k.h"

namespace haarmony::image {

class Segment;

// A segment and those of its pictures that are gone.
struct LiveSegment {
    std::shared_ptr<const Segment> segment;
    TombstonesPtr removed;

    [[nodiscard]] int live() const;
};

// Working storage of one search, reused from segment to segment.
struct SegmentScores {
    std::vector<std::int32_t> matched;
    std::vector<Score> scores;
};

class Segment {
  public:
    // Requires: 1 <= size <= kMaxSlots, ids rising.
    [[nodiscard]] static std::shared_ptr<const Segment> from_records(
        std::span<const Record* const> records,
        int index_m);

    // The live pictures of `parts`, or null where there are none.
    // Requires: at most kMaxSlots of them, no id live in two parts, one index_m.
    [[nodiscard]] static std::shared_ptr<const Segment> merge(
        std::span<const LiveSegment> parts);

    [[nodiscard]] int size() const { return static_cast<int>(ids_.size()); }
    [[nodiscard]] ImageId id(int slot) const { return ids_[std::size_t(slot)]; }
    [[nodiscard]] std::optional<int> find(ImageId id) const;

    // Offers every picture that is not removed, and in `only` if there is one; returns how
    // many these are.
    int search(const Query& query,
               const TombstonesPtr& removed,
               const IdSet* only,
               SegmentScores& scores,
               TopK& top) const;
    // Appends the scores of the same pictures, in the order of ids.
    void score_all(const Query& query,
                   const TombstonesPtr& removed,
                   const IdSet* only,
                   SegmentScores& scores,
                   std::vector<Match>& out) const;

    [[nodiscard]] std::int64_t bytes() const;

  private:
    // What is known of a slot beside its coefficients: a column each.
    struct Columns {
        std::array<std::vector<std::int32_t>, kChannels> averages;
        std::vector<std::int32_t> log_aspects;
    };

    Segment(std::vector<ImageId> ids, Columns columns, SearchArrays arrays);
    void score(const Query& query, SegmentScores& scores) const;

    std::vector<ImageId> ids_;
    Columns columns_;
    SearchArrays arrays_;
};

}  // namespace haarmony::image
