#include "ingest/gallery/fruit.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ingest/gallery/noise.h"

namespace haarmony::gallery {
namespace {

// A ball that may be squeezed: tone(nx, ny, nz) is its colour.
template <typename F>
void ball(Canvas& canvas,
          const Lamp& lamp,
          Point centre,
          double rx,
          double ry,
          double angle,
          double shine,
          F&& tone) {
    const double c = cosine(-angle);
    const double s = sine(-angle);
    canvas.shade(cover_ellipse(canvas.frame(), centre, rx, ry, angle), 1, [&](Point p) {
        const Point d = p - centre;
        const double u = clamp((d.x * c - d.y * s) / rx, -1, 1);
        const double v = clamp((d.x * s + d.y * c) / ry, -1, 1);
        const double z = std::sqrt(std::max(0.0, 1 - u * u - v * v));
        const double nx = u * c + v * s;
        const double ny = -u * s + v * c;
        Color color = lit(tone(u, v, z), lamp, nx, ny, z);
        return color + lamp.light * (shine * highlight(lamp, nx, ny, z, 60) +
                                     0.18 * shine * highlight(lamp, nx, ny, z, 9));
    });
}

void stalk(Canvas& canvas, Point from, Point to, double radius) {
    const Point way[] = {from, (from + to) * 0.5 + Point{radius, 0}, to};
    canvas.taper(smooth_path(way, 6), radius, radius * 1.3, {0.09, 0.055, 0.025});
}

void leaf(Canvas& canvas, Point root, double angle, double size, const Lamp& lamp) {
    const Point corners[] = {root,
                             root + turned({-size * 0.22, -size * 0.5}, angle),
                             root + turned({0, -size}, angle),
                             root + turned({size * 0.22, -size * 0.5}, angle)};
    const Color green = oklch(0.52, 0.13, kGreen);
    canvas.polygon(smooth_outline(corners, 8),
                   green * (lamp.light * 0.8 + lamp.shade * 0.4));
    canvas.line(root, root + turned({0, -size * 0.9}, angle), size * 0.015, green * 0.5);
}

void grapes(Canvas& canvas, const Lamp& lamp, Point at, double size, Random& random) {
    const double hue = random.pick({kPurple, kViolet, kLime, kRed});
    const Color skin = oklch(hue == kLime ? 0.74 : 0.38, 0.14, hue);
    const double r = size * 0.27;
    for (int row = 5; row >= 0; --row) {
        for (int i = 0; i <= 6 - row; ++i) {
            const Point p =
                at + Point{(i - (6 - row) / 2.0) * r * 1.35 + random.bell() * r * 0.16 -
                               lamp.side * row * r * 0.2,
                           -r - (row * 0.92) * r * 1.2 + random.bell() * r * 0.12};
            ball(canvas, lamp, p, r, r * 1.08, 0, 0.75, [&](double u, double v, double) {
                return skin * (1 + 0.18 * noise(u * 2, v * 2, 3));
            });
        }
    }
}

}  // namespace

Color lit(const Color& body, const Lamp& lamp, double nx, double ny, double nz) {
    const double facing = nx * lamp.side * 0.55 - ny * 0.62 + nz * 0.56;
    const double day = smoothstep(-0.25, 1.0, facing);
    // What lies below throws some light back.
    const double bounce = 0.14 * clamp01(ny);
    return body * (lamp.shade * (0.35 + bounce) + lamp.light * (1.05 * day));
}

double highlight(const Lamp& lamp, double nx, double ny, double nz, double sharpness) {
    const double facing = nx * lamp.side * 0.40 - ny * 0.52 + nz * 0.755;
    return power(clamp01(facing), sharpness);
}

const char* name_of(Fruit fruit) {
    static constexpr const char* kNames[] = {"apples",
                                             "mandarins",
                                             "lemons",
                                             "pears",
                                             "plums",
                                             "peaches",
                                             "grapes",
                                             "pomegranates",
                                             "melon"};
    return kNames[static_cast<int>(fruit)];
}

void paint_fruit(Canvas& canvas,
                 const Lamp& lamp,
                 Fruit fruit,
                 Point at,
                 double size,
                 Random& random) {
    const std::uint32_t seed = random.noise_seed();
    const Point middle = at - Point{0, size};
    switch (fruit) {
        case Fruit::kApple: {
            const double hue = random.pick({kRed, kRed, kLime, kGold});
            const Color base = oklch(hue == kRed ? 0.5 : 0.76, 0.19, hue);
            const Color blush = oklch(0.8, 0.15, hue == kRed ? kGold : 0.1);
            const Point top = middle - Point{0, size * 0.72};
            ball(
                canvas,
                lamp,
                middle,
                size * 1.04,
                size * 0.97,
                0,
                0.55,
                [&](double u, double v, double z) {
                    const double streak = noise(u * 9 / (0.3 + z), v * 2.5, seed);
                    const double hollow = smoothstep(
                        0.05, 0.42, std::sqrt(u * u + (v + 0.72) * (v + 0.72) * 4));
                    return mix(base, blush, clamp01(0.2 + 0.5 * streak - 0.4 * v * 0.6)) *
                           (0.45 + 0.55 * hollow);
                });
            stalk(canvas, top, top + Point{size * 0.16, -size * 0.42}, size * 0.035);
            if (random.chance(0.5))
                leaf(canvas,
                     top + Point{size * 0.05, -size * 0.12},
                     1.1,
                     size * 0.6,
                     lamp);
            return;
        }
        case Fruit::kMandarin:
            ball(canvas,
                 lamp,
                 middle,
                 size,
                 size * 0.97,
                 0,
                 0.4,
                 [&](double u, double v, double z) {
                     const double pore =
                         noise(u * 26 / (0.5 + z), v * 26 / (0.5 + z), seed);
                     return oklch(0.72, 0.18, 0.16) * (1 + 0.09 * pore);
                 });
            canvas.disc(middle - Point{size * 0.1, size * 0.8},
                        size * 0.06,
                        oklch(0.4, 0.08, kGreen));
            return;
        case Fruit::kLemon: {
            const double angle = random.between(-0.5, 0.5);
            const Color skin = oklch(0.88, 0.18, 0.29);
            const Point centre = at - Point{0, size * 0.82};
            ball(canvas,
                 lamp,
                 centre + turned({-size * 1.12, 0}, angle),
                 size * 0.26,
                 size * 0.2,
                 angle,
                 0.2,
                 [&](double, double, double) { return skin * 0.9; });
            ball(canvas,
                 lamp,
                 centre + turned({size * 1.1, 0}, angle),
                 size * 0.24,
                 size * 0.2,
                 angle,
                 0.2,
                 [&](double, double, double) { return skin * 0.9; });
            ball(canvas,
                 lamp,
                 centre,
                 size * 1.15,
                 size * 0.82,
                 angle,
                 0.45,
                 [&](double u, double v, double) {
                     return skin * (1 + 0.07 * noise(u * 20, v * 16, seed));
                 });
            return;
        }
        case Fruit::kPear: {
            const Color skin = oklch(0.78, 0.15, random.pick({0.3, 0.33, 0.25}));
            const Color blush = oklch(0.6, 0.18, 0.09);
            const auto tone = [&](double u, double v, double) {
                return mix(skin,
                           blush,
                           clamp01(0.4 * noise(u * 2 + 4, v * 2, seed) +
                                   0.35 * u * lamp.side + 0.1));
            };
            const double lean = random.between(-0.2, 0.2);
            const Point neck = middle + turned({0, -size * 1.0}, lean);
            stalk(canvas,
                  neck - Point{0, size * 0.4},
                  neck + turned({0, -size * 0.95}, lean),
                  size * 0.04);
            for (int i = 8; i >= 0; --i) {
                const double t = i / 8.0;
                const double r = size * mix(1.0, 0.48, smoothstep(0.0, 0.9, t));
                ball(canvas,
                     lamp,
                     middle + (neck - middle) * t,
                     r,
                     r,
                     0,
                     i == 0 ? 0.4 : 0.0,
                     tone);
            }
            return;
        }
        case Fruit::kPlum:
            ball(canvas,
                 lamp,
                 middle,
                 size * 0.95,
                 size,
                 random.between(-0.3, 0.3),
                 0.35,
                 [&](double u, double v, double z) {
                     const double bloom =
                         smoothstep(0.0, 0.6, fbm(u * 2, v * 2, 3, seed));
                     const double seam =
                         1 - 0.3 * exponential(-power((u - 0.25 * z) * 9, 2));
                     return mix(oklch(0.34, 0.13, 0.88),
                                oklch(0.58, 0.09, 0.78),
                                bloom * 0.7) *
                            seam;
                 });
            return;
        case Fruit::kPeach:
            ball(canvas,
                 lamp,
                 middle,
                 size * 1.02,
                 size * 0.98,
                 0,
                 0.12,
                 [&](double u, double v, double z) {
                     const double blush = smoothstep(
                         -0.3, 0.5, fbm(u * 1.4, v * 1.4 + 3, 3, seed) + 0.3 * u);
                     const double seam =
                         1 - 0.35 * exponential(-power((u + 0.3 * z) * 8, 2));
                     return mix(oklch(0.85, 0.13, 0.2), oklch(0.62, 0.19, 0.08), blush) *
                            seam;
                 });
            return;
        case Fruit::kGrapes:
            grapes(canvas, lamp, at, size, random);
            return;
        case Fruit::kPomegranate: {
            const Color skin = oklch(0.48, 0.18, 0.06);
            for (int i = 0; i < 5; ++i) {
                const Point spike[] = {middle - Point{size * 0.2, size * 0.85},
                                       middle + Point{(i - 2) * size * 0.16, -size * 1.4},
                                       middle - Point{-size * 0.2, size * 0.85}};
                canvas.polygon(spike,
                               skin * (lamp.light * (0.45 + 0.1 * i) + lamp.shade * 0.3));
            }
            ball(canvas,
                 lamp,
                 middle,
                 size * 1.02,
                 size * 0.98,
                 0,
                 0.5,
                 [&](double u, double v, double) {
                     return mix(skin,
                                oklch(0.75, 0.14, 0.17),
                                0.6 * smoothstep(0.0, 0.7, fbm(u * 3, v * 3, 4, seed)));
                 });
            return;
        }
        case Fruit::kMelon: {
            // A slice: rind, white, flesh with seeds.
            const double r = size * 1.7;
            const Point top{at.x, at.y - r * 0.98};
            const auto half = [&](double radius) {
                std::vector<Point> outline;
                for (int i = 0; i <= 40; ++i)
                    outline.push_back(top + Point{radius * cosine(kPi * i / 40),
                                                  radius * 0.96 * sine(kPi * i / 40)});
                return cover_polygon(canvas.frame(), outline);
            };
            const Color bright = lamp.light * 0.85 + lamp.shade * 0.3;
            canvas.fill(half(r), oklch(0.42, 0.12, kGreen) * bright);
            canvas.fill(half(r * 0.93), oklch(0.92, 0.07, kLime) * bright);
            canvas.shade(half(r * 0.86), 1, [&](Point p) {
                return oklch(0.62, 0.21, 0.06) * bright *
                       (1 + 0.1 * noise(p.x * 40, p.y * 40, seed));
            });
            for (int i = 0; i < 15; ++i) {
                const double a = kPi * (i + 0.5) / 15;
                const double d = r * (i % 2 == 0 ? 0.66 : 0.45);
                canvas.fill(cover_ellipse(canvas.frame(),
                                          top + Point{d * cosine(a), d * sine(a)},
                                          r * 0.03,
                                          r * 0.045,
                                          kPi / 2 + a),
                            {0.015, 0.01, 0.01});
            }
            return;
        }
    }
}

}  // namespace haarmony::gallery
