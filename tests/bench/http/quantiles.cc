#include "tests/bench/http/quantiles.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace haarmony::bench {
namespace {

double at_percent(const std::vector<double>& sorted, std::size_t percent) {
    return sorted[(sorted.size() * percent + 99) / 100 - 1];
}

}  // namespace

Quantiles quantiles_of(std::vector<double> values) {
    assert(!values.empty());
    std::ranges::sort(values);
    return {at_percent(values, 50),
            at_percent(values, 90),
            at_percent(values, 99),
            values.back()};
}

}  // namespace haarmony::bench
