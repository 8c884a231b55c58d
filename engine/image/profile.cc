#include "engine/image/profile.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace haarmony::image {
namespace {

struct NamedRule {
    BinRule rule;
    std::string_view name;
};

constexpr std::array<NamedRule, 3> kRules = {{{BinRule::kLog2Plus1, "log2_plus_1"},
                                              {BinRule::kLinear, "linear"},
                                              {BinRule::kLiteral, "literal"}}};

// Table 4.1; rows are the channels Y, I, Q, columns the bins.
constexpr Weights kPainted = {
    {{404, 78, 46, 42, 41, 32}, {1514, 92, 53, 26, 14, 7}, {2262, 40, 63, 25, 15, 38}}};
constexpr Weights kScanned = {{{500, 83, 101, 52, 47, 30},
                               {1921, 126, 44, 53, 28, 14},
                               {3437, 36, 45, 14, 18, 27}}};

}  // namespace

int bin(BinRule rule, int row, int column) {
    assert(row >= 0 && row < kSide && column >= 0 && column < kSide);
    assert(row > 0 || column > 0);
    const int largest = std::max(row, column);
    const int floor_log2 = std::bit_width(static_cast<unsigned>(largest)) - 1;
    switch (rule) {
        case BinRule::kLog2Plus1:
            return std::min(floor_log2 + 1, kBins - 1);
        case BinRule::kLinear:
            return std::min(largest, kBins - 1);
        case BinRule::kLiteral:
            break;
    }
    return std::min(floor_log2, kBins - 1);
}

double probability(const Calibration& calibration, double distance) {
    return 1.0 / (1.0 + std::exp(calibration.scale * distance - calibration.intercept));
}

std::string_view bin_rule_name(BinRule rule) {
    const auto* const found = std::ranges::find(kRules, rule, &NamedRule::rule);
    assert(found != kRules.end());
    return found->name;
}

std::optional<BinRule> bin_rule_from_name(std::string_view name) {
    const auto* const found = std::ranges::find(kRules, name, &NamedRule::name);
    if (found == kRules.end()) return std::nullopt;
    return found->rule;
}

std::optional<Profile> built_in_profile(std::string_view name) {
    if (name == "painted")
        return Profile{"painted", {}, 60, BinRule::kLog2Plus1, kPainted, {}};
    if (name == "scanned")
        return Profile{"scanned", {}, 40, BinRule::kLog2Plus1, kScanned, {}};
    return std::nullopt;
}

}  // namespace haarmony::image
