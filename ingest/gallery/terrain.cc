#include "ingest/gallery/terrain.h"

#include <algorithm>
#include <cmath>

#include "ingest/gallery/noise.h"

namespace haarmony::gallery {
namespace {

// Paints what lies between line(x) and `floor`, antialiased at the line. column(x) gives
// the function color(p, depth below the line) of that column.
template <typename Line, typename F>
void cover_below(Canvas& canvas, double floor, Line&& line, F&& column) {
    const int last =
        std::min(canvas.height(), static_cast<int>(clamp(floor, 0, 2) * canvas.height()));
    for (int x = 0; x < canvas.width(); ++x) {
        const double crest = line(canvas.point(x, 0).x);
        const auto color = column(canvas.point(x, 0).x);
        for (int y = std::max(0, floor_int(crest * canvas.height())); y < last; ++y) {
            const Point p = canvas.point(x, y);
            const double covered = clamp01((p.y - crest) * canvas.height() + 0.5);
            const Color c = color(p, std::max(0.0, p.y - crest));
            canvas.set(x, y, covered < 1 ? mix(canvas.at(x, y), c, covered) : c);
        }
    }
}

// -1 if the light comes from the left of x, 1 from the right.
double light_side(const Sky& sky, double x) { return clamp((sky.sun.x - x) * 4, -1, 1); }

}  // namespace

double Range::crest(double x) const {
    const double alpine = ridged(x * frequency, 0.37, 6, seed);
    const double rolling = 0.5 + 0.5 * fbm(x * frequency, 0.37, 4, seed);
    // Peaks stand in groups: between them the range sinks to a third.
    const double group = 1 - std::fabs(noise(x * frequency * 0.55, 3.1, seed + 1));
    return base -
           height * mix(rolling, alpine, sharpness) * mix(0.35, 1.55, group * group);
}

void paint_range(Canvas& canvas, const Sky& sky, const Range& range) {
    const double f = range.frequency * 2.6;
    const Color snow_lit = mix(Color{0.95, 0.96, 1.0}, sky.sunlight, 0.3) * 1.05;
    const Color snow_dark = mix(Color{0.42, 0.5, 0.75}, sky.ambient, 0.35);
    const double snow_limit = range.base - range.height * (1 - range.snow);
    cover_below(
        canvas,
        range.floor,
        [&](double x) { return range.crest(x); },
        [&](double) {
            return
                [&](Point p,
                    double
                        depth) {  // Folds of the slope: the crest's own noise carried down and sheared.
                    const double u = p.x * f + 0.35 * depth * f;
                    const double v = p.y * f * 0.75;
                    const double here = ridged(u, v, 4, range.seed + 3);
                    const double aside = ridged(
                        u + 0.16 * light_side(sky, p.x), v - 0.1, 3, range.seed + 3);
                    const double lit = clamp01(0.45 + 1.5 * (here - aside));
                    const double foot =
                        smoothstep(0.45, 1.0, depth / range.height + 0.25 * (here - 0.5));
                    const Color ground = mix(range.rock, range.grass, foot);
                    Color c = ground * (sky.ambient * 0.9 + sky.sunlight * (0.95 * lit));
                    if (range.snow > 0) {
                        const double fallen = smoothstep(
                            0.035,
                            -0.035,
                            p.y - snow_limit + 0.16 * range.height * (0.5 - here) * 2);
                        c = mix(c,
                                mix(snow_dark, snow_lit, lit) *
                                    (luminance(sky.sunlight) * 0.7 + 0.3),
                                fallen);
                    }
                    const double mist =
                        range.distance + (1 - range.distance) * 0.45 *
                                             smoothstep(0.5, 1.3, depth / range.height);
                    return mix(c, sky.haze, clamp01(mist));
                };
        });
}

double Hill::crest(double x) const {
    return base - height * fbm(x * frequency, 0.5, 3, seed);
}

void paint_hill(Canvas& canvas, const Sky& sky, const Hill& hill) {
    const Color light = sky.sunlight + sky.ambient;
    cover_below(
        canvas,
        hill.floor,
        [&](double x) { return hill.crest(x); },
        [&](double x) {
            const double slope = (hill.crest(x + 0.03) - hill.crest(x - 0.03)) / 0.06;
            const double facing = clamp01(0.55 - slope * 2.2 * light_side(sky, x));
            return [&, slope, facing](Point p, double depth) {
                const double patches =
                    0.5 + 0.5 * fbm(p.x * 5 + slope, p.y * 16, 3, hill.seed + 2);
                const double blades = noise(p.x * 150, p.y * 45, hill.seed + 7);
                const double t = facing * 0.55 + patches * 0.55 - depth * 0.5;
                return mix(hill.shaded, hill.lit, clamp01(t)) * light *
                       (1 + 0.16 * hill.texture * blades);
            };
        });
}

void paint_dunes(Canvas& canvas,
                 const Sky& sky,
                 double top,
                 int rows,
                 const Color& sand,
                 std::uint32_t seed) {
    for (int row = 0; row < rows; ++row) {
        const double t = (row + 0.5) / rows;
        const double base = mix(top, 1.05, power(t, 1.3));
        const double height = mix(0.03, 0.2, t);
        const double frequency = mix(2.4, 0.9, t);
        const auto own = seed + static_cast<std::uint32_t>(row) * 31U;
        const auto crest = [&](double x) {
            const double n = noise(x * frequency, row * 1.7, own);
            return base - height * (1 - std::fabs(n)) + 0.01 * noise(x * 6, 0.3, own);
        };
        const double side = light_side(sky, canvas.aspect() / 2 + 0.1) < 0 ? -1 : 1;
        // The next row's crest lies nowhere lower than this.
        const double floor =
            row + 1 < rows ? mix(top, 1.05, power((row + 1.5) / rows, 1.3)) + 0.02 : 2;
        cover_below(canvas, floor, crest, [&](double) {
            return
                [&](Point p,
                    double
                        depth) {  // The edge between the lit and the shaded face runs down from the crest aslant.
                    const double x = p.x + side * depth * 1.1 +
                                     0.25 * depth * noise(depth * 7, row, own);
                    const double slope = (crest(x + 0.012) - crest(x - 0.012)) / 0.024;
                    const double lit =
                        smoothstep(-0.12, 0.16, depth * 0.35 - slope * side);
                    const double wind =
                        sine((p.y * 150 + 9 * noise(p.x * 4, p.y * 9, own + 2)) *
                             (1.4 - 0.7 * t));
                    const Color lit_sand =
                        sand * (sky.sunlight * 1.15 + sky.ambient * 0.3);
                    const Color dark_sand =
                        sand * (sky.ambient * 0.75 + sky.sunlight * 0.16);
                    const Color c =
                        mix(dark_sand, lit_sand, lit) * (1 + 0.045 * wind * t);
                    return mix(c, sky.haze, 0.55 * power(1 - t, 1.6));
                };
        });
    }
}

void paint_rows(Canvas& canvas,
                const Sky& sky,
                double horizon,
                std::span<const Color> colors,
                Random& random) {
    const double vanish = canvas.aspect() * random.between(0.15, 0.85);
    const double density = random.between(2.2, 3.6);
    const int broad = 2 + random.below(3);
    const std::uint32_t seed = random.noise_seed();
    const Color light = sky.sunlight + sky.ambient;
    const Color leaf = oklch(0.38, 0.09, kGreen);
    const double swing = random.between(-0.25, 0.25);
    cover_below(
        canvas,
        2,
        [&](double) { return horizon; },
        [&](double) {
            return [&](Point p, double depth) {
                const double z = 1 / (depth + 0.02);
                const double row = (p.x - vanish) * z * density * 0.35 +
                                   swing * z * 0.06 * sine(z * 0.35) + 100;
                const int index = floor_int(row);
                const double across = std::fabs(fraction(row) - 0.5) * 2;
                const double blossom = noise(row * 9, z * 22 * density * 0.35, seed) +
                                       0.6 * noise(row * 3, z * 7, seed + 1);
                const double mound = 1 - across * across;
                const auto choice =
                    static_cast<std::size_t>(index / broad) % colors.size();
                Color c = colors[choice] * (0.55 + 0.5 * mound + 0.28 * blossom);
                const double path = smoothstep(0.66, 0.9, across + 0.18 * blossom);
                c = mix(c, leaf * (0.55 + 0.3 * blossom), path);
                // Rows narrower than a pixel would shimmer.
                const double blurred = smoothstep(9, 26, z);
                c = mix(c, colors[choice] * 0.72, blurred * 0.7);
                return mix(c * light, sky.haze, 0.45 * smoothstep(6, 50, z));
            };
        });
}

void paint_water(Canvas& canvas,
                 double shore,
                 const Color& water,
                 double ripple,
                 std::uint32_t seed) {
    const int first = std::max(1, floor_int(shore * canvas.height()));
    for (int y = first; y < canvas.height(); ++y) {
        const double depth = canvas.point(0, y).y - shore;
        const double near = depth / std::max(0.05, 1 - shore);
        for (int x = 0; x < canvas.width(); ++x) {
            const Point p = canvas.point(x, y);
            const double scale = 1 / (0.08 + depth);
            const double wave =
                noise(p.x * scale * 1.1, depth * scale * 26, seed) +
                0.5 * noise(p.x * scale * 3.1, depth * scale * 60, seed + 1);
            const Point mirrored{
                p.x + 0.006 * ripple * wave * near,
                shore - depth * 0.94 - 0.035 * ripple * wave * (0.15 + near)};
            Color c =
                canvas.sample({mirrored.x, std::min(mirrored.y, shore - canvas.pixel())});
            // Looking down one sees into the water, looking along it the sky.
            const double into = 0.16 + 0.5 * near * near + 0.1 * wave;
            c = mix(c * 0.9, water, clamp01(into));
            canvas.set(x, y, c);
        }
    }
    const Mask bank = soften(
        canvas.frame(),
        cover_stroke(canvas.frame(),
                     std::vector<Point>{{-0.1, shore}, {canvas.aspect() + 0.1, shore}},
                     std::vector<double>{0.003, 0.003}),
        0.002);
    canvas.glaze(bank, {0.4, 0.42, 0.45}, 0.7);
}

}  // namespace haarmony::gallery
