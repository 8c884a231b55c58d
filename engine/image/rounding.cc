#include "engine/image/rounding.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace haarmony::image {
namespace {

// Sums of rounded weights stay about between these: fine enough that few pictures pass by
// rounding, coarse enough that weights have few one-bits.
constexpr std::int64_t kMostSteps = 1024;
constexpr std::int64_t kFewestSteps = 200;
constexpr std::int64_t kUnitsTried = 16;
// What it costs, in rows added, to lose the whole sum by rounding up.
constexpr double kCostOfRounding = 4000.0;
// No sum of units comes near it.
constexpr std::int64_t kOutOfReach = std::int64_t{1} << 31;

std::int64_t ceil_divide(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

}  // namespace

Rounding::Rounding(const Query& query) {
    std::vector<std::int32_t> weights;
    weights.reserve(query.terms.size());
    std::int64_t sum = 0;
    for (const QueryTerm& term : query.terms) {
        assert(term.weight >= 0);
        if (term.weight == 0) continue;
        weights.push_back(term.weight);
        sum += term.weight;
    }
    std::ranges::sort(weights);
    for (const std::int32_t weight : weights) {
        if (weights_.empty() || weights_.back().weight != weight)
            weights_.push_back({weight, 0, 0});
        ++weights_.back().terms;
    }
    const std::int64_t finest = std::max<std::int64_t>(1, sum / kMostSteps);
    const std::int64_t coarsest = std::max<std::int64_t>(1, sum / kFewestSteps);
    const std::int64_t step =
        std::max<std::int64_t>(1, (coarsest - finest) / kUnitsTried);
    double least = std::numeric_limits<double>::max();
    for (std::int64_t unit = finest; unit <= coarsest; unit += step) {
        const double cost = round_all(unit, double(sum));
        if (cost >= least) continue;
        least = cost;
        unit_ = unit;
    }
    round_all(unit_, double(sum));
}

// Each weight becomes the number of units, with some of its last places cleared by rounding
// up, that costs least; returns what all of them cost.
double Rounding::round_all(std::int64_t unit, double sum) {
    double cost = 0.0;
    for (Weight& weight : weights_) {
        const auto exact = static_cast<std::uint32_t>(ceil_divide(weight.weight, unit));
        double least = std::numeric_limits<double>::max();
        for (int places = 0; exact >> places != 0; ++places) {
            const std::uint32_t below = (1U << places) - 1;
            const std::uint32_t units = (exact + below) & ~below;
            const double lost = double(units * unit - weight.weight) / sum;
            const double its_cost = std::popcount(units) + kCostOfRounding * lost;
            if (its_cost >= least) continue;
            least = its_cost;
            weight.units = units;
        }
        cost += weight.terms * least;
    }
    return cost;
}

std::uint32_t Rounding::units(std::int32_t weight) const {
    const auto found = std::ranges::lower_bound(weights_, weight, {}, &Weight::weight);
    assert(found != weights_.end() && found->weight == weight);
    return found->units;
}

std::uint32_t Rounding::units_for(std::int64_t weight) const {
    if (weight <= 0) return 0;
    return static_cast<std::uint32_t>(std::min(ceil_divide(weight, unit_), kOutOfReach));
}

}  // namespace haarmony::image
