// A picture made smaller by the exact area average: each result pixel is the mean of what
// it covers, parts of pixels included (ingest, for thumbnails).
//
// Shape   result of the asked size, 1 or 3 channels; alpha is laid over white.
// Units   averages of sRGB bytes, rounded to nearest.
// Errors  a wrong shape is a caller's bug and asserts.
// Threads const-safe.
#pragma once

#include "engine/core/image_view.h"
#include "ingest/raster.h"

namespace haarmony::ingest {

// Requires: 1 <= width <= picture.width, 1 <= height <= picture.height; 1, 3 or 4 channels.
// Cost: one pass over the pixels.
[[nodiscard]] Raster shrink(const ImageView& picture, int width, int height);

}  // namespace haarmony::ingest
