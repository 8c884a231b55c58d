// A set of pictures that a search is narrowed to: one bit for each id between the smallest
// and the largest.
//
// Threads const-thread-safe.
#pragma once

#include <algorithm>
#include <bit>
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
        for (const std::uint64_t word : words_) size_ += std::popcount(word);
    }

    [[nodiscard]] bool contains(ImageId id) const {
        // One comparison for both ends: an id before the first wraps around.
        const auto bit = std::uint64_t(to_int(id)) - std::uint64_t(first_);
        return bit / 64 < words_.size() && (words_[bit / 64] >> (bit % 64) & 1U) != 0;
    }

    // How many ids there are.
    [[nodiscard]] std::int64_t size() const { return size_; }

    // Calls visit(ImageId) for each, rising.
    template <typename Visit>
    void for_each(const Visit& visit) const {
        for (std::size_t word = 0; word < words_.size(); ++word) {
            for (std::uint64_t rest = words_[word]; rest != 0; rest &= rest - 1) {
                visit(ImageId{first_ + std::int64_t(word * 64) + std::countr_zero(rest)});
            }
        }
    }

  private:
    std::int64_t first_ = 0;
    std::int64_t size_ = 0;
    std::vector<std::uint64_t> words_;
};

}  // namespace haarmony::image
