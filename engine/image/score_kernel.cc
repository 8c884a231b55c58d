#include "engine/image/score_kernel.h"

#include <cassert>

namespace haarmony::image {
namespace {

// |a - b| as 32 unsigned bits: with a 32-bit weight the product is the widening
// multiplication that every vector unit has. Averages are below 2^26, logarithms of aspect
// ratios below 2^28.
std::uint32_t absolute_difference(std::int32_t a, std::int32_t b) {
    return static_cast<std::uint32_t>(a < b ? b - a : a - b);
}

void add_term(std::int32_t weight,
              std::int32_t query,
              std::span<const std::int32_t> targets,
              std::span<Score> scores) {
    if (weight == 0) return;
    assert(targets.size() == scores.size());
    const auto factor = static_cast<std::uint32_t>(weight);
    const std::int32_t* const target = targets.data();
    for (std::size_t i = 0; i < scores.size(); ++i) {
        const std::uint64_t term =
            std::uint64_t{factor} * absolute_difference(query, target[i]);
        scores[i] += static_cast<Score>(term);
    }
}

}  // namespace

void score_slots(const Query& query,
                 const SlotColumns& columns,
                 std::span<const std::int32_t> matched,
                 std::span<Score> scores) {
    assert(matched.size() == scores.size());
    for (std::size_t i = 0; i < scores.size(); ++i) {
        scores[i] = -(std::int64_t{matched[i]} << kAverageFractionBits);
    }
    for (int c = 0; c < kChannels; ++c) {
        add_term(query.average_weight[c], query.average[c], columns.averages[c], scores);
    }
    add_term(query.aspect_weight, query.log_aspect, columns.log_aspects, scores);
}

}  // namespace haarmony::image
