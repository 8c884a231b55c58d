#include "engine/image/combined_rank.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <tuple>

namespace haarmony::image {
namespace {

// ranks[i]: that of matches[i], counted from 1.
std::vector<std::int64_t> ranks_of(std::span<const BestMatch> matches) {
    std::vector<std::size_t> order(matches.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) {
        return std::tuple(matches[i].distance, matches[i].id);
    });
    std::vector<std::int64_t> ranks(matches.size());
    for (std::size_t place = 0; place < order.size(); ++place) {
        ranks[order[place]] = std::int64_t(place) + 1;
    }
    return ranks;
}

}  // namespace

std::vector<CombinedMatch> combine_ranks(std::span<const std::vector<BestMatch>> metrics,
                                         CombineBy combine_by,
                                         int limit) {
    assert(!metrics.empty() && limit >= 0);
    std::vector<CombinedMatch> combined;
    const std::vector<std::int64_t> first_ranks = ranks_of(metrics[0]);
    for (std::size_t i = 0; i < metrics[0].size(); ++i) {
        combined.push_back({metrics[0][i], first_ranks[i]});
    }
    for (const std::vector<BestMatch>& metric : metrics.subspan(1)) {
        const std::vector<std::int64_t> ranks = ranks_of(metric);
        auto known = metric.begin();
        for (CombinedMatch& match : combined) {
            while (known != metric.end() && known->id < match.first.id) ++known;
            const bool is_known = known != metric.end() && known->id == match.first.id;
            const std::int64_t rank = is_known
                                          ? ranks[std::size_t(known - metric.begin())]
                                          : std::int64_t(metric.size()) + 1;
            match.rank = combine_by == CombineBy::kMean ? match.rank + rank
                                                        : std::max(match.rank, rank);
        }
    }
    std::ranges::sort(combined, {}, [](const CombinedMatch& match) {
        return std::tuple(match.rank, match.first.distance, match.first.id);
    });
    if (combined.size() > std::size_t(limit)) combined.resize(std::size_t(limit));
    return combined;
}

}  // namespace haarmony::image
