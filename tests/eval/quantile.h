// Order statistics of measurements.
//
// Source  the nearest rank: a value that was measured, never one between two.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

namespace haarmony::eval {

// The smallest value that is not below a share of `share` of all.
// Requires: values not empty, 0 <= share <= 1. Cost: linear.
[[nodiscard]] inline double quantile(std::vector<double> values, double share) {
    assert(!values.empty() && share >= 0 && share <= 1);
    const auto rank = static_cast<std::ptrdiff_t>(
        std::ceil(share * static_cast<double>(values.size())));
    const auto at = values.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
    std::ranges::nth_element(values, at);
    return *at;
}

// The median distance from the median. Requires: values not empty.
[[nodiscard]] inline double median_deviation(std::vector<double> values) {
    const double median = quantile(values, 0.5);
    for (double& value : values) value = std::fabs(value - median);
    return quantile(std::move(values), 0.5);
}

}  // namespace haarmony::eval
