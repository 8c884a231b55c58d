// The newest pictures, before they are sealed: an append-only block of fixed capacity.
//
// Threads one writer appends; readers look only at the first `count` records of a snapshot
//         that was published after these were written, and so never meet the writer.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/image/id_set.h"
#include "engine/image/query.h"
#include "engine/image/record.h"
#include "engine/image/tombstones.h"

namespace haarmony::image {

class Tail {
  public:
    // Requires: capacity >= 1.
    explicit Tail(int capacity);

    [[nodiscard]] int capacity() const { return capacity_; }
    [[nodiscard]] const Record& operator[](int slot) const { return records_[slot]; }

    // Requires: slot < capacity, in no published count yet.
    void write(int slot, const Record& record) { records_[slot] = record; }

    // Appends the scores of those pictures of the first `count` that are not removed, and
    // in `only` if there is one, compared one by one and cut at `m`.
    void score_all(const Query& query,
                   int m,
                   int count,
                   const TombstonesPtr& removed,
                   const IdSet* only,
                   std::vector<Match>& out) const;

    [[nodiscard]] std::int64_t bytes() const;

  private:
    int capacity_;
    std::unique_ptr<Record[]> records_;
};

}  // namespace haarmony::image
