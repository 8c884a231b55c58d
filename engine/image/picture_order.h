// The order of the pictures of a segment: like beside like, so that the pictures of a block
// share what a query can rule out, and whole blocks need not be looked at.
//   segment_layout.h -> [picture_order.h] -> segment_builder.h
//
// A k-d tree (Bentley, 1975) over what weighs most in the metric: the three averages and the
// signs of the coarsest coefficients. A node is split where its two halves differ most in
// what a query may give them; at an average, where a block ends.
//
// Errors  none; spans of two sizes are a caller's bug and assert.
// Threads const-thread-safe.
// Source  J. L. Bentley, Multidimensional binary search trees used for associative
//         searching, 1975.
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
    // Of each channel and sign, all such places but that of the mean.
    static constexpr int kCount = 2 * kChannels * (4 * 4 - 1);

    // The bit in [0, kCount) of a key, or -1 where the key is not coarse.
    // Requires: key < kKeyCount, see coefficient_key().
    [[nodiscard]] static int bit_of(std::uint32_t key);

    // Whether it has one; the same, but without a jump. Requires: as bit_of().
    [[nodiscard]] static bool has_bit(std::uint32_t key) {
        const std::uint32_t index = key % kCoefficientCount;
        return ((index & ~(3U * kSide + 3U)) == 0) & (index != 0);
    }

    // Requires, as test(): 0 <= bit < kCount.
    void set(int bit) { words_[std::size_t(bit) / 64] |= std::uint64_t{1} << (bit % 64); }
    [[nodiscard]] bool test(int bit) const {
        return (words_[std::size_t(bit) / 64] >> (bit % 64) & 1U) != 0;
    }
    // Bit b is bit b % 64 of word b / 64.
    [[nodiscard]] const std::array<std::uint64_t, 2>& words() const { return words_; }

  private:
    std::array<std::uint64_t, 2> words_{};
};

// The pictures, by their places in the spans, in their new order: each once. The same spans
// give the same order.
// Requires: both spans have one size. Cost: size * log(size / 256).
[[nodiscard]] std::vector<std::uint32_t> picture_order(
    std::span<const PictureTerms> terms,
    std::span<const CoarseSigns> signs);

}  // namespace haarmony::image
