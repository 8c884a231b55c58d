// What a list of latencies looks like.
#pragma once

#include <vector>

namespace haarmony::bench {

struct Quantiles {
    double p50 = 0;
    double p90 = 0;
    double p99 = 0;
    double max = 0;
};

// Nearest rank: the smallest value that at least that share of all does not exceed.
// Requires: `values` is not empty.
[[nodiscard]] Quantiles quantiles_of(std::vector<double> values);

}  // namespace haarmony::bench
