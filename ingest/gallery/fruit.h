// The fruit of still lifes, and the light that falls on it: one lamp from the upper left
// or right, and what the room throws back.
//
// Units   Points in picture heights; `at` is the middle of where the thing stands.
// Threads const-safe.
#pragma once

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

// Where the light comes from and what it looks like.
struct Lamp {
    double side = -1;  // -1 from the left, 1 from the right
    Color light;
    Color shade;  // what fills the shadows
};

// Light on a matt surface with this normal, warm in the light and cool in the shade.
[[nodiscard]] Color lit(const Color& body,
                        const Lamp& lamp,
                        double nx,
                        double ny,
                        double nz);

// The lamp's own image on a polished surface, 0 to 1.
[[nodiscard]] double highlight(const Lamp& lamp,
                               double nx,
                               double ny,
                               double nz,
                               double sharpness);

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

// `size` is its radius. Casts no shadow.
void paint_fruit(Canvas& canvas,
                 const Lamp& lamp,
                 Fruit fruit,
                 Point at,
                 double size,
                 Random& random);

}  // namespace haarmony::gallery
