// Figure 4.2 as it is printed: the baseline of every claim of speed.
//
// Six arrays of lists with 32-bit numbers of pictures, float scores and weights: for each
// channel the differences of the averages, then one pass over the list of each coefficient of
// the query, then Heap-Select.
//
// Shape   made for one m, as the dissertation's arrays are. Picture i is the i-th signature.
// Scale   scores in the weights' unit (sec. 4.2.4); sums are rounded, so that equal pictures
//         are ties only as far as floats tell.
// Errors  none.
// Threads one search at a time: the array of scores is kept between searches.
// Source  sec. 4.3.2, Figure 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/query.h"
#include "tests/eval/packed_signature.h"

namespace haarmony::eval {

struct PlainMatch {
    float score = 0;
    std::uint32_t picture = 0;
    friend auto operator<=>(const PlainMatch&, const PlainMatch&) = default;
};

struct PlainTerm {
    std::uint32_t key = 0;  // coefficient_key(): which of the six arrays, and which list
    float weight = 0;
};

struct PlainQuery {
    std::array<float, image::kChannels> average{};
    std::array<float, image::kChannels> average_weight{};
    std::vector<PlainTerm> terms;
};

[[nodiscard]] PlainQuery plain_query(const image::Query& query);

class PlainSearch {
  public:
    // Requires: 1 <= m <= kPackedCoefficients; fewer than 2^32 signatures.
    PlainSearch(std::span<const PackedSignature> signatures, int m);

    // Figure 4.2's scores of all pictures; valid until the next call.
    [[nodiscard]] std::span<const float> score(const PlainQuery& query);
    // The `limit` best, best first, ties to the smaller number. Requires: limit >= 0.
    [[nodiscard]] std::vector<PlainMatch> search(const PlainQuery& query, int limit);

    // Of lists, averages and scores, without what an allocator adds.
    [[nodiscard]] std::int64_t bytes() const;

  private:
    std::array<std::vector<float>, image::kChannels> averages_;
    std::vector<std::vector<std::uint32_t>> lists_;  // by coefficient_key()
    std::vector<float> scores_;
};

}  // namespace haarmony::eval
