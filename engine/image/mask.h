// What is not painted does not count (image search, beside steps 0 to 3 of 5):
//   resample.h -> color_space.h -> haar.h -> truncation.h -> signature.h
//       |  extend_painted()           | weigh_by_cover()   | kept_coefficients()
//       +---- cover -> [mask.h] ------+--------------------+
//
// The same three rules for queries and at ingest, so that a picture with alpha finds itself
// at distance 0: the painted colours are continued smoothly over what is not painted;
// coefficients are ranked by magnitude times the painted share of their support; and the
// less is painted, the fewer are kept.
//
// Shape   planes and cover are kSide x kSide, row-major.
// Units   cover is in [0, 1]: how opaque a cell is, the most opaque one being 1.
// Errors  none.
// Source  sec. 4.6, "partial queries". What else was tried: engine/image/MASK.md.
#pragma once

#include "engine/image/color_planes.h"

namespace haarmony::image {

// Mixes into each cell, by the share of it that is not painted, the colours around it: of
// its 2 x 2 block, where nothing is painted there of the 4 x 4 block, and so on (push-pull).
// A picture of one colour stays that colour exactly; a cell of cover 1 is not changed.
// Requires: some cover is above 0. Cost: linear; 0.6 MB while it runs.
void extend_painted(const Plane& cover, ColorPlanes& rgb);

// Multiplies each wavelet coefficient by the mean cover of its support; (0, 0), the average
// colour, stays. Cost: linear.
void weigh_by_cover(const Plane& cover, Decomposition decomposition, Plane& coefficients);

// How many coefficients of a channel are kept: kMaxCoefficients times p / (p + c (1 - p))
// rounded up, p the painted share of the picture and c kUnpaintedCost, as if each unpainted
// cell spoke against as many coefficients as c painted ones speak for; at least
// kFewestCoefficients, with which a painting begins; none where nothing is painted.
inline constexpr double kUnpaintedCost = 4;
inline constexpr int kFewestCoefficients = 5;
[[nodiscard]] int kept_coefficients(const Plane& cover);

}  // namespace haarmony::image
