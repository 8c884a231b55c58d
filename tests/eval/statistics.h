// What a list of ranks says, and how far it can be trusted.
//
// Units   rates and shares in [0, 1]; ranks start at 1.
// Source  Wilson (1927), score interval for a rate; Efron's bootstrap, percentiles, for what
//         is no rate. sec. 4.5.2 for "top 1 %": the floor of 0.01 n, but at least one picture.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace haarmony::eval {

struct Interval {
    double low = 0;
    double high = 0;
};

// 95 %. Requires: 0 <= successes <= trials, trials >= 1.
[[nodiscard]] Interval wilson(std::int64_t successes, std::int64_t trials);

// 95 % of `statistic` over `values` drawn again `resamples` times, with a fixed seed.
// Requires: values not empty, resamples >= 1.
[[nodiscard]] Interval bootstrap(
    std::span<const double> values,
    const std::function<double(std::span<const double>)>& statistic,
    int resamples,
    std::uint64_t seed);

[[nodiscard]] double mean(std::span<const double> values);

// How many pictures make up the top `share` of `pictures`.
[[nodiscard]] std::int64_t top_count(double share, std::int64_t pictures);

struct Rate {
    std::int64_t hits = 0;
    std::int64_t trials = 0;

    [[nodiscard]] double share() const {
        return static_cast<double>(hits) / static_cast<double>(trials);
    }
    [[nodiscard]] Interval interval() const { return wilson(hits, trials); }
};

struct RankSummary {
    std::int64_t pictures = 0;
    Rate first;   // rank 1
    Rate top_20;  // one screen
    Rate top_1_percent;
    double mean_reciprocal = 0;
    Interval mean_reciprocal_interval;
    std::int64_t median = 0;  // the lower one
};

[[nodiscard]] Rate within(std::span<const std::int64_t> ranks, std::int64_t limit);

// Requires: ranks not empty.
[[nodiscard]] RankSummary summarize(std::span<const std::int64_t> ranks,
                                    std::int64_t pictures);

}  // namespace haarmony::eval
