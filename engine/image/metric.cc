#include "engine/image/metric.h"

#include <cassert>
#include <cstdlib>
#include <vector>

namespace haarmony::image {
namespace {

// The truncated, quantised coefficients: -1, 0 or +1 at every place.
std::vector<int> quantized(const ChannelSignature& channel, int m) {
    std::vector<int> places(kCoefficientCount, 0);
    for (const std::int16_t signed_index : channel.largest(m)) {
        places[std::abs(signed_index)] = signed_index > 0 ? +1 : -1;
    }
    return places;
}

}  // namespace

std::int64_t metric(const Signature& query,
                    const Signature& target,
                    const Profile& profile,
                    int m) {
    assert(m >= 1 && m <= kMaxCoefficients);
    std::int64_t average_terms = 0;
    std::int64_t coefficient_terms = 0;
    for (int c = 0; c < kChannels; ++c) {
        const auto& weights = profile.weights[c];
        average_terms +=
            std::int64_t{weights[0]} * std::abs(std::int64_t{query.channels[c].average} -
                                                target.channels[c].average);
        const std::vector<int> q = quantized(query.channels[c], m);
        const std::vector<int> t = quantized(target.channels[c], m);
        for (int i = 0; i < kSide; ++i) {
            for (int j = 0; j < kSide; ++j) {
                const int place = i * kSide + j;
                if (q[place] == 0) continue;
                const bool differs = q[place] != t[place];
                coefficient_terms += differs ? weights[bin(profile.bin_rule, i, j)] : 0;
            }
        }
    }
    return average_terms + coefficient_terms * kAverageOne;
}

}  // namespace haarmony::image
