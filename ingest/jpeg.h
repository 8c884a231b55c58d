// JPEG pixels with libjpeg-turbo, as small as the caller can use them
// (ingest, step 2 for the common case): sniff -> dimensions -> [jpeg] -> orientation.
//
// The inverse transform can be cut to 4 x 4, 2 x 2 or 1 x 1 results for 8 x 8 coefficients:
// a picture of 12 megapixels is read at 1/8 in a fraction of the time, and what comes out is
// the low frequencies that an area average would have kept.
//
// Shape   1 channel for grey JPEGs, else 3. CMYK and YCCK are converted without a profile.
// Scale   1, 1/2, 1/4 or 1/8: the smallest that keeps both sides at `min_side` or more.
// Errors  kUndecodable with libjpeg's own words, for its warnings too: a truncated file
//         would otherwise come back half grey.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <span>

#include "engine/core/result.h"
#include "ingest/raster.h"

namespace haarmony::ingest {

// No camera or encoder writes more; each scan of a progressive JPEG passes over the whole
// picture, so a small file of many scans would keep a processor busy for minutes.
inline constexpr int kMaxJpegScans = 100;

// Requires: min_side >= 1.
[[nodiscard]] Result<Raster> decode_jpeg(std::span<const std::uint8_t> bytes,
                                         int min_side);

}  // namespace haarmony::ingest
