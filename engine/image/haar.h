// Haar decomposition of one square image channel (image search, step 2 of 5):
//   resample.h -> color_space.h -> [haar.h] -> truncation.h -> signature.h
//
// *Standard*: every row to the end, then every column; rectangular basis functions.
// *Non-standard*: one step of every row, one of every column, then the same with the quarter
// of means; square basis functions.
//
// Shape   row-major, side x side, side a power of two in [1, kMaxSide]. In both, what has
//         max(row, column) in [2^k, 2^(k+1)) is of level k in its finer direction.
// Units   coefficients carry the channel's own unit; coefficient (0, 0) is the channel's mean.
// Scale   orthonormal basis up to the factor 1/side, so that the squares of all coefficients
//         add up to the mean square of the channel.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
// Source  sec. 4.3.1, Figure 4.1, DecomposeArray and DecomposeImage; sec. 4.2.2, item 3.
#pragma once

#include <span>

#include "engine/image/signature_kind.h"

namespace haarmony::image {

inline constexpr int kMaxSide = 128;

// Replaces the channel by its coefficients. The non-standard ones of a mirrored, turned or
// transposed channel are the same numbers, exactly; so are the standard ones of a mirrored
// channel, while a transposed one may differ by roundings.
// Requires: plane.size() == side * side. Cost: linear in it, without allocation.
void decompose(std::span<float> plane, int side, Decomposition decomposition);

}  // namespace haarmony::image
