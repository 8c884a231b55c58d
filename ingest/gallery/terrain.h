// Ground under a sky: mountain ranges, hills, dunes, fields in rows, still water.
//
// Everything is painted over what is there, from far to near.
//
// Units   Points and heights in picture heights, y downwards.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <span>

#include "ingest/gallery/canvas.h"
#include "ingest/gallery/sky.h"

namespace haarmony::gallery {

struct Range {
    double base = 0.6;       // y of the valley
    double height = 0.3;     // of the highest peaks above it
    double frequency = 1.6;  // peaks in a picture height
    double sharpness = 1;    // 0 rolling .. 1 alpine
    double distance = 0.5;   // 0 near .. 1 lost in the haze
    double snow = 0;         // 0 none .. 1 down to the valley
    Color rock = {};
    Color grass = {};  // of the foot
    double floor = 2;  // nothing is painted below it: something nearer hides it
    std::uint32_t seed = 0;

    // y of its crest at x.
    [[nodiscard]] double crest(double x) const;
};

// Covers everything between crest and floor.
void paint_range(Canvas& canvas, const Sky& sky, const Range& range);

struct Hill {
    double base = 0.8;  // y of its middle
    double height = 0.06;
    double frequency = 0.9;
    Color lit = {};
    Color shaded = {};
    double texture = 1;  // of grass, 0 = smooth
    double floor = 2;    // as of a range
    std::uint32_t seed = 0;

    [[nodiscard]] double crest(double x) const;
};

void paint_hill(Canvas& canvas, const Sky& sky, const Hill& hill);

// Waves of sand up to `top`, `rows` of them, each lit from the sun's side.
void paint_dunes(Canvas& canvas,
                 const Sky& sky,
                 double top,
                 int rows,
                 const Color& sand,
                 std::uint32_t seed);

// Rows of flowers that meet at a point of the horizon.
void paint_rows(Canvas& canvas,
                const Sky& sky,
                double horizon,
                std::span<const Color> colors,
                Random& random);

// Mirrors what stands above `shore` into water of this colour below it.
// Requires: 0 < ripple, about 1 for a breeze.
void paint_water(Canvas& canvas,
                 double shore,
                 const Color& water,
                 double ripple,
                 std::uint32_t seed);

}  // namespace haarmony::gallery
