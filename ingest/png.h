// PNG pixels with libpng (ingest, step 2): sniff -> dimensions -> [png] -> orientation.
//
// Painted queries arrive as PNG on every stroke: they are decoded in this process, without
// the start of a child and without OpenImageIO, whose reader prints to standard error.
//
// Shape   1, 3 or 4 channels; grey with alpha and transparent palettes become 4.
// Units   sRGB bytes, straight alpha; 16 bits and other gammas (gAMA) are converted.
// Errors  kUndecodable with libpng's words.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "ingest/raster.h"

namespace haarmony::ingest {

// Requires: the dimensions were checked (dimensions.h); they are the only limit.
[[nodiscard]] Result<Raster> decode_png(std::span<const std::uint8_t> bytes);

}  // namespace haarmony::ingest
