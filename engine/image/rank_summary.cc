#include "engine/image/rank_summary.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <vector>

namespace haarmony::image {

RankSummary summarize(std::span<const std::int64_t> ranks, std::int64_t candidates) {
    RankSummary summary;
    if (ranks.empty()) return summary;
    std::vector<std::int64_t> sorted(ranks.begin(), ranks.end());
    std::ranges::sort(sorted);
    assert(sorted.front() >= 1 && sorted.back() <= candidates);

    const auto count = static_cast<double>(sorted.size());
    const auto share_within = [&](std::int64_t rank) {
        return static_cast<double>(std::ranges::upper_bound(sorted, rank) -
                                   sorted.begin()) /
               count;
    };
    const std::size_t half = sorted.size() / 2;
    summary.median = sorted.size() % 2 == 1
                         ? static_cast<double>(sorted[half])
                         : static_cast<double>(sorted[half - 1] + sorted[half]) / 2;
    summary.mean = static_cast<double>(
                       std::accumulate(sorted.begin(), sorted.end(), std::int64_t{0})) /
                   count;
    summary.first = share_within(1);
    summary.top_20 = share_within(20);
    summary.top_percent = share_within(std::max(std::int64_t{1}, candidates / 100));
    for (const std::int64_t rank : sorted) {
        summary.mean_reciprocal_rank += 1 / static_cast<double>(rank) / count;
    }
    return summary;
}

}  // namespace haarmony::image
