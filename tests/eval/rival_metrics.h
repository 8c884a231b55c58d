// The metrics that L^q is compared with: L1 and L2, at full size and on 8 x 8 averages, and
// the colour histogram L^c.
//
// Shape   128 x 128 RGB bytes; 8 x 8 x 3 sums of 256 bytes each; 6 x 6 x 6 counts.
// Units   sRGB bytes. L2 is kept squared: the order is the same.
// Scale   all distances are exact integers.
// Errors  none.
// Threads const-safe.
// Source  sec. 4.2.1, 4.5.2.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/image_view.h"

namespace haarmony::eval {

struct RivalFeatures {
    std::vector<std::uint8_t> square;  // 128 * 128 * 3, interleaved
    std::array<std::int32_t, 8 * 8 * 3> cells{};
    std::array<std::int32_t, 6 * 6 * 6> histogram{};
};

enum class Rival { kL1Full, kL2Full, kL1Cells, kL2Cells, kHistogram };
inline constexpr std::array kRivals = {Rival::kL1Full,
                                       Rival::kL2Full,
                                       Rival::kL1Cells,
                                       Rival::kL2Cells,
                                       Rival::kHistogram};

// How tables name a metric: "L1", "128x128".
struct MetricName {
    std::string metric;
    std::string resolution;
    friend bool operator==(const MetricName&, const MetricName&) = default;
};
[[nodiscard]] MetricName rival_name(Rival rival);

// Of a picture of any size; what is transparent is filled as it is for signatures.
[[nodiscard]] RivalFeatures describe_rivals(const ImageView& picture);

[[nodiscard]] std::uint64_t distance(Rival rival,
                                     const RivalFeatures& a,
                                     const RivalFeatures& b);

}  // namespace haarmony::eval
