// The small things that give a landscape its scale: trees, houses, boats, balloons.
//
// Units   Points in picture heights; `at` is where the thing stands, `size` its height.
// Threads const-safe.
#pragma once

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/random.h"
#include "ingest/gallery/sky.h"

namespace haarmony::gallery {

void paint_conifer(Canvas& canvas,
                   Point at,
                   double size,
                   const Color& lit,
                   const Color& shaded,
                   Random& random);

// A broad crown of leaves in dabs, lit from above and from the sun's side.
void paint_round_tree(Canvas& canvas,
                      Point at,
                      double size,
                      const Color& leaf,
                      const Sky& sky,
                      Random& random);

void paint_palm(Canvas& canvas,
                Point at,
                double size,
                double lean,
                const Color& leaf,
                Random& random);

void paint_house(Canvas& canvas,
                 Point at,
                 double size,
                 const Color& wall,
                 const Color& roof,
                 const Sky& sky);

void paint_sail_boat(Canvas& canvas,
                     Point at,
                     double size,
                     const Color& sail,
                     const Color& hull,
                     const Sky& sky);

void paint_lighthouse(Canvas& canvas,
                      Point at,
                      double size,
                      const Color& stripe,
                      const Sky& sky);

// `at` is its basket.
void paint_balloon(Canvas& canvas,
                   Point at,
                   double size,
                   double hue,
                   const Sky& sky,
                   Random& random);

}  // namespace haarmony::gallery
