// A picture's coefficients of one channel, apart by where a segment keeps them.
//   segment_layout.h, picture_source.h -> [sorted_channel.h] -> row_writer.h, segment_builder.h
//
// Shape   each coefficient in a row of bits, of a dense list or a coarse one; and with the
//         picture, unless its list is dense in the tier of its rank.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Threads none: one thread sorts, and reads what it sorted.
// Source  sec. 4.3.1 (search arrays).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/image/segment_layout.h"

namespace haarmony::image {

struct DensePosting {
    std::uint16_t list = 0;
    std::uint8_t rank = 0;
    std::uint8_t tier = 0;  // of the rank
};

// A picture's coefficients of one channel, apart by where they are kept.
class SortedChannel {
  public:
    SortedChannel(const Tiers& tiers,
                  const std::array<std::uint32_t, kMaxTiers>& dense_in_tier,
                  std::span<const DirectoryEntry> directory)
        : tiers_(tiers), dense_in_tier_(dense_in_tier), directory_(directory) {}

    // Makes all that follows. Requires: at most kMaxCoefficients, each with an entry.
    void sort(int channel, std::span<const std::int16_t> signed_indices);

    [[nodiscard]] std::span<const DensePosting> dense() const {
        return std::span(dense_).first(dense_count_);
    }
    [[nodiscard]] std::span<const std::uint16_t> coarse_rows() const {
        return std::span(coarse_).first(coarse_count_);
    }
    // What the picture keeps itself, in falling order of magnitude.
    [[nodiscard]] std::span<const std::int16_t> own() const {
        return std::span(own_).first(own_count_);
    }
    [[nodiscard]] std::span<const std::uint8_t> own_ranks() const {
        return std::span(own_ranks_).first(own_count_);
    }
    [[nodiscard]] const OwnCounts::value_type& own_in_tier() const {
        return own_in_tier_;
    }

  private:
    const Tiers& tiers_;
    const std::array<std::uint32_t, kMaxTiers>& dense_in_tier_;
    std::span<const DirectoryEntry> directory_;  // [key]

    std::array<std::uint16_t, kMaxCoefficients> entries_{};
    std::array<DensePosting, kMaxCoefficients> dense_{};
    std::array<std::uint16_t, kMaxCoefficients> coarse_{};
    std::array<std::int16_t, kMaxCoefficients> own_{};
    std::array<std::uint8_t, kMaxCoefficients> own_ranks_{};
    std::size_t dense_count_ = 0;
    std::size_t coarse_count_ = 0;
    std::size_t own_count_ = 0;
    OwnCounts::value_type own_in_tier_{};
};

}  // namespace haarmony::image
