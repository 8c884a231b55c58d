// One scene in the making: what the steps of a landscape or a seascape share.
#pragma once

#include <initializer_list>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/random.h"
#include "ingest/gallery/sky.h"

namespace haarmony::gallery {

struct Scene {
    Canvas& canvas;
    Random& random;
    double hue;
    Sky sky;
    double horizon;
};

// Paints the sky, with a horizon somewhere between `low` and `high`. The hour moves on when
// all `scenes` of the painter have had their turn.
[[nodiscard]] Scene begin_scene(Canvas& canvas,
                                Commission& commission,
                                int scenes,
                                std::initializer_list<Hour> hours,
                                double low,
                                double high);

}  // namespace haarmony::gallery
