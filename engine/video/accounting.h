// What a clip would take in the dissertation's own layout, as its Table 5.1 counts it.
//   time_tree.h -> [accounting.h]
//
// A *subtree* is a pixel of any level but the finest with what lies below it (Figure 5.2).
// It is pruned where all finest pixels below look like it; it is an up-link where it is, with
// all averages, byte for byte what the time-parent has at the same place. Counted are the
// pictures that are displayed, with padded edges: how we store them makes no difference.
//
// Errors   what the storage meets.
// Cost     a few nanoseconds for each pixel that is not shared with the time-parent.
// Threads  const-thread-safe.
// Source   sec. 5.2.3, Table 5.1; ERRATA of the project, video 27.
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

inline constexpr std::uint64_t kSubtreeBytes = 24;
inline constexpr std::uint64_t kTimeNodeBytes = 12;

struct StorageCounts {
    std::uint64_t time_nodes = 0;         // all that exist, stored or not
    std::uint64_t complete_subtrees = 0;  // neither pruned nor linked
    std::uint64_t pruned_subtrees = 0;    // left when flat ones are pruned
    std::uint64_t own_subtrees = 0;       // left when linked ones are not counted either
    std::uint64_t uplinks = 0;            // topmost linked subtrees
    std::uint64_t paper_bytes = 0;        // of the own subtrees, and of the time nodes
    std::uint64_t complete_bytes = 0;
    std::uint64_t pruned_bytes = 0;

    friend bool operator==(const StorageCounts&, const StorageCounts&) = default;
};

[[nodiscard]] Result<StorageCounts> count_storage(const TimeTree& clip);

}  // namespace haarmony::video
