// A picture of any size as 128 x 128 average colours (image search, step 0 of 5):
//   [resample.h] -> mask.h -> color_space.h -> haar.h -> truncation.h -> signature.h
//
// Each cell is the mean of the picture over its own rectangle, pixels that it only touches
// counted by the share it covers; a picture smaller than the grid is repeated the same way.
//
// Units   R, G, B in [0, 1].
// Scale   sums are exact integers with one rounding at the end: a flat picture of any size
//         gives equal cells, R = G = B gives equal planes, and an opaque RGBA picture gives
//         the planes of the same RGB picture, bit for bit.
// Errors  none at run time; a wrong shape is a caller's bug and asserts.
// Source  sec. 4.3.1 takes 128 x 128 pictures as given; what is transparent: mask.h.
#pragma once

#include <memory>

#include "engine/core/image_view.h"
#include "engine/image/color_planes.h"

namespace haarmony::image {

inline constexpr int kMaxPictureSide = 65535;

// Fills `rgb` and returns the cover of the cells for mask.h; nothing where all cells are
// equally opaque, which counts as painted in full, be it a veil. A cell's colour is the mean
// of what is painted in it, weighed by alpha; what is not painted is filled by
// extend_painted(). A picture with nothing painted is black, its cover 0.
// Requires: 1 <= width, height <= kMaxPictureSide; 1, 3 or 4 channels.
// Cost: one pass over the rows (a row on the border of two bands counts twice), and
// 4 bytes of working storage per sample of one row.
std::unique_ptr<Plane> area_average(const ImageView& picture, ColorPlanes& rgb);

}  // namespace haarmony::image
