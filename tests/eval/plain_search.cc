#include "tests/eval/plain_search.h"

#include <cassert>
#include <cmath>
#include <cstddef>

#include "tests/eval/heap_select.h"

namespace haarmony::eval {
namespace {

constexpr float kWeightUnit = 100.0F;

float average_of(std::int32_t fixed_point) {
    return static_cast<float>(fixed_point) / static_cast<float>(image::kAverageOne);
}

template <typename Visit>
void for_each_posting(std::span<const PackedSignature> signatures,
                      int m,
                      const Visit& visit) {
    for (std::size_t i = 0; i < signatures.size(); ++i) {
        for (int c = 0; c < image::kChannels; ++c) {
            for (const std::int16_t index : signatures[i].largest(c, m))
                visit(image::coefficient_key(c, index), static_cast<std::uint32_t>(i));
        }
    }
}

}  // namespace

PlainQuery plain_query(const image::Query& query) {
    PlainQuery plain;
    for (int c = 0; c < image::kChannels; ++c) {
        plain.average[c] = average_of(query.average[c]);
        plain.average_weight[c] =
            static_cast<float>(query.average_weight[c]) / kWeightUnit;
    }
    for (const image::QueryTerm& term : query.terms)
        plain.terms.push_back({term.key, static_cast<float>(term.weight) / kWeightUnit});
    return plain;
}

PlainSearch::PlainSearch(std::span<const PackedSignature> signatures, int m)
    : lists_(image::kKeyCount), scores_(signatures.size()) {
    assert(m >= 1 && m <= kPackedCoefficients);
    for (int c = 0; c < image::kChannels; ++c) {
        averages_[c].reserve(signatures.size());
        for (const PackedSignature& signature : signatures)
            averages_[c].push_back(average_of(signature.average[c]));
    }
    std::vector<std::size_t> lengths(image::kKeyCount, 0);
    for_each_posting(
        signatures, m, [&](std::uint32_t key, std::uint32_t) { ++lengths[key]; });
    for (std::size_t key = 0; key < lists_.size(); ++key)
        lists_[key].reserve(lengths[key]);
    for_each_posting(signatures, m, [&](std::uint32_t key, std::uint32_t picture) {
        lists_[key].push_back(picture);
    });
}

std::span<const float> PlainSearch::score(const PlainQuery& query) {
    std::ranges::fill(scores_, 0.0F);
    for (int c = 0; c < image::kChannels; ++c) {
        const float weight = query.average_weight[c];
        const float average = query.average[c];
        const float* const averages = averages_[c].data();
        float* const scores = scores_.data();
        for (std::size_t i = 0; i < scores_.size(); ++i)
            scores[i] += weight * std::fabs(average - averages[i]);
    }
    for (const PlainTerm& term : query.terms) {
        float* const scores = scores_.data();
        for (const std::uint32_t picture : lists_[term.key])
            scores[picture] -= term.weight;
    }
    return scores_;
}

std::vector<PlainMatch> PlainSearch::search(const PlainQuery& query, int limit) {
    assert(limit >= 0);
    const std::span<const float> scores = score(query);
    HeapSelect<PlainMatch> best(static_cast<std::size_t>(limit));
    for (std::size_t i = 0; i < scores.size(); ++i)
        best.offer({scores[i], static_cast<std::uint32_t>(i)});
    return best.take();
}

std::int64_t PlainSearch::bytes() const {
    std::size_t bytes = lists_.size() * sizeof(lists_.front());
    for (const auto& list : lists_) bytes += list.capacity() * sizeof(std::uint32_t);
    return static_cast<std::int64_t>(bytes + scores_.size() * (1 + image::kChannels) *
                                                 sizeof(float));
}

}  // namespace haarmony::eval
