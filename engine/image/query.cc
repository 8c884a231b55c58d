#include "engine/image/query.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace haarmony::image {
namespace {

constexpr double kScoreUnit = 100.0 * double{kAverageOne};

}  // namespace

Query make_query(const Signature& signature, const Profile& profile, int m) {
    assert(m >= 1 && m <= kMaxCoefficients);
    assert(signature.kind == profile.kind);
    Query query;
    query.m = m;
    for (int c = 0; c < kChannels; ++c) {
        const ChannelSignature& channel = signature.channels[c];
        query.average[c] = channel.average;
        query.average_weight[c] = profile.weights[c][0];
        for (const std::int16_t signed_index : channel.largest(m)) {
            const int index = std::abs(int{signed_index});
            const std::int32_t weight =
                profile.weights[c][bin(profile.bin_rule, index / kSide, index % kSide)];
            assert(weight >= 0 && weight <= kMaxWeight);
            query.terms.push_back({coefficient_key(c, signed_index), weight});
            query.weight_sum += weight;
        }
    }
    return query;
}

// What (4.4) leaves out is added again.
Score full_distance(const Query& query, Score score) {
    return score + query.weight_sum * kAverageOne;
}

double distance(const Query& query, Score score) {
    return static_cast<double>(full_distance(query, score)) / kScoreUnit;
}

double similarity(const Query& query, Score score) {
    const Score from_target = full_distance(query, score);
    if (query.weight_sum == 0) return from_target == 0 ? 1.0 : 0.0;
    const double weights = static_cast<double>(query.weight_sum) * double{kAverageOne};
    return std::clamp(1.0 - static_cast<double>(from_target) / weights, 0.0, 1.0);
}

SearchEffort& SearchEffort::operator+=(const SearchEffort& other) {
    blocks += other.blocks;
    blocks_visited += other.blocks_visited;
    rows += other.rows;
    compared += other.compared;
    return *this;
}

}  // namespace haarmony::image
