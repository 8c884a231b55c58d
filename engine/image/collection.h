// All that a search looks at: the sealed segments and the tail, as one value. Copying it
// copies pointers; what they point to never changes once it is published.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/image/index.h"
#include "engine/image/segment.h"
#include "engine/image/tail.h"
#include "engine/image/tombstones.h"

namespace haarmony::image {

struct LiveTail {
    std::shared_ptr<const Tail> records;
    int count = 0;
    TombstonesPtr removed;

    [[nodiscard]] int live() const { return count - removed_count(removed); }
};

struct Collection {
    int index_m = 0;
    std::vector<LiveSegment> segments;
    LiveTail tail;
};

[[nodiscard]] IndexStats stats(const Collection& collection);

// All of it as segments: what is live in the tail becomes one of its own, the last.
[[nodiscard]] std::vector<LiveSegment> sealed(const Collection& collection);

// Sets the tombstones of those pictures that are live; the tombstones of every segment that
// is touched are copied once, however many pictures it loses.
void remove(Collection& collection, std::span<const ImageId> ids);

// Puts `merged` (or nothing, where it is null) in the place of `parts`, handing on the
// removals that came after `parts` was taken.
// Requires: all of `parts` are still there.
void replace_segments(Collection& collection,
                      std::span<const LiveSegment> parts,
                      const std::shared_ptr<const Segment>& merged);

}  // namespace haarmony::image
