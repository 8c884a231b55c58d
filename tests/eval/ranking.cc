#include "tests/eval/ranking.h"

#include <algorithm>
#include <cassert>

namespace haarmony::eval {

std::int64_t rank_of(std::span<const std::uint64_t> distances, std::size_t target) {
    assert(target < distances.size());
    const std::uint64_t own = distances[target];
    std::int64_t rank = 1;
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (distances[i] < own || (distances[i] == own && i < target)) ++rank;
    }
    return rank;
}

std::int64_t rank_in(const std::vector<image::Match>& matches, std::size_t target) {
    const auto found = std::ranges::find(matches, id_of(target), &image::Match::id);
    return found - matches.begin() + 1;
}

std::int64_t rival_rank(Rival rival,
                        const Database& database,
                        const RivalFeatures& query,
                        std::size_t target) {
    std::vector<std::uint64_t> distances;
    distances.reserve(database.rivals.size());
    for (const RivalFeatures& picture : database.rivals) {
        distances.push_back(distance(rival, query, picture));
    }
    return rank_of(distances, target);
}

WaveletSearch::WaveletSearch(const Database& database, const image::SignatureKind& kind)
    : kind_(kind),
      pictures_(static_cast<int>(database.size())),
      index_(make_index(database.signatures.at(kind))),
      snapshot_(index_->snapshot()) {}

std::vector<image::Match> WaveletSearch::order(const image::Signature& query,
                                               const image::Profile& profile) const {
    assert(profile.kind == kind_);
    return snapshot_->search(image::make_query(query, profile, profile.m), {pictures_})
        .matches;
}

std::int64_t WaveletSearch::rank(const image::Signature& query,
                                 const image::Profile& profile,
                                 std::size_t target) const {
    return rank_in(order(query, profile), target);
}

MetricName wavelet_name(const image::Profile& profile) {
    return {"L^q", "m=" + std::to_string(profile.m)};
}

MetricPanel::MetricPanel(const Database& database)
    : database_(database),
      search_(database, image::SignatureKind{}),
      profiles_(
          {*image::built_in_profile("scanned"), *image::built_in_profile("painted")}) {
    for (const image::Profile& profile : profiles_)
        columns_.push_back({wavelet_name(profile), profile.name});
    for (const Rival rival : kRivals) columns_.push_back({rival_name(rival), ""});
}

std::vector<std::int64_t> MetricPanel::ranks(const ImageView& query,
                                             std::size_t target) const {
    std::vector<std::int64_t> ranks;
    const image::Signature signature = image::make_signature(query);
    for (const image::Profile& profile : profiles_) {
        ranks.push_back(search_.rank(signature, profile, target));
    }
    const RivalFeatures features = describe_rivals(query);
    for (const Rival rival : kRivals) {
        ranks.push_back(rival_rank(rival, database_, features, target));
    }
    return ranks;
}

}  // namespace haarmony::eval
