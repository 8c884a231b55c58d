// Equation (4.3) between two signatures, term by term: the oracle of the whole search.
//
// Scale   100 * 2^24 times the equation: an exact integer, as a Score, but with the terms
//         that (4.4) leaves out.
// Errors  none; m out of range is a caller's bug and asserts.
// Source  sec. 4.2.3, equation (4.3), with the absolute value of Figure 4.2 and weights
//         that depend on the channel.
#pragma once

#include <cstdint>

#include "engine/image/profile.h"
#include "engine/image/signature.h"

namespace haarmony::image {

// ||Q, T|| with both cut to their m largest coefficients.
// Requires: 1 <= m <= kMaxCoefficients. Cost: all kCoefficientCount places of each channel.
[[nodiscard]] std::int64_t metric(const Signature& query,
                                  const Signature& target,
                                  const Profile& profile,
                                  int m);

}  // namespace haarmony::image
