// The last coat: from light without bounds to the bytes of a display.
//   canvas.h -> [varnish.h] -> gallery.h
//
// Units   in: linear light; out: sRGB bytes, row-major RGB.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <vector>

#include "ingest/gallery/canvas.h"

namespace haarmony::gallery {

struct Varnish {
    double bloom = 0.12;     // how much of the brightest light spills over
    double vignette = 0.12;  // how much darker the corners are
    double grain = 0.006;    // deviation of the film grain, in display units
    double saturation = 1;   // about luminance
    std::uint32_t seed = 0;  // of the grain
};

void apply(const Varnish& varnish, Canvas& canvas);

// Highlights are rolled off rather than cut; grain dithers slow gradients.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const Varnish& varnish,
                                                 const Canvas& canvas);

}  // namespace haarmony::gallery
