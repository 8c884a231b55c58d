// The rivals of Figure 4.6 as a linear scan over compact descriptions: L1 and L2 of 8 x 8
// averages, and the colour histogram. What a search without an index costs.
//
// Shape   192 bytes a picture for the averages, 432 for the histogram, each in one array.
// Units   sRGB bytes; counts of 128 x 128 cells. L2 is kept squared.
// Scale   distances are exact integers; ties go to the smaller place.
// Errors  none.
// Threads const-safe.
// Source  sec. 4.2.1, 4.5.2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tests/eval/degrade.h"

namespace haarmony::eval {

using CellBytes = std::array<std::uint8_t, 8 * 8 * 3>;
using HistogramCounts = std::array<std::uint16_t, 6 * 6 * 6>;

struct CompactFeatures {
    CellBytes cells{};            // means, rounded
    HistogramCounts histogram{};  // of the kSide x kSide cells; 16,384 in all
    friend bool operator==(const CompactFeatures&, const CompactFeatures&) = default;
};

// Requires: the picture is kSide x kSide.
[[nodiscard]] CompactFeatures compact_features(const RgbPicture& picture);

struct NearPlace {
    std::uint32_t distance = 0;
    std::uint32_t place = 0;
    friend auto operator<=>(const NearPlace&, const NearPlace&) = default;
};

// The `limit` closest places, best first. Requires: fewer than 2^32 pictures.
[[nodiscard]] std::vector<NearPlace> closest_l1(const CellBytes& query,
                                                std::span<const CellBytes> pictures,
                                                int limit);
[[nodiscard]] std::vector<NearPlace> closest_l2(const CellBytes& query,
                                                std::span<const CellBytes> pictures,
                                                int limit);
[[nodiscard]] std::vector<NearPlace> closest_histogram(
    const HistogramCounts& query,
    std::span<const HistogramCounts> pictures,
    int limit);

}  // namespace haarmony::eval
