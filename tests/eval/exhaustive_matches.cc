#include "tests/eval/exhaustive_matches.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "tests/eval/heap_select.h"

namespace haarmony::eval {
namespace {

constexpr std::size_t kLanes = 16;
using Lanes = std::array<std::int32_t, kLanes>;

struct Ranked {
    std::int64_t score = 0;
    std::int64_t id = 0;
    friend auto operator<=>(const Ranked&, const Ranked&) = default;
};

// What each coefficient is worth to each of a group of queries.
std::vector<Lanes> weight_table(std::span<const image::Query> queries) {
    std::vector<Lanes> table(image::kKeyCount);
    for (std::size_t q = 0; q < queries.size(); ++q) {
        assert(queries[q].weight_sum <= std::numeric_limits<std::int32_t>::max());
        for (const image::QueryTerm& term : queries[q].terms)
            table[term.key][q] += term.weight;
    }
    return table;
}

std::int64_t average_terms(const image::Query& query, const PackedSignature& signature) {
    std::int64_t sum = 0;
    for (int c = 0; c < image::kChannels; ++c) {
        sum += query.average_weight[c] *
               std::abs(std::int64_t{query.average[c]} - signature.average[c]);
    }
    return sum;
}

void match_group(std::span<const PackedSignature> signatures,
                 std::span<const image::Query> queries,
                 int limit,
                 std::span<std::vector<image::Match>> matches) {
    const std::vector<Lanes> table = weight_table(queries);
    const int m = queries.front().m;
    std::vector<HeapSelect<Ranked>> best(queries.size(),
                                         HeapSelect<Ranked>(std::size_t(limit)));
    for (std::size_t i = 0; i < signatures.size(); ++i) {
        Lanes matched{};
        for (int c = 0; c < image::kChannels; ++c) {
            for (const std::int16_t index : signatures[i].largest(c, m)) {
                const Lanes& weights = table[image::coefficient_key(c, index)];
                for (std::size_t q = 0; q < kLanes; ++q) matched[q] += weights[q];
            }
        }
        for (std::size_t q = 0; q < queries.size(); ++q) {
            const std::int64_t score = average_terms(queries[q], signatures[i]) -
                                       matched[q] * image::kAverageOne;
            best[q].offer({score, static_cast<std::int64_t>(i) + 1});
        }
    }
    for (std::size_t q = 0; q < queries.size(); ++q) {
        for (const Ranked& ranked : best[q].take())
            matches[q].push_back({ImageId{ranked.id}, ranked.score});
    }
}

}  // namespace

std::vector<std::vector<image::Match>> exhaustive_matches(
    std::span<const PackedSignature> signatures,
    std::span<const image::Query> queries,
    int limit,
    Executor& executor) {
    assert(std::ranges::all_of(queries, [&](const image::Query& query) {
        return query.m == queries.front().m && query.m <= kPackedCoefficients &&
               query.aspect_weight == 0;
    }));
    std::vector<std::vector<image::Match>> matches(queries.size());
    executor.parallel_for((queries.size() + kLanes - 1) / kLanes, [&](std::size_t group) {
        const std::size_t first = group * kLanes;
        const std::size_t count = std::min(kLanes, queries.size() - first);
        match_group(signatures,
                    queries.subspan(first, count),
                    limit,
                    std::span(matches).subspan(first, count));
    });
    return matches;
}

}  // namespace haarmony::eval
