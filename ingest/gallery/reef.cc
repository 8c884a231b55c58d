#include "ingest/gallery/reef.h"

#include <algorithm>
#include <cmath>

#include "ingest/gallery/noise.h"
#include "ingest/gallery/terrain.h"

namespace haarmony::gallery {
namespace {

void fish(Canvas& canvas,
          Point at,
          double size,
          double heading,
          double hue,
          Random& random) {
    const auto place = [&](double x, double y) {
        return at + Point{x * size * heading, y * size};
    };
    const Color body = oklch(0.72, 0.19, hue);
    const Color stripe = oklch(random.chance(0.5) ? 0.95 : 0.3, 0.08, hue + 0.45);
    const Point tail[] = {
        place(-0.42, 0), place(-0.8, -0.3), place(-0.7, 0), place(-0.8, 0.3)};
    canvas.polygon(tail, shade_of(body, 0.85));
    const Point fin[] = {place(-0.25, -0.2), place(-0.1, -0.52), place(0.2, -0.24)};
    canvas.polygon(fin, shade_of(body, 0.8));
    const Point spine[] = {place(0.52, 0.02),
                           place(0.25, -0.27),
                           place(-0.15, -0.24),
                           place(-0.5, 0),
                           place(-0.15, 0.24),
                           place(0.25, 0.27)};
    const double bars = random.between(4, 9);
    canvas.shade(
        cover_polygon(canvas.frame(), smooth_outline(spine, 8)), 1, [&](Point p) {
            const double along = (p.x - at.x) / (size * heading);
            const double up = (p.y - at.y) / size;
            const Color c = sine(along * bars * 2 + up * 2) > 0.45 ? stripe : body;
            return c * (0.95 - 1.2 * up);
        });
    canvas.disc(place(0.34, -0.05), size * 0.055, {0.95, 0.95, 0.95});
    canvas.disc(place(0.35, -0.05), size * 0.03, {0.02, 0.02, 0.02});
}

// 0 a fan of branches, 1 a brain of knobs, 2 weed in the current.
void paint_coral(Canvas& canvas,
                 int form,
                 Point foot,
                 double size,
                 const Color& c,
                 Random& random) {
    if (form == 0) {  // a fan of branches
        for (int k = 0; k < 11; ++k) {
            const double a = (k - 5) * 0.17 + random.bell() * 0.05;
            const Point branch[] = {
                foot,
                foot + turned({0, -size * 0.5}, a * 0.6),
                foot + turned({0, -size * random.between(0.8, 1.1)}, a)};
            canvas.taper(smooth_path(branch, 6),
                         size * 0.045,
                         size * 0.02,
                         shade_of(c, random.between(0.85, 1.1)));
        }
    } else if (form == 1) {  // a brain of knobs
        for (int k = 0; k < 40; ++k) {
            const Point p = foot + Point{random.bell() * size * 0.26,
                                         -std::fabs(random.bell()) * size * 0.24};
            canvas.disc(p, size * 0.09, shade_of(c, random.between(0.7, 1.0)));
            canvas.disc(p - Point{size * 0.015, size * 0.02},
                        size * 0.055,
                        shade_of(c, random.between(1.0, 1.2)));
        }
    } else {  // weed in the current
        for (int k = 0; k < 7; ++k) {
            const double x = (k - 3) * size * 0.12;
            const double bend = random.between(-0.1, 0.1);
            const Point weed[] = {
                foot + Point{x, 0},
                foot + Point{x + bend, -size * 0.6},
                foot + Point{x - bend, -size * 1.2},
                foot + Point{x + bend, -size * random.between(1.5, 2.0)}};
            canvas.taper(
                smooth_path(weed, 8),
                size * 0.05,
                size * 0.01,
                shade_of(mix(c, oklch(0.6, 0.16, kLime), 0.5), random.between(0.7, 1.1)));
        }
    }
}

}  // namespace

Label paint_reef(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const double water = random.pick({kTeal, kCyan, kSkyBlue, kBlue, kViolet});
    const Ramp depth{oklch(0.86, 0.1, water - 0.06),
                     oklch(0.58, 0.14, water),
                     oklch(0.22, 0.1, water + 0.04)};
    const std::uint32_t seed = random.noise_seed();
    const Point source{canvas.aspect() * random.between(0.1, 0.9), -0.35};
    canvas.cover([&](Point p) {
        const Point d = p - source;
        const double angle = arc_tangent(d.x, d.y);
        const double shaft = smoothstep(
            -0.1, 0.7, noise(angle * 9, 0.5, seed) + 0.5 * noise(angle * 23, 1.5, seed));
        return depth.at(p.y * 0.95) * (0.75 + 0.7 * shaft * exponential(-1.6 * p.y));
    });
    for (int layer = 0; layer < 3; ++layer) {
        const double t = layer / 2.0;
        const double floor = mix(0.78, 0.97, t);
        const Hill sand{.base = floor,
                        .height = 0.07,
                        .frequency = 1.4,
                        .seed = seed + static_cast<std::uint32_t>(layer)};
        for (int x = 0; x < canvas.width(); ++x)
            for (int y = std::max(
                     0, floor_int(sand.crest(canvas.point(x, 0).x) * canvas.height()));
                 y < canvas.height();
                 ++y)
                canvas.set(x,
                           y,
                           mix(depth.at(0.85),
                               oklch(mix(0.4, 0.7, t), 0.06, 0.2),
                               0.3 + 0.45 * t) *
                               (1 + 0.1 * noise(x * 0.05, y * 0.2, seed)));
        const int corals = 5;
        for (int i = 0; i < corals; ++i) {
            const Point foot{canvas.aspect() * fraction((i + 0.5 * layer) / corals +
                                                        random.between(0, 0.12)),
                             floor + 0.03};
            const Color c =
                mix(depth.at(0.7),
                    oklch(random.between(0.55, 0.75), 0.2, commission.hue + 0.13 * i),
                    0.35 + 0.65 * t);
            const double size = mix(0.12, 0.26, t) * random.between(0.7, 1.3);
            paint_coral(canvas, i % 3, foot, size, c, random);
        }
    }
    const int shoal = 6 + random.below(12);
    const double heading = random.sign();
    for (int i = 0; i < shoal; ++i) {
        const Point at{canvas.aspect() * random.between(0.05, 0.95),
                       random.between(0.12, 0.78)};
        const double size = random.between(0.05, i == 0 ? 0.24 : 0.13);
        const double own = random.chance(0.85) ? heading : -heading;
        fish(canvas,
             at,
             size,
             own,
             commission.hue + 0.5 + random.pick({0.0, 0.1, 0.35}),
             random);
    }
    for (int i = 0; i < 30; ++i) {
        const Point p{canvas.aspect() * random.unit(), random.unit()};
        canvas.disc(p, random.between(0.003, 0.009), {0.9, 0.97, 1}, 0.3);
    }
    return {"Coral reef", {"sea", "reef", "fish"}};
}

}  // namespace haarmony::gallery
