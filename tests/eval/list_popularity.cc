#include "tests/eval/list_popularity.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "engine/image/query.h"
#include "tests/eval/quantile.h"

namespace haarmony::eval {
namespace {

constexpr double kPopular = 0.01;

}  // namespace

ListLengths::ListLengths(std::span<const PackedSignature> signatures, int m)
    : m_(m),
      pictures_(static_cast<double>(signatures.size())),
      lengths_(image::kKeyCount, 0) {
    assert(!signatures.empty() && m >= 1 && m <= kPackedCoefficients);
    for (const PackedSignature& signature : signatures) {
        for (int c = 0; c < image::kChannels; ++c) {
            for (const std::int16_t index : signature.largest(c, m))
                ++lengths_[image::coefficient_key(c, index)];
        }
    }
}

ListPopularity ListLengths::read_by(std::span<const PackedSignature> queries) const {
    assert(!queries.empty());
    ListPopularity popularity;
    popularity.m = m_;
    double postings = 0;
    double popular_postings = 0;
    for (const std::int64_t length : lengths_) {
        const auto postings_here = static_cast<double>(length);
        postings += postings_here;
        popularity.non_empty_lists += length > 0 ? 1 : 0;
        if (postings_here > kPopular * pictures_) {
            ++popularity.popular_lists;
            popular_postings += postings_here;
        }
    }
    if (postings > 0) popularity.popular_share = popular_postings / postings;

    std::vector<double> densities;
    double sum = 0;
    for (const PackedSignature& query : queries) {
        for (int c = 0; c < image::kChannels; ++c) {
            for (const std::int16_t index : query.largest(c, m_)) {
                const auto length =
                    static_cast<double>(lengths_[image::coefficient_key(c, index)]);
                densities.push_back(length / pictures_);
                sum += densities.back();
            }
        }
    }
    if (densities.empty()) return popularity;
    popularity.hits_per_picture = sum / static_cast<double>(queries.size());
    popularity.median_density = quantile(densities, 0.5);
    popularity.p90_density = quantile(densities, 0.9);
    popularity.largest_density = std::ranges::max(densities);
    return popularity;
}

}  // namespace haarmony::eval
