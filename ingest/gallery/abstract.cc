#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/studio.h"

namespace haarmony::gallery {
namespace {

Label improvisation(Studio& s) {
    const Color ground = s.paper();
    const Color second = oklch(0.86, 0.07, s.hues[1]);
    const std::uint32_t seed = s.random.noise_seed();
    s.canvas.cover([&](Point p) {
        return mix(
            ground, second, smoothstep(-0.2, 0.6, fbm(p.x * 1.2, p.y * 1.2, 3, seed)));
    });
    const auto spot = [&] {
        return Point{s.random.between(0.08, 0.92) * s.w(), s.random.between(0.08, 0.92)};
    };
    for (int i = 0; i < 6; ++i) {  // veils
        const Point at = spot();
        const double r = s.random.between(0.1, 0.32);
        s.canvas.fill(soften(s.canvas.frame(), cover_disc(s.canvas.frame(), at, r), 0.02),
                      s.vivid(),
                      0.55);
    }
    for (int i = 0; i < 7; ++i) {
        const Point at = spot();
        const double size = s.random.between(0.06, 0.24);
        const Color c = s.vivid();
        switch (s.random.below(5)) {
            case 0:
                for (int k = 0; k < 4; ++k)
                    s.canvas.disc(
                        at, size * (1 - 0.25 * k), k % 2 == 0 ? c : s.vivid(), 0.92);
                break;
            case 1: {
                const double angle = s.random.between(0, kTurn);
                const Point triangle[] = {at + turned({0, -size * 1.3}, angle),
                                          at + turned({size, size * 0.8}, angle),
                                          at + turned({-size * 0.5, size}, angle)};
                s.canvas.polygon(triangle, c, 0.88);
                break;
            }
            case 2: {  // a checkered patch
                const double angle = s.random.between(-0.7, 0.7);
                for (int k = 0; k < 16; ++k) {
                    const Point o{(k % 4 - 2) * size * 0.4, (k / 4 - 2) * size * 0.4};
                    const Point q[] = {
                        at + turned(o, angle),
                        at + turned(o + Point{size * 0.4, 0}, angle),
                        at + turned(o + Point{size * 0.4, size * 0.4}, angle),
                        at + turned(o + Point{0, size * 0.4}, angle)};
                    s.canvas.polygon(
                        q, (k + k / 4) % 2 == 0 ? c : Color{0.02, 0.02, 0.03}, 0.9);
                }
                break;
            }
            case 3: {  // a half disc
                std::vector<Point> half;
                const double angle = s.random.between(0, kTurn);
                for (int k = 0; k <= 24; ++k)
                    half.push_back(at + turned({size * 1.1, 0}, angle + kPi * k / 24));
                s.canvas.polygon(half, c, 0.92);
                break;
            }
            default: {  // a serpent
                std::vector<Point> way;
                const double angle = s.random.between(-1, 1);
                for (int k = 0; k < 7; ++k)
                    way.push_back(at + turned({(k - 3) * size * 0.5,
                                               (k % 2 == 0 ? 1 : -1) * size * 0.35},
                                              angle));
                s.canvas.taper(smooth_path(way, 10), 0.02, 0.006, c);
                break;
            }
        }
    }
    const Color ink{0.015, 0.015, 0.02};
    for (int i = 0; i < 9; ++i) {
        const Point a = spot();
        const double reach = s.random.between(0.2, 0.7);
        const Point b = a + turned({reach, 0}, s.random.between(0, kTurn));
        const Point bend =
            (a + b) * 0.5 + Point{s.random.bell() * 0.08, s.random.bell() * 0.08};
        const Point way[] = {a, bend, b};
        s.canvas.taper(smooth_path(way, 12), s.random.between(0.002, 0.008), 0.0015, ink);
    }
    weave(s);
    return {"Improvisation", {"abstract", "shapes"}};
}

Label colour_field(Studio& s) {
    const Color ground = s.tone(s.random.between(0.35, 0.7), 0.16);
    const std::uint32_t seed = s.random.noise_seed();
    s.canvas.cover(
        [&](Point p) { return ground * (1 + 0.14 * fbm(p.x * 3, p.y * 3, 4, seed)); });
    const int bands = 2 + s.random.below(2);
    double y = 0.06;
    for (int i = 0; i < bands; ++i) {
        const double height =
            i == bands - 1 ? 0.94 - y : (0.9 - y) * s.random.between(0.3, 0.65);
        const Point corners[] = {{0.07, y},
                                 {s.w() - 0.07, y},
                                 {s.w() - 0.07, y + height - 0.03},
                                 {0.07, y + height - 0.03}};
        const Color c = s.tone(s.random.between(0.35, 0.88), 0.2);
        s.canvas.shade(
            soften(s.canvas.frame(), cover_polygon(s.canvas.frame(), corners), 0.012),
            0.92,
            [&](Point p) { return c * (1 + 0.2 * fbm(p.x * 4, p.y * 7, 4, seed + 7)); });
        y += height + 0.01;
    }
    return {"Colour field", {"abstract", "colour field"}};
}

Label marbling(Studio& s) {
    const std::uint32_t seed = s.random.noise_seed();
    const Ramp ramp{oklch(0.25, 0.1, s.hues[0]),
                    oklch(0.55, 0.2, s.hues[0]),
                    oklch(0.93, 0.05, s.hues[3]),
                    oklch(0.7, 0.19, s.hues[2]),
                    oklch(0.38, 0.16, s.hues[1]),
                    oklch(0.85, 0.15, s.hues[4]),
                    oklch(0.25, 0.1, s.hues[0])};
    const double scale = s.random.between(0.8, 1.6);
    const double strength = s.random.between(0.5, 1.1);
    const double lines = s.random.between(1.5, 4);
    s.canvas.cover([&](Point p) {
        const double a = fbm(p.x * scale, p.y * scale, 3, seed);
        const double b = fbm(p.x * scale + 5.2, p.y * scale + 1.3, 3, seed + 1);
        const double c = fbm(
            p.x * scale + strength * 2 * a, p.y * scale + strength * 2 * b, 4, seed + 2);
        const double vein = smoothstep(
            0.05, 0.0, std::fabs(noise(p.x * 2 + 3 * a, p.y * 2 + 3 * c, seed + 4)));
        return mix(ramp.around(lines * c + 0.6 * a + 10),
                   oklch(0.88, 0.12, s.hues[3]),
                   0.4 * vein);
    });
    return {"Marbled paper", {"abstract", "marble"}};
}

Label ribbons(Studio& s) {
    const Ramp ground{s.tone(0.25, 0.12), s.tone(0.6, 0.17)};
    const double angle = s.random.between(-0.5, 0.5);
    s.canvas.cover([&](Point p) { return ground.at(p.y + angle * (p.x - s.w() / 2)); });
    const int count = 6 + s.random.below(5);
    const double frequency = s.random.between(0.5, 1.3);
    for (int i = 0; i < count; ++i) {
        const double level = (i + 0.5) / count;
        const double phase = i * s.random.between(0.3, 0.5);
        const double height = 0.12 + 0.1 * s.random.unit();
        std::vector<Point> outline;
        std::vector<Point> under;
        for (int k = -2; k <= 62; ++k) {
            const double x = s.w() * k / 60;
            const double y = level + 0.13 * sine(x * kTurn * frequency + phase) +
                             angle * (x - s.w() / 2);
            const double half = height * (0.35 + 0.3 * sine(x * 4 + phase * 3));
            outline.push_back({x, y - half});
            under.push_back({x, y + half});
        }
        outline.insert(outline.end(), under.rbegin(), under.rend());
        const Mask mask = cover_polygon(s.canvas.frame(), outline);
        Mask shadow = soften(s.canvas.frame(), mask, 0.016);
        shadow.top += static_cast<int>(0.02 * s.canvas.height());
        s.canvas.glaze(shadow, {0.1, 0.1, 0.14}, 0.6);
        const Color c = s.vivid();
        const Color end = s.vivid();
        s.canvas.shade(mask, 0.97, [&](Point p) {
            const double fold = sine((p.y - level) * 16 + p.x * 3 + phase);
            return mix(c, end, p.x / s.w()) * (0.9 + 0.3 * fold);
        });
    }
    return {"Ribbons", {"abstract", "waves"}};
}

Label facets(Studio& s) {
    // A lattice of shaken points; each triangle takes its colour from a soft picture.
    const int rows = 6 + s.random.below(6);
    const int columns = static_cast<int>(rows * s.w()) + 1;
    const std::uint32_t seed = s.random.noise_seed();
    const Ramp ramp{oklch(0.25, 0.12, s.hues[0]),
                    oklch(0.55, 0.2, s.hues[2]),
                    oklch(0.75, 0.18, s.hues[1]),
                    oklch(0.94, 0.09, s.hues[3])};
    const auto node = [&](int i, int j) {
        return Point{(i + 0.7 * (lattice_unit(i, j, seed) - 0.5)) * s.w() / columns,
                     (j + 0.7 * (lattice_unit(i, j, seed + 1) - 0.5)) / rows};
    };
    const Point focus{s.w() * s.random.unit(), s.random.unit()};
    for (int j = -1; j <= rows; ++j) {
        for (int i = -1; i <= columns; ++i) {
            const Point corners[4] = {
                node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
            for (const int half : {0, 1}) {
                const Point triangle[] = {
                    corners[0], corners[half + 1], corners[half + 2]};
                const Point c = (triangle[0] + triangle[1] + triangle[2]) * (1.0 / 3);
                const double t = 1.05 - length(c - focus) * 0.75 +
                                 0.35 * noise(c.x * 2.2, c.y * 2.2, seed + 2) +
                                 0.16 * (lattice_unit(i, 2 * j + half, seed + 3) - 0.5);
                // Grown a little, so that no seam of the ground shows between neighbours.
                std::vector<Point> grown;
                for (const Point& p : triangle)
                    grown.push_back(
                        c + (p - c) * 1.02 +
                        (p - c) * (s.canvas.pixel() / std::max(1e-6, length(p - c))));
                s.canvas.polygon(grown, ramp.at(t));
            }
        }
    }
    return {"Facets", {"abstract", "triangles"}};
}

}  // namespace

Label paint_abstract(Canvas& canvas, Commission& commission) {
    Studio studio{canvas, commission.random, harmony(commission.random, commission.hue)};
    static constexpr std::array kScenes = {paint_rectangles,
                                           marbling,
                                           paint_circles,
                                           ribbons,
                                           colour_field,
                                           paint_stained_glass,
                                           improvisation,
                                           facets,
                                           paint_tiles,
                                           paint_cutouts};
    return kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](studio);
}

}  // namespace haarmony::gallery
