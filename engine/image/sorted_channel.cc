#include "engine/image/sorted_channel.h"

#include <algorithm>
#include <cassert>

namespace haarmony::image {

// Nothing here is decided by a jump: whether a coefficient is dense cannot be foretold, and a
// jump that was taken wrongly costs as much as ten coefficients. So each is written into
// every list, and stays in those whose count goes on.
void SortedChannel::sort(int channel, std::span<const std::int16_t> signed_indices) {
    assert(signed_indices.size() <= entries_.size());
    const std::uint32_t first_dense = DirectoryEntry::of_dense(0).bits();
    const std::uint32_t first_coarse = DirectoryEntry::of_coarse(0).bits();
    // On their own, so that many are on their way from the far caches at once.
    for (std::size_t rank = 0; rank < signed_indices.size(); ++rank)
        entries_[rank] =
            directory_[coefficient_key(channel, signed_indices[rank])].bits();
    std::size_t dense = 0;
    std::size_t coarse = 0;
    std::size_t own = 0;
    std::size_t rank = 0;
    for (int t = 0; t < kMaxTiers; ++t) {
        const std::size_t end =
            t < tiers_.count ? std::min(signed_indices.size(), std::size_t(tiers_.m[t]))
                             : rank;
        for (; rank < end; ++rank) {
            const std::uint32_t entry = entries_[rank];
            dense_[dense] = {static_cast<std::uint16_t>(entry - first_dense),
                             static_cast<std::uint8_t>(rank),
                             static_cast<std::uint8_t>(t)};
            coarse_[coarse] = static_cast<std::uint16_t>(entry - first_coarse);
            own_[own] = signed_indices[rank];
            own_ranks_[own] = static_cast<std::uint8_t>(rank);
            dense += entry < first_coarse ? 1 : 0;
            coarse += entry < first_coarse ? 0 : 1;
            // Lists that are dense in this tier stand first, coarse ones last.
            own += entry - first_dense < dense_in_tier_[t] ? 0 : 1;
        }
        own_in_tier_[t] = static_cast<std::uint8_t>(own);
    }
    dense_count_ = dense;
    coarse_count_ = coarse;
    own_count_ = own;
}

}  // namespace haarmony::image
