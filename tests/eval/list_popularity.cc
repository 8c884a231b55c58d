#include "tests/eval/list_popularity.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <vector>

#include "engine/image/query.h"
#include "tests/eval/quantile.h"

namespace haarmony::eval {

ListPopularity list_popularity(std::span<const PackedSignature> signatures,
                               std::span<const PackedSignature> queries,
                               int m) {
    assert(!signatures.empty() && !queries.empty());
    assert(m >= 1 && m <= kPackedCoefficients);
    std::vector<std::int64_t> lengths(image::kKeyCount, 0);
    std::int64_t postings = 0;
    for (const PackedSignature& signature : signatures) {
        for (int c = 0; c < image::kChannels; ++c) {
            for (const std::int16_t index : signature.largest(c, m)) {
                ++lengths[image::coefficient_key(c, index)];
                ++postings;
            }
        }
    }
    const auto pictures = static_cast<double>(signatures.size());
    ListPopularity popularity;
    popularity.m = m;
    std::int64_t popular_postings = 0;
    for (const std::int64_t length : lengths) {
        popularity.non_empty_lists += length > 0 ? 1 : 0;
        if (static_cast<double>(length) > 0.01 * pictures) {
            ++popularity.popular_lists;
            popular_postings += length;
        }
    }
    if (postings > 0) {
        popularity.popular_share =
            static_cast<double>(popular_postings) / static_cast<double>(postings);
    }
    std::vector<double> densities;
    for (const PackedSignature& query : queries) {
        for (int c = 0; c < image::kChannels; ++c) {
            for (const std::int16_t index : query.largest(c, m)) {
                const std::int64_t length = lengths[image::coefficient_key(c, index)];
                densities.push_back(static_cast<double>(length) / pictures);
            }
        }
    }
    if (densities.empty()) return popularity;
    double sum = 0;
    for (const double density : densities) sum += density;
    popularity.hits_per_picture = sum / static_cast<double>(queries.size());
    popularity.median_density = quantile(densities, 0.5);
    popularity.p90_density = quantile(densities, 0.9);
    popularity.largest_density = std::ranges::max(densities);
    return popularity;
}

}  // namespace haarmony::eval
