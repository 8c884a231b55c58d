// How well a ranking found what was meant, over many queries.
//
// Units   a rank is 1 for the best match.
// Source  sec. 4.5.2 ("upper 1%"); top 20: what one screen shows, sec. 4.4.
#pragma once

#include <cstdint>
#include <span>

namespace haarmony::image {

struct RankSummary {
    double median = 0;  // the mean of the two in the middle, if there are two
    double mean = 0;
    double first = 0;  // share of rank 1, as all shares in [0, 1]
    double top_20 = 0;
    double top_percent = 0;  // within the best 1 % of the candidates, at least 1
    double mean_reciprocal_rank = 0;

    friend bool operator==(const RankSummary&, const RankSummary&) = default;
};

// Requires: every rank in [1, candidates]; no ranks make a summary of zeros.
[[nodiscard]] RankSummary summarize(std::span<const std::int64_t> ranks,
                                    std::int64_t candidates);

}  // namespace haarmony::image
