// Keeping only the signs and places of the largest coefficients (image search, part of
// step 3 of 5):
//   resample.h -> color_space.h -> haar.h -> [truncation.h] -> signature.h
//
// Shape   kSide x kSide coefficients, row-major; (0, 0) is the mean and no candidate.
// Errors  none.
// Source  sec. 4.2.2, items 4 and 5; zeros and ties: ARCHITECTURE.md ("Errata").
#pragma once

#include "engine/image/color_planes.h"
#include "engine/image/signature.h"

namespace haarmony::image {

// The kMaxCoefficients largest coefficients in falling order of magnitude, ties by smaller
// index, zeros left out; and the average. Requires: no coefficient is NaN.
[[nodiscard]] ChannelSignature truncate(const Plane& coefficients);

// The sum of the squares of all wavelet coefficients: the variance of the channel.
[[nodiscard]] double wavelet_energy(const Plane& coefficients);

}  // namespace haarmony::image
