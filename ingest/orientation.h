// The EXIF orientation of a picture: how the camera was held, and the turn that undoes it
// (ingest, step 2, after the pixels are decoded): jpeg or oiio -> [orientation] -> Picture.
//
// Shape   1..8; 1 = upright. 5..8 swap width and height.
// Errors  no block, a damaged one or a value beyond 8 is 1: a bad tag hides no picture.
// Threads const-safe.
// Source  EXIF 2.3, section 4.6.4, tag 0x0112; PNG 3rd edition, eXIf; WebP container, EXIF.
#pragma once

#include <cstdint>
#include <span>

#include "ingest/raster.h"
#include "ingest/sniff.h"

namespace haarmony::ingest {

// What the bytes say. HEIF and AVIF are always 1: their turns belong to the container, and
// the decoder has applied them.
[[nodiscard]] int exif_orientation(Format format, std::span<const std::uint8_t> bytes);

// The picture upright. Requires: orientation in 1..8. Cost: one pass over the pixels,
// nothing for 1.
[[nodiscard]] Raster upright(Raster raster, int orientation);

}  // namespace haarmony::ingest
