// The order of the pictures of a segment: like beside like, so that the pictures of a block
// share what a query can rule out, and whole blocks need not be looked at.
//   signature.h -> [picture_order.h] -> segment_builder.h
//
// A k-d tree (Bentley, 1975) over what weighs most in the metric: the three averages and the
// signs of the coarsest coefficients. Each node is split where the bound of the two halves
// gains most.
//
// Errors   none.
// Threads  const-thread-safe.
// Source   J. L. Bentley, Multidimensional binary search trees used for associative
//          searching, 1975.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/segment_layout.h"

namespace haarmony::image {

// Which of the coarsest coefficients, those with row and column below 4, a picture has, and
// with which sign: one bit for each such key.
class CoarseSigns {
  public:
    static constexpr int kCount = 2 * kChannels * 15;

    // The bit of a key, or -1 where the key is not coarse.
    [[nodiscard]] static int bit_of(std::uint32_t key);

    void set(int bit) { words_[std::size_t(bit) / 64] |= std::uint64_t{1} << (bit % 64); }
    [[nodiscard]] bool test(int bit) const {
        return (words_[std::size_t(bit) / 64] >> (bit % 64) & 1U) != 0;
    }
    [[nodiscard]] const std::array<std::uint64_t, 2>& words() const { return words_; }

  private:
    std::array<std::uint64_t, 2> words_{};
};

// The pictures, by their places in the spans, in their new order.
// Requires: both spans have one size. Cost: size * log(size / 256).
[[nodiscard]] std::vector<std::uint32_t> picture_order(
    std::span<const PictureTerms> terms,
    std::span<const CoarseSigns> signs);

}  // namespace haarmony::image
