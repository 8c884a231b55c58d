// Haar decomposition of one square image channel (image search, step 2 of 5):
//   resample.h -> color_space.h -> [haar.h] -> truncation.h -> signature.h
//
// The *standard* decomposition: every row to the end, then every column.
//
// Shape   row-major, side x side, side a power of two in [1, kMaxSide].
// Units   coefficients carry the channel's own unit; coefficient (0, 0) is the channel's mean.
// Scale   orthonormal basis up to the factor 1/side, so that the squares of all coefficients
//         add up to the mean square of the channel.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
// Source  sec. 4.3.1, Figure 4.1, DecomposeArray and DecomposeImage.
#pragma once

#include <span>

namespace haarmony::image {

inline constexpr int kMaxSide = 128;

// Replaces the channel by its coefficients.
// Requires: plane.size() == side * side. Cost: linear in it, without allocation.
void decompose(std::span<float> plane, int side);

}  // namespace haarmony::image
