// The vessels of still lifes: vases, bottles, candles, in the light of one lamp (fruit.h).
//
// Units   Points in picture heights; `at` is the middle of where the thing stands.
// Threads const-safe.
#pragma once

#include <span>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/fruit.h"

namespace haarmony::gallery {

// Soft, away from the lamp, of a thing of this half width.
void paint_cast_shadow(Canvas& canvas,
                       const Lamp& lamp,
                       Point at,
                       double half,
                       double height);

// A turned vessel: half its width at heights from 0 (foot) to 1 (lip), in picture heights.
struct Profile {
    std::span<const double> half_widths;
    double height = 0.4;
};

// How a vessel is decorated.
enum class Glaze { kPlain, kBands, kZigzag, kDots, kGlass };
inline constexpr int kGlazes = 5;

void paint_vessel(Canvas& canvas,
                  const Lamp& lamp,
                  Point at,
                  const Profile& profile,
                  Glaze glaze,
                  const Color& body,
                  const Color& decor);

void paint_candle(Canvas& canvas,
                  const Lamp& lamp,
                  Point at,
                  double height,
                  const Color& wax);

}  // namespace haarmony::gallery
