// The painters of the gallery, one file each: gallery.h asks them in turn.
//
// Each covers the whole canvas, chooses its scene by `turn`, so that all of its scenes
// come round, and everything else by `random`. The picture depends on the pixel size of
// the canvas only in detail, never in composition.
//
// Units   hue in turns (palette.h).
// Threads const-safe.
#pragma once

#include <string>
#include <vector>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

struct Commission {
    Random random;
    int turn = 0;    // how many pictures this painter has made before, plus an offset
    double hue = 0;  // leading hue; spread evenly over consecutive turns
};

struct Label {
    std::string title;
    std::vector<std::string> tags;
};

[[nodiscard]] Label paint_landscape(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_flag(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_flower(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_fractal(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_still_life(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_seascape(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_tree(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_flame(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_abstract(Canvas& canvas, Commission& commission);
[[nodiscard]] Label paint_planet(Canvas& canvas, Commission& commission);

}  // namespace haarmony::gallery
