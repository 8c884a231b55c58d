// Signatures that tests make for themselves, and the search that they are compared with.
#pragma once

#include <map>
#include <optional>
#include <random>
#include <set>
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
struct Target {
    Signature signature;
    std::int32_t log_aspect = 0;
};
using Reference = std::map<std::int64_t, Target>;

// What is asked for beside the signature.
struct Wanted {
    int limit = 1000;
    std::int32_t log_aspect = 0;
    std::int32_t aspect_weight = 0;
    std::optional<std::set<std::int64_t>> only = {};
};
[[nodiscard]] SearchResult search_literally(const Reference& pictures,
                                            const Signature& query,
                                            const Profile& profile,
                                            int m,
                                            const Wanted& wanted);

}  // namespace haarmony::image
