#include "ingest/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace haarmony::ingest {
namespace {

double srgb_to_linear(double encoded) {
    if (encoded <= 0.04045) return encoded / 12.92;
    return std::pow((encoded + 0.055) / 1.055, 2.4);
}

// thresholds[i]: the smallest linear value that rounds to i + 1. A search in them is exact
// and costs eight comparisons instead of a pow.
std::array<float, 255> make_thresholds() {
    std::array<float, 255> thresholds{};
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
        thresholds[i] =
            static_cast<float>(srgb_to_linear((static_cast<double>(i) + 0.5) / 255));
    }
    return thresholds;
}

}  // namespace

std::uint8_t linear_to_srgb(float linear) {
    static const std::array<float, 255> kThresholds = make_thresholds();
    if (!(linear > 0)) return 0;  // not-a-number too
    const auto above = std::upper_bound(kThresholds.begin(), kThresholds.end(), linear);
    return static_cast<std::uint8_t>(above - kThresholds.begin());
}

}  // namespace haarmony::ingest
