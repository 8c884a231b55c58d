// How pictures are compared: the choices of section 4.2.2 as one named value.
//
// Shape   weights[channel][bin], channels Y, I, Q; bin 0 weighs the average colour.
// Units   weights are integers in 1/100, so that scores are exact in any order of addition.
// Source  sec. 4.2.2, 4.3.2, Table 4.1 as restored in ARCHITECTURE.md ("Errata").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/image/signature.h"

namespace haarmony::image {

inline constexpr int kBins = 6;

enum class BinRule {
    kLog2Plus1,  // min(floor(log2 max(i, j)) + 1, 5): the default
    kLinear,     // min(max(i, j), 5): the imgSeek family
    kLiteral,    // min(floor(log2 max(i, j)), 5): as printed in the dissertation
};

using Weights = std::array<std::array<std::int32_t, kBins>, kChannels>;

// The largest weight, 10,000.00: 300 matching coefficients stay far inside 64 bits.
inline constexpr std::int32_t kMaxWeight = 1'000'000;

// The probability that a target at `distance` is the one that was meant:
// F(intercept - scale * distance), F(x) = 1 / (1 + e^-x) (sec. 4.3.3).
struct Calibration {
    double intercept = 0;
    double scale = 0;
    friend bool operator==(const Calibration&, const Calibration&) = default;
};

[[nodiscard]] double probability(const Calibration& calibration, double distance);

struct Profile {
    std::string name;
    SignatureKind kind;
    int m = 60;  // coefficients per channel, 1..kMaxCoefficients
    BinRule bin_rule = BinRule::kLog2Plus1;
    Weights weights{};                       // each in [0, kMaxWeight]
    std::optional<Calibration> calibration;  // of trained profiles
};

// The bin of coefficient (row, column). Requires: 0 <= row, column < kSide, not both 0.
[[nodiscard]] int bin(BinRule rule, int row, int column);

// "log2_plus_1", "linear" or "literal".
[[nodiscard]] std::string_view bin_rule_name(BinRule rule);
[[nodiscard]] std::optional<BinRule> bin_rule_from_name(std::string_view name);

// "painted" (m 60) and "scanned" (m 40), or nothing.
[[nodiscard]] std::optional<Profile> built_in_profile(std::string_view name);

}  // namespace haarmony::image
