#include "tests/eval/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "ingest/gallery/random.h"

namespace haarmony::eval {
namespace {

constexpr double kNormal975 = 1.959963984540054;  // the 97.5 % point of the normal curve
constexpr int kResamples = 1000;
constexpr std::uint64_t kBootstrapSeed = 1927;

}  // namespace

Interval wilson(std::int64_t successes, std::int64_t trials) {
    assert(trials >= 1 && successes >= 0 && successes <= trials);
    const double n = static_cast<double>(trials);
    const double p = static_cast<double>(successes) / n;
    const double z2 = kNormal975 * kNormal975;
    const double centre = (p + z2 / (2 * n)) / (1 + z2 / n);
    const double half =
        kNormal975 / (1 + z2 / n) * std::sqrt(p * (1 - p) / n + z2 / (4 * n * n));
    // At the ends the formula gives 0 and 1 but for rounding.
    return {successes == 0 ? 0 : centre - half, successes == trials ? 1 : centre + half};
}

Interval bootstrap(std::span<const double> values,
                   const std::function<double(std::span<const double>)>& statistic,
                   int resamples,
                   std::uint64_t seed) {
    assert(!values.empty() && resamples >= 1);
    gallery::Random random(seed);
    std::vector<double> drawn(values.size());
    std::vector<double> results;
    results.reserve(resamples);
    for (int i = 0; i < resamples; ++i) {
        for (double& value : drawn)
            value = values[random.below(static_cast<int>(values.size()))];
        results.push_back(statistic(drawn));
    }
    std::ranges::sort(results);
    const auto percentile = [&](double share) {
        return results[static_cast<std::size_t>(std::lround(share * (resamples - 1)))];
    };
    return {percentile(0.025), percentile(0.975)};
}

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) /
           static_cast<double>(values.size());
}

std::int64_t top_count(double share, std::int64_t pictures) {
    // 0.01 * 1100 is 11.000000000000002 or 10.999999999999998, depending on the share.
    const double exact = share * static_cast<double>(pictures);
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(exact + 1e-9)));
}

Rate within(std::span<const std::int64_t> ranks, std::int64_t limit) {
    return {std::ranges::count_if(ranks, [=](auto rank) { return rank <= limit; }),
            static_cast<std::int64_t>(ranks.size())};
}

RankSummary summarize(std::span<const std::int64_t> ranks, std::int64_t pictures) {
    assert(!ranks.empty());
    RankSummary summary;
    summary.pictures = pictures;
    summary.first = within(ranks, 1);
    summary.top_20 = within(ranks, 20);
    summary.top_1_percent = within(ranks, top_count(0.01, pictures));
    std::vector<double> reciprocals;
    for (const std::int64_t rank : ranks)
        reciprocals.push_back(1.0 / static_cast<double>(rank));
    summary.mean_reciprocal = mean(reciprocals);
    summary.mean_reciprocal_interval =
        bootstrap(reciprocals, mean, kResamples, kBootstrapSeed);
    std::vector<std::int64_t> sorted(ranks.begin(), ranks.end());
    std::ranges::sort(sorted);
    summary.median = sorted[(sorted.size() - 1) / 2];
    return summary;
}

}  // namespace haarmony::eval
