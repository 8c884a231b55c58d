#include "engine/image/symmetric_metric.h"

#include <algorithm>
#include <cassert>

#include "engine/image/score_kernel.h"

namespace haarmony::image {
namespace {

// Both directions of equation (4.4). The weight of a place does not depend on the
// direction, so that one walk over what both have serves both.
struct BothWays {
    Query from_a;
    Query from_b;
    Score score = 0;
};

BothWays compare(const Signature& a, const Signature& b, const Profile& profile, int m) {
    BothWays both{make_query(a, profile, m), make_query(b, profile, m)};
    std::ranges::sort(both.from_a.terms, {}, &QueryTerm::key);
    std::ranges::sort(both.from_b.terms, {}, &QueryTerm::key);
    std::int64_t matched_weight = 0;
    auto other = both.from_b.terms.begin();
    for (const QueryTerm& term : both.from_a.terms) {
        while (other != both.from_b.terms.end() && other->key < term.key) ++other;
        if (other == both.from_b.terms.end()) break;
        if (other->key == term.key) matched_weight += term.weight;
    }
    both.score = score(both.from_a, both.from_b.average, 0, matched_weight);
    return both;
}

std::int64_t symmetric(Score score, std::int64_t weights_a, std::int64_t weights_b) {
    return 2 * score + (weights_a + weights_b) * kAverageOne;
}

std::int64_t relative(std::int64_t distance, std::int64_t weights) {
    if (weights == 0) return distance == 0 ? 0 : kMaxRelativeDistance;
    return std::min(distance / weights, kMaxRelativeDistance);
}

}  // namespace

std::int64_t symmetric_distance(const Signature& a,
                                const Signature& b,
                                const Profile& profile,
                                int m) {
    const BothWays both = compare(a, b, profile, m);
    return symmetric(both.score, both.from_a.weight_sum, both.from_b.weight_sum);
}

std::int64_t relative_distance(const Signature& a,
                               const Signature& b,
                               const Profile& profile,
                               int m) {
    const BothWays both = compare(a, b, profile, m);
    const std::int64_t weights_a = both.from_a.weight_sum;
    const std::int64_t weights_b = both.from_b.weight_sum;
    return relative(symmetric(both.score, weights_a, weights_b), weights_a + weights_b);
}

double mutual_similarity(const Signature& a,
                         const Signature& b,
                         const Profile& profile,
                         int m) {
    const BothWays both = compare(a, b, profile, m);
    return std::min(similarity(both.from_a, both.score),
                    similarity(both.from_b, both.score));
}

SignatureBlock::SignatureBlock(std::span<const Signature* const> signatures,
                               const Profile& profile)
    : m_(profile.m), arrays_(profile.m, [&](const auto& sink) {
          for (std::size_t slot = 0; slot < signatures.size(); ++slot) {
              for (int c = 0; c < kChannels; ++c) {
                  int rank = 0;
                  for (const std::int16_t signed_index :
                       signatures[slot]->channels[c].largest(profile.m)) {
                      sink(Posting{coefficient_key(c, signed_index), int(slot), rank++});
                  }
              }
          }
      }) {
    assert(signatures.size() <= std::size_t{kMaxSlots});
    for (const Signature* signature : signatures) {
        for (int c = 0; c < kChannels; ++c) {
            averages_[c].push_back(signature->channels[c].average);
        }
        weight_sums_.push_back(make_query(*signature, profile, m_).weight_sum);
    }
}

void SignatureBlock::score(const Query& query, std::span<Score> scores) const {
    assert(query.m == m_ && scores.size() == weight_sums_.size());
    std::vector<std::int32_t> matched(scores.size(), 0);
    arrays_.add_matches(query, matched);
    score_slots(query, {{averages_[0], averages_[1], averages_[2]}, {}}, matched, scores);
}

void SignatureBlock::symmetric_distances(const Query& query,
                                         std::span<std::int64_t> distances) const {
    score(query, distances);
    for (std::size_t slot = 0; slot < distances.size(); ++slot) {
        distances[slot] =
            symmetric(distances[slot], query.weight_sum, weight_sums_[slot]);
    }
}

void SignatureBlock::relative_distances(const Query& query,
                                        std::span<std::int64_t> distances) const {
    symmetric_distances(query, distances);
    for (std::size_t slot = 0; slot < distances.size(); ++slot) {
        distances[slot] =
            relative(distances[slot], query.weight_sum + weight_sums_[slot]);
    }
}

}  // namespace haarmony::image
