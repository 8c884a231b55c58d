#include "engine/image/explain.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "engine/image/haar_inverse.h"

namespace haarmony::image {
namespace {

// In photographs the coefficient of rank r (from 0) is about so many times 1 / sqrt(r + 1),
// in units of the channel's range.
constexpr float kLargestCoefficient = 0.15F;

ExplainedChannel explain_channel(const ChannelSignature& query,
                                 const ChannelSignature& target,
                                 const std::array<std::int32_t, kBins>& weights,
                                 BinRule rule,
                                 int m) {
    ExplainedChannel channel;
    channel.query_average = query.average;
    channel.target_average = target.average;
    for (int b = 0; b < kBins; ++b) channel.bins[b].weight = weights[b];
    const auto has = target.largest(m);
    for (const std::int16_t signed_index : query.largest(m)) {
        const int index = std::abs(int{signed_index});
        ExplainedBin& bin_of = channel.bins[bin(rule, index / kSide, index % kSide)];
        if (std::ranges::find(has, signed_index) != has.end()) {
            ++bin_of.matched;
            channel.matched.push_back(signed_index);
        } else {
            ++bin_of.missed;
            channel.missed.push_back(signed_index);
        }
    }
    return channel;
}

}  // namespace

Score ExplainedChannel::distance() const {
    Score total = bins[0].weight * std::abs(std::int64_t{query_average} - target_average);
    for (const ExplainedBin& bin : bins) {
        total += std::int64_t{bin.missed} * bin.weight * kAverageOne;
    }
    return total;
}

Explanation explain(const Signature& query,
                    const Signature& target,
                    const Profile& profile,
                    int m) {
    assert(query.kind == profile.kind && target.kind == profile.kind);
    assert(m >= 1 && m <= kMaxCoefficients);
    Explanation explanation;
    for (int c = 0; c < kChannels; ++c) {
        explanation[c] = explain_channel(query.channels[c],
                                         target.channels[c],
                                         profile.weights[c],
                                         profile.bin_rule,
                                         m);
    }
    return explanation;
}

std::vector<std::uint8_t> draw_matches(const Signature& query,
                                       const Explanation& explanation) {
    std::vector<std::uint8_t> drawing(std::size_t{kDrawingWidth} * kSide);
    std::vector<float> plane(kCoefficientCount);
    for (int c = 0; c < kChannels; ++c) {
        std::ranges::fill(plane, 0.0F);
        const auto ranked = query.channels[c].largest(kMaxCoefficients);
        for (const std::int16_t signed_index : explanation[c].matched) {
            const auto rank = std::ranges::find(ranked, signed_index) - ranked.begin();
            const float size = kLargestCoefficient / std::sqrt(float(rank + 1));
            plane[std::size_t(std::abs(int{signed_index}))] =
                signed_index > 0 ? size : -size;
        }
        recompose(plane, kSide, query.kind.decomposition);
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const float value = plane[std::size_t(y) * kSide + x];
                const float grey = std::clamp(127.5F + 255.0F * value, 0.0F, 255.0F);
                drawing[std::size_t(y) * kDrawingWidth + std::size_t(c) * kSide + x] =
                    static_cast<std::uint8_t>(std::lround(grey));
            }
        }
    }
    return drawing;
}

}  // namespace haarmony::image
