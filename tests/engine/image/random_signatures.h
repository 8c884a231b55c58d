// Signatures that tests make for themselves, and the search that they are compared with.
#pragma once

#include <map>
#include <random>
#include <vector>

#include "engine/image/query.h"
#include "engine/image/signature.h"

namespace haarmony::image {

struct SignatureShape {
    int max_count = kMaxCoefficients;       // of coefficients in a channel
    int max_index = kCoefficientCount - 1;  // the fewer places, the more matches
    int average_steps = 1000;               // the fewer values, the more ties
};

[[nodiscard]] Signature random_signature(std::mt19937& random,
                                         const SignatureShape& shape);

// A collection that is searched with equation (4.3) for every picture and a full sort.
using Reference = std::map<std::int64_t, Signature>;
[[nodiscard]] SearchResult search_literally(const Reference& pictures,
                                            const Signature& query,
                                            const Profile& profile,
                                            int m,
                                            int limit);

}  // namespace haarmony::image
