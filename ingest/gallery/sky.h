// Skies at every hour: the light that landscapes, seascapes and trees stand in.
//
// Units   linear light; Points in picture heights.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <string>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/random.h"

namespace haarmony::gallery {

enum class Hour { kMorning, kNoon, kGoldenHour, kSunset, kDusk, kNight, kStorm };

struct Sky {
    Hour hour = Hour::kNoon;
    Ramp ramp;       // 0 = zenith, 1 = horizon
    Point sun = {};  // or the moon
    double sun_radius = 0.05;
    Color sunlight = {};  // what it casts on the ground
    Color ambient = {};   // what the rest of the sky casts
    Color haze = {};      // far things fade to this
    Color cloud_lit = {};
    Color cloud_dark = {};
    double cloudiness = 0.5;  // 0 clear .. 1 covered
    bool aurora = false;      // only at night
    std::uint32_t seed = 0;

    [[nodiscard]] std::string when() const;  // "at sunset"
    [[nodiscard]] std::string tag() const;
    [[nodiscard]] bool dark() const {
        return hour == Hour::kNight || hour == Hour::kDusk;
    }
};

[[nodiscard]] Sky make_sky(Random& random, Hour hour, double aspect, double horizon);

// Covers the canvas from its top to `horizon` and a little below.
void paint_sky(Canvas& canvas, const Sky& sky, double horizon, Random& random);

// A few birds, far away.
void paint_birds(Canvas& canvas,
                 Point around,
                 int count,
                 const Color& color,
                 Random& random);

}  // namespace haarmony::gallery
