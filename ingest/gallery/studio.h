// What the painters of abstract pictures share: one canvas, one harmony of hues.
//
// Units   as painters.h.
// Threads one Studio a thread.
#pragma once

#include <span>
#include <vector>

#include "ingest/gallery/painters.h"

namespace haarmony::gallery {

struct Studio {
    Canvas& canvas;
    Random& random;
    std::vector<double> hues;

    [[nodiscard]] double w() const { return canvas.aspect(); }
    [[nodiscard]] Color tone(double lightness, double chroma) {
        return oklch(lightness, chroma, random.pick(std::span<const double>(hues)));
    }
    [[nodiscard]] Color vivid() {
        const double lightness = random.between(0.5, 0.82);
        return tone(lightness, random.between(0.14, 0.23));
    }
    [[nodiscard]] Color paper() {
        return oklch({random.between(0.92, 0.97), random.between(0.01, 0.05), hues[0]});
    }
};

// The threads of a canvas under the paint.
void weave(Studio& s);

// Pictures made of cells, each with its own colour and shape (tiling.cc).
[[nodiscard]] Label paint_rectangles(Studio& s);
[[nodiscard]] Label paint_circles(Studio& s);
[[nodiscard]] Label paint_tiles(Studio& s);
[[nodiscard]] Label paint_stained_glass(Studio& s);
[[nodiscard]] Label paint_cutouts(Studio& s);

}  // namespace haarmony::gallery
