// The best of several searches: one picture asked for in several ways (turned, mirrored, cut
// out) in several indexes, each match at its smallest distance.
//
//   Queries are compared by equation (4.3), since their scores (4.4) leave out constants
//   that differ.
//
// Order   smaller distance first, ties to the smaller id; of two ways at the same distance
//         the earlier one is reported.
// Errors  none.
// Source  sec. 4.6, "Affine transformation and partial queries".
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/image/index.h"
#include "engine/image/query.h"

namespace haarmony::image {

// One way to ask. Both pointees outlive the search.
struct Way {
    const IndexSnapshot* snapshot = nullptr;
    const Query* query = nullptr;
};

struct BestMatch {
    ImageId id{};
    Score distance = 0;  // full_distance()
    std::size_t way = 0;
    Score score = 0;  // under that way's query

    friend bool operator==(const BestMatch&, const BestMatch&) = default;
};

struct BestResult {
    std::vector<BestMatch> matches;  // best first, each picture once
    std::int64_t searched = 0;       // pictures that the first way was compared with
};

// The scope.limit best pictures, exactly: a picture among them is among the scope.limit
// best of the way at which it is best. Requires: at least one way.
[[nodiscard]] BestResult search_best(std::span<const Way> ways, const SearchScope& scope);

// Every picture at its best, in rising order of id. Requires: at least one way.
[[nodiscard]] std::vector<BestMatch> score_all_best(std::span<const Way> ways,
                                                    const IdSet* only);

}  // namespace haarmony::image
