// The things that still lifes are made of: fruit, bowls, vases, bottles, candles, in one
// light from the upper left or right.
//
// Units   Points in picture heights; `at` is the middle of where the thing stands.
// Threads const-safe.
#pragma once

#include <span>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

// Where the light comes from and what it looks like.
struct Lamp {
    double side = -1;  // -1 from the left, 1 from the right
    Color light;
    Color shade;  // what fills the shadows
};

enum class Fruit {
    kApple,
    kMandarin,
    kLemon,
    kPear,
    kPlum,
    kPeach,
    kGrapes,
    kPomegranate,
    kMelon
};
inline constexpr int kFruits = 9;

[[nodiscard]] const char* name_of(Fruit fruit);

// Soft, away from the lamp, of a thing of this half width.
void paint_cast_shadow(Canvas& canvas,
                       const Lamp& lamp,
                       Point at,
                       double half,
                       double height);

// `size` is its radius. Casts no shadow.
void paint_fruit(Canvas& canvas,
                 const Lamp& lamp,
                 Fruit fruit,
                 Point at,
                 double size,
                 Random& random);

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
