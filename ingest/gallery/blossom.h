// Petals, leaves and whole flowers, seen from above or from the side.
//
// Units   Points in picture heights; angles in radians, 0 = upwards, clockwise.
// Threads const-safe.
#pragma once

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

// How wide a petal or leaf is along its length.
enum class Outline { kRound, kPointed, kHeart, kNarrow };

// From `root` outwards; dark at the root, light at the rim, with veins. Casts a soft
// shadow of `shadow` (0 none .. 1).
void paint_petal(Canvas& canvas,
                 Point root,
                 double angle,
                 double size,
                 double breadth,
                 Outline outline,
                 const Color& inner,
                 const Color& outer,
                 double shadow);

// A midrib, side veins, one half lighter than the other.
void paint_leaf(Canvas& canvas,
                Point root,
                double angle,
                double size,
                double breadth,
                const Color& color);

enum class Species { kDaisy, kRose, kSunflower, kPoppy, kLotus, kTulip, kPansy, kDahlia };
inline constexpr int kSpecies = 8;

[[nodiscard]] const char* name_of(Species species);

// Around `centre`, of this radius, in colours about `hue`.
void paint_blossom(Canvas& canvas,
                   Species species,
                   Point centre,
                   double radius,
                   double hue,
                   Random& random);

}  // namespace haarmony::gallery
