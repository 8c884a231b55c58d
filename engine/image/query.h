// A question to the index, and its answer (image search, step 5 of 5):
//   color_space.h -> haar.h -> signature.h -> segment_layout.h -> [query.h]
//
// Scale   a score is equation (4.4) times 100 * 2^24, an exact integer; smaller is better,
//         ties go to the smaller id. distance() adds the constant that makes it (4.3).
// Units   distance in the weights' unit; similarity in [0, 1].
// Source  sec. 4.2.4, 4.3.2.
#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "engine/core/ids.h"
#include "engine/image/profile.h"
#include "engine/image/signature.h"

namespace haarmony::image {

using Score = std::int64_t;

// (channel * 2 + negative) * kCoefficientCount + index: the list that a signed index of a
// channel reads or is put into.
inline constexpr int kKeyCount = 2 * kChannels * kCoefficientCount;
[[nodiscard]] constexpr std::uint32_t coefficient_key(int channel, int signed_index) {
    const bool negative = signed_index < 0;
    const int index = negative ? -signed_index : signed_index;
    return static_cast<std::uint32_t>(
        (channel * 2 + (negative ? 1 : 0)) * kCoefficientCount + index);
}

// One coefficient of the query: which search array and list it reads, and what a match
// is worth.
struct QueryTerm {
    std::uint32_t key = 0;    // see coefficient_key()
    std::int32_t weight = 0;  // in 1/100
};

struct Query {
    std::array<std::int32_t, kChannels> average{};         // fixed point, as in Signature
    std::array<std::int32_t, kChannels> average_weight{};  // w0 in 1/100
    std::int32_t log_aspect = 0;                           // see aspect.h
    std::int32_t aspect_weight = 0;                        // in 1/100
    std::vector<QueryTerm> terms;
    std::int64_t weight_sum = 0;  // of the terms, in 1/100
    int m = 0;                    // query and target are both cut to their m largest
};

// The query that a signature and a profile of its kind make, both cut at m; the shape of the
// picture has no weight. Requires: 1 <= m <= 100.
[[nodiscard]] Query make_query(const Signature& signature, const Profile& profile, int m);

// Equation (4.4) of one target, and the term of its shape; what the search arrays compute
// for all of them at once. `matched_weight` is the sum of the weights of the terms that the
// target has.
[[nodiscard]] inline Score score(
    const Query& query,
    const std::array<std::int32_t, kChannels>& target_average,
    std::int32_t target_log_aspect,
    std::int64_t matched_weight) {
    Score total = -matched_weight * kAverageOne;
    total += query.aspect_weight *
             std::abs(std::int64_t{query.log_aspect} - target_log_aspect);
    for (int c = 0; c < kChannels; ++c) {
        total += query.average_weight[c] *
                 std::abs(std::int64_t{query.average[c]} - target_average[c]);
    }
    return total;
}

// Equation (4.3) of a score, in units of a score: an exact integer, and comparable between
// queries, which scores are not.
[[nodiscard]] Score full_distance(const Query& query, Score score);
// The same in the weights' unit.
[[nodiscard]] double distance(const Query& query, Score score);
// 1 - distance / sum of the weights of the query's coefficients, clipped to [0, 1]; for a
// query without coefficients 1 where the distance is 0, else 0.
[[nodiscard]] double similarity(const Query& query, Score score);

struct Match {
    ImageId id{};
    Score score = 0;
    friend bool operator==(const Match&, const Match&) = default;
};

// The order of ranks: smaller score first, ties to the smaller id.
[[nodiscard]] constexpr bool better(const Match& a, const Match& b) {
    return a.score != b.score ? a.score < b.score : a.id < b.id;
}

// What a search had to look at.
struct SearchEffort {
    std::int64_t blocks = 0;          // of 256 pictures, in sealed segments
    std::int64_t blocks_visited = 0;  // whose rows were added up
    std::int64_t rows = 0;            // of 256 bits that were read
    std::int64_t compared = 0;        // pictures whose score was computed exactly

    SearchEffort& operator+=(const SearchEffort& other);
};

struct SearchResult {
    std::vector<Match> matches;  // best first
    std::int64_t searched = 0;   // live pictures among which these are the best
    SearchEffort effort = {};
};

}  // namespace haarmony::image
