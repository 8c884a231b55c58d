#include "engine/image/score_kernel.h"

#include <cassert>

namespace haarmony::image {
namespace {

// |a - b| as 32 unsigned bits: with a 32-bit weight the product is the widening
// multiplication that every vector unit has. Averages are below 2^25.
std::uint32_t absolute_difference(std::int32_t a, std::int32_t b) {
    return static_cast<std::uint32_t>(a < b ? b - a : a - b);
}

}  // namespace

void score_slots(const Query& query,
                 const std::array<std::span<const std::int32_t>, kChannels>& averages,
                 std::span<const std::int32_t> matched,
                 std::span<Score> scores) {
    assert(matched.size() == scores.size());
    for (std::size_t i = 0; i < scores.size(); ++i) {
        scores[i] = -(std::int64_t{matched[i]} << kAverageFractionBits);
    }
    for (int c = 0; c < kChannels; ++c) {
        assert(averages[c].size() == scores.size());
        const auto weight = static_cast<std::uint32_t>(query.average_weight[c]);
        const std::int32_t average = query.average[c];
        const std::int32_t* const target = averages[c].data();
        for (std::size_t i = 0; i < scores.size(); ++i) {
            const std::uint64_t term =
                std::uint64_t{weight} * absolute_difference(average, target[i]);
            scores[i] += static_cast<Score>(term);
        }
    }
}

}  // namespace haarmony::image
