// A set of pictures that a search is narrowed to: one bit for each id between the smallest
// and the largest.
//
// Threads const-thread-safe.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/ids.h"

namespace haarmony::image {

class IdSet {
  public:
    IdSet() = default;
    // Cost: memory of (largest - smallest) / 8 bytes.
    explicit IdSet(std::span<const ImageId> ids) {
        if (ids.empty()) return;
        std::int64_t last = first_ = to_int(ids.front());
        for (const ImageId id : ids) {
            first_ = std::min(first_, to_int(id));
            last = std::max(last, to_int(id));
        }
        words_.resize(std::size_t(last - first_) / 64 + 1);
        for (const ImageId id : ids) {
            const auto bit = std::uint64_t(to_int(id) - first_);
            words_[bit / 64] |= std::uint64_t{1} << (bit % 64);
        }
    }

    [[nodiscard]] bool contains(ImageId id) const {
        // One comparison for both ends: an id before the first wraps around.
        const auto bit = std::uint64_t(to_int(id)) - std::uint64_t(first_);
        return bit / 64 < words_.size() && (words_[bit / 64] >> (bit % 64) & 1U) != 0;
    }

  private:
    std::int64_t first_ = 0;
    std::vector<std::uint64_t> words_;
};

}  // namespace haarmony::image
