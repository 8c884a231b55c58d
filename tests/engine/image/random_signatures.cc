#include "tests/engine/image/random_signatures.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "engine/image/metric.h"

namespace haarmony::image {

Signature random_signature(std::mt19937& random, const SignatureShape& shape) {
    const auto below = [&random](int bound) {
        return static_cast<int>(random() % bound);
    };
    Signature signature;
    for (ChannelSignature& channel : signature.channels) {
        channel.average = static_cast<std::int32_t>(
            below(shape.average_steps) * (kAverageOne / 2) / shape.average_steps);
        const int count = below(std::min(shape.max_count, shape.max_index) + 1);
        while (channel.count < count) {
            const int index = 1 + below(shape.max_index);
            const auto used = channel.largest(channel.count);
            if (std::ranges::any_of(used, [&](int i) { return std::abs(i) == index; })) {
                continue;
            }
            channel.indices[channel.count++] =
                static_cast<std::int16_t>(below(2) == 0 ? index : -index);
        }
    }
    return signature;
}

SearchResult search_literally(const Reference& pictures,
                              const Signature& query,
                              const Profile& profile,
                              int m,
                              const Wanted& wanted) {
    // (4.4) leaves out what does not depend on the target: the weights of the query.
    Signature nothing;
    for (int c = 0; c < kChannels; ++c) {
        nothing.channels[c].average = query.channels[c].average;
    }
    const std::int64_t constant = metric(query, nothing, profile, m);

    std::vector<std::pair<std::int64_t, std::int64_t>> ranking;
    for (const auto& [id, target] : pictures) {
        if (wanted.only && !wanted.only->contains(id)) continue;
        const std::int64_t shapes = wanted.log_aspect > target.log_aspect
                                        ? wanted.log_aspect - target.log_aspect
                                        : target.log_aspect - wanted.log_aspect;
        ranking.emplace_back(metric(query, target.signature, profile, m) - constant +
                                 wanted.aspect_weight * shapes,
                             id);
    }
    std::sort(ranking.begin(), ranking.end());
    SearchResult result;
    result.searched = std::int64_t(ranking.size());
    const auto kept = std::min(ranking.size(), std::size_t(wanted.limit));
    for (std::size_t i = 0; i < kept; ++i) {
        result.matches.push_back({ImageId{ranking[i].second}, ranking[i].first});
    }
    return result;
}

}  // namespace haarmony::image
