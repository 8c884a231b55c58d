// WebP pixels with libwebp (ingest, step 2, in the child): sniff -> dimensions -> [webp] -> orientation.
//
// OpenImageIO 2.4 reads WebP too, but multiplies by alpha through an 8-bit power curve and
// back: in a file with an alpha channel, even an opaque grey of 9 comes out black.
//
// Shape   3 channels, or 4 where the file has alpha. Of an animation the first frame, in
//         its place on the canvas.
// Units   sRGB bytes, straight alpha.
// Errors  kUndecodable.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "ingest/raster.h"

namespace haarmony::ingest {

// Requires: the dimensions were checked (dimensions.h); a canvas has no other limit.
[[nodiscard]] Result<Raster> decode_webp(std::span<const std::uint8_t> bytes);

}  // namespace haarmony::ingest
