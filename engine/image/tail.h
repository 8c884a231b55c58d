// The newest pictures, before they are sealed: an append-only block of fixed capacity.
//
// Threads one writer appends; readers look only at the first `count` records of a snapshot
//         that was published after these were written, and so never meet the writer.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/image/record.h"
#include "engine/image/tombstones.h"
#include "engine/image/top_k.h"

namespace haarmony::image {

class Tail {
  public:
    // Requires: capacity >= 1.
    explicit Tail(int capacity);

    [[nodiscard]] int capacity() const { return capacity_; }
    [[nodiscard]] const Record& operator[](int slot) const { return records_[slot]; }

    // Requires: slot < capacity, in no published count yet.
    void write(int slot, const Record& record) { records_[slot] = record; }

    // Offers every picture of the first `count` that is not removed, compared one by one
    // and cut at `m`.
    void search(const Query& query,
                int m,
                int count,
                const TombstonesPtr& removed,
                TopK& top) const;

    [[nodiscard]] std::int64_t bytes() const;

  private:
    int capacity_;
    std::unique_ptr<Record[]> records_;
};

}  // namespace haarmony::image
