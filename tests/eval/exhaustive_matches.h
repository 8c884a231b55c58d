// The best matches by looking at every picture: the oracle of a speed run. Equation (4.4) in
// integers from the signatures themselves, without an index, sixteen queries at a time.
//
// Scale   scores as in engine/image/query.h; picture i has the id i + 1.
// Errors  none.
// Threads groups of queries in parallel on an Executor.
// Source  sec. 4.2.4.
#pragma once

#include <span>
#include <vector>

#include "engine/core/executor.h"
#include "engine/image/query.h"
#include "tests/eval/packed_signature.h"

namespace haarmony::eval {

// For each query its `limit` best matches, best first, ties to the smaller id.
// Requires: all queries of the same m <= kPackedCoefficients, without a weight of their shape;
// the weights of each add up to less than 2^31. Cost: per picture and sixteen queries 3 m
// additions of sixteen numbers.
[[nodiscard]] std::vector<std::vector<image::Match>> exhaustive_matches(
    std::span<const PackedSignature> signatures,
    std::span<const image::Query> queries,
    int limit,
    Executor& executor);

}  // namespace haarmony::eval
