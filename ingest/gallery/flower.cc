#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/blossom.h"
#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"

namespace haarmony::gallery {
namespace {

Species species_of(const Commission& commission, int offset) {
    return static_cast<Species>((commission.turn * 3 + commission.turn / 8 + offset) %
                                kSpecies);
}

// Out of focus: a gradient and discs of light.
void bokeh(Canvas& canvas, Random& random, double hue, bool dark) {
    const Ramp ramp{oklch(dark ? 0.12 : 0.62, 0.07, hue),
                    oklch(dark ? 0.3 : 0.82, 0.1, hue + random.between(-0.1, 0.1)),
                    oklch(dark ? 0.2 : 0.93, 0.07, hue + 0.1)};
    const double angle = random.between(0, kTurn);
    const double c = cosine(angle);
    const double s = sine(angle);
    const std::uint32_t seed = random.noise_seed();
    canvas.cover([&](Point p) {
        const double t =
            0.5 + (p.x - canvas.aspect() / 2) * c * 0.6 + (p.y - 0.5) * s * 0.8;
        return ramp.at(t + 0.3 * noise(p.x * 1.8, p.y * 1.8, seed));
    });
    for (int i = 0; i < 26; ++i) {
        const Point p{canvas.aspect() * random.unit(), random.unit()};
        const Color light = oklch(0.85, 0.13, hue + random.between(-0.12, 0.2));
        const double r = random.between(0.02, 0.085);
        canvas.disc(p, r, light, random.between(0.05, 0.2));
        canvas.disc(p, r * 0.92, light, 0.05);
    }
}

void stem(Canvas& canvas,
          Point from,
          Point to,
          double radius,
          const Color& green,
          Random& random) {
    const Point bend = (from + to) * 0.5 + Point{random.bell() * 0.035, 0};
    const Point way[] = {from, bend, to};
    const auto path = smooth_path(way, 14);
    canvas.taper(path, radius, radius * 0.75, green * 0.7);
    canvas.taper(path, radius * 0.4, radius * 0.3, green * 1.15, 0.7);
}

Label portrait(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const Species species = species_of(commission, 0);
    const double back =
        random.pick({kGreen, kTeal, commission.hue + 0.5, commission.hue + 0.4});
    bokeh(canvas, random, back, random.chance(0.5));
    const double size = std::min(canvas.aspect(), 1.0);
    const Point centre{canvas.aspect() * random.between(0.4, 0.6),
                       random.between(0.4, 0.52)};
    const Color green = oklch(0.5, 0.12, kGreen + random.between(-0.04, 0.03));
    stem(canvas, {centre.x + random.bell() * 0.05, 1.05}, centre, 0.014, green, random);
    for (const double side : {-1.0, 1.0}) {
        const Point root{centre.x, random.between(0.82, 1.0)};
        const double angle = side * random.between(0.8, 1.2);
        paint_leaf(canvas, root, angle, size * random.between(0.3, 0.45), 0.42, green);
    }
    paint_blossom(canvas,
                  species,
                  centre,
                  size * random.between(0.32, 0.44),
                  commission.hue,
                  random);
    return {name_of(species), {"flower", name_of(species)}};
}

Label border(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const Ramp air{oklch({random.between(0.75, 0.95),
                          0.09,
                          commission.hue + random.pick({0.5, 0.35, 0.2})}),
                   oklch(0.93, 0.05, commission.hue + 0.2),
                   oklch(0.6, 0.12, kLime)};
    canvas.cover([&](Point p) { return air.at(p.y); });
    for (int layer = 0; layer < 3; ++layer) {
        const double t = layer / 2.0;
        const Color green = mix(oklch(0.72, 0.1, kLime), oklch(0.42, 0.11, kGreen), t);
        for (int i = 0; i < 50; ++i) {
            const double x = canvas.aspect() * random.between(-0.05, 1.05);
            const Point blade[] = {{x, 1.05},
                                   {x + random.bell() * 0.02, 0.85 - 0.1 * t},
                                   {x + random.bell() * 0.08, random.between(0.5, 0.8)}};
            canvas.taper(smooth_path(blade, 8),
                         0.009,
                         0.001,
                         shade_of(green, random.between(0.7, 1.15)));
        }
        const int count = 7 - layer;
        for (int i = 0; i < count; ++i) {
            const double x = canvas.aspect() * fraction((i + 0.5) / count + 0.17 * layer +
                                                        random.bell() * 0.03);
            const Point head{x, mix(0.26, 0.62, t) + random.bell() * 0.07};
            stem(canvas,
                 {x + random.bell() * 0.04, 1.05},
                 head,
                 0.005 + 0.003 * t,
                 green,
                 random);
            const double side = random.sign();
            paint_leaf(canvas,
                       {x, head.y + 0.2},
                       side * random.between(0.5, 1.0),
                       0.14 + 0.05 * t,
                       0.3,
                       green);
            paint_blossom(canvas,
                          species_of(commission, i % 3),
                          head,
                          mix(0.06, 0.115, t) * random.between(0.8, 1.2),
                          commission.hue + 0.13 * (i % 3) - 0.1 * layer,
                          random);
        }
    }
    return {"Flower border", {"flower", "garden"}};
}

Label pond(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const double water = random.pick({kTeal, kCyan, kSkyBlue, kBlue, kViolet});
    const Ramp ramp{oklch(0.26, 0.08, water),
                    oklch(0.52, 0.1, water + 0.03),
                    oklch(0.85, 0.06, commission.hue + 0.3)};
    const std::uint32_t seed = random.noise_seed();
    canvas.cover([&](Point p) {
        return ramp.at(0.42 + 0.5 * fbm(p.x * 1.3, p.y * 5, 4, seed) +
                       0.1 * noise(p.x * 6, p.y * 40, seed + 1));
    });
    const int count = 12 + random.below(6);
    for (int i = 0; i < count; ++i) {
        const double t = (i + 0.5) / count;
        const Point at{canvas.aspect() * fraction(i * 0.618 + random.unit() * 0.1),
                       mix(0.08, 0.95, t)};
        const double r = mix(0.05, 0.15, t) * random.between(0.8, 1.2);
        const double cut = random.between(0, kTurn);
        std::vector<Point> pad{at};
        for (int k = 0; k <= 40; ++k) {
            const double a = cut + 0.25 + (kTurn - 0.5) * k / 40;
            pad.push_back(at + Point{r * cosine(a), r * 0.52 * sine(a)});
        }
        const Mask mask = cover_polygon(canvas.frame(), pad);
        Mask shadow = soften(canvas.frame(), mask, 0.008);
        shadow.top += static_cast<int>(0.014 * canvas.height());
        canvas.glaze(shadow, {0.1, 0.14, 0.2}, 0.6);
        const Color leaf = oklch(
            {random.between(0.45, 0.65), 0.13, random.between(kLime, kGreen + 0.04)});
        canvas.shade(mask, 1, [&](Point p) {
            const Point d{(p.x - at.x) / r, (p.y - at.y) / (r * 0.52)};
            const double rib = smoothstep(
                0.12, 0.0, std::fabs(fraction(arc_tangent(d.y, d.x) * 2.2 + 8) - 0.5));
            return leaf * (0.75 + 0.35 * length(d) + 0.3 * rib - 0.2 * d.y);
        });
        if (i % 3 == 1)
            paint_blossom(canvas,
                          Species::kLotus,
                          at - Point{0, r * 0.1},
                          r * 0.62,
                          commission.hue + 0.06 * (i % 2),
                          random);
    }
    return {"Lily pond", {"flower", "pond", "water"}};
}

// A branch of blossoms against the sky, or of berries and leaves.
Label branch(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const Ramp sky{oklch({random.between(0.6, 0.8),
                          0.11,
                          commission.hue + random.pick({0.5, 0.42, 0.33})}),
                   oklch(0.94, 0.04, commission.hue + 0.3)};
    canvas.cover([&](Point p) { return sky.at(p.y * 0.8 + p.x * 0.15); });
    if (random.chance(0.5)) {
        const Point sun{canvas.aspect() * random.between(0.3, 0.7),
                        random.between(0.3, 0.6)};
        canvas.disc(sun,
                    random.between(0.18, 0.28),
                    oklch(0.93, 0.09, commission.hue + 0.1),
                    0.9);
    }
    const double side = random.sign();
    const auto place = [&](Point p) {
        return Point{side > 0 ? p.x * canvas.aspect() : (1 - p.x) * canvas.aspect(), p.y};
    };
    const Color bark = oklch(0.3, 0.05, 0.1);
    std::vector<Point> tips;
    for (int i = 0; i < 7; ++i) {
        const double y = random.between(0.1, 0.95);
        const Point way[] = {
            place({-0.05, y}),
            place({random.between(0.2, 0.4), y - random.between(0, 0.14)}),
            place({random.between(0.5, 0.75), y - random.between(-0.1, 0.25)}),
            place({random.between(0.75, 1.0), y - random.between(-0.12, 0.4)})};
        const auto path = smooth_path(way, 14);
        const double r = i < 2 ? 0.019 : 0.009;
        canvas.taper(path, r, 0.0025, bark);
        canvas.taper(path, r * 0.35, 0.001, shade_of(bark, 1.6), 0.6);
        for (std::size_t k = 6; k < path.size(); k += 2) tips.push_back(path[k]);
    }
    const Color inner = oklch(0.6, 0.2, commission.hue);
    const Color outer = oklch(0.93, 0.06, commission.hue);
    const bool leaves = random.chance(0.4);
    for (const Point& tip : tips) {
        for (int i = 0; i < 3; ++i) {
            const Point at = tip + Point{random.bell() * 0.028, random.bell() * 0.028};
            const double r = random.between(0.02, 0.042);
            if (leaves && i == 0)
                paint_leaf(canvas,
                           at,
                           random.between(0, kTurn),
                           0.1,
                           0.4,
                           oklch(0.6, 0.14, kLime));
            const double start = random.between(0, kTurn);
            for (int k = 0; k < 5; ++k)
                paint_petal(canvas,
                            at,
                            start + kTurn * k / 5,
                            r,
                            0.95,
                            Outline::kHeart,
                            inner,
                            outer,
                            0.3);
            canvas.disc(at, r * 0.2, oklch(0.8, 0.16, kGold));
        }
    }
    for (int i = 0; i < 30; ++i) {
        const Point p{canvas.aspect() * random.unit(), random.unit()};
        paint_petal(canvas,
                    p,
                    random.between(0, kTurn),
                    0.018,
                    0.9,
                    Outline::kRound,
                    outer,
                    outer,
                    0);
    }
    return {"Blossom branch", {"flower", "branch"}};
}

// Leaves and flowers that fill the sheet, as on a printed cloth.
Label pattern(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const bool dark = random.chance(0.55);
    const Color ground = oklch(dark ? random.between(0.2, 0.32) : 0.93,
                               dark ? 0.08 : 0.04,
                               commission.hue + 0.5);
    canvas.cover([&](Point) { return ground; });
    const Color greens[] = {
        oklch(0.55, 0.11, kGreen), oklch(0.68, 0.12, kLime), oklch(0.5, 0.09, kTeal)};
    const double pitch = random.between(0.2, 0.3);
    const Species first = species_of(commission, 1);
    const Species second = species_of(commission, 4);
    const int rows = static_cast<int>(1 / pitch) + 2;
    const int columns = static_cast<int>(canvas.aspect() / pitch) + 2;
    const auto at = [&](int i, int j) {
        return Point{(i + 0.5 * (j % 2)) * pitch, j * pitch * 0.9};
    };
    for (int j = -1; j < rows; ++j) {
        for (int i = -1; i < columns; ++i) {
            const Point p = at(i, j + 1);
            const Point vine[] = {
                p, p + Point{pitch * 0.5, -pitch * 0.25}, p + Point{pitch, 0}};
            canvas.taper(smooth_path(vine, 8), 0.006, 0.004, greens[0]);
            for (int k = 0; k < 6; ++k)
                paint_leaf(canvas,
                           p,
                           kTurn * (k + 0.5 * (j & 1)) / 6,
                           pitch * 0.62,
                           0.38,
                           shade_of(greens[(k + i + 6) % 3], dark ? 1 : 0.85));
        }
    }
    for (int j = -1; j < rows; ++j)
        for (int i = -1; i < columns; ++i) {
            const bool odd = ((i + j) & 1) != 0;
            paint_blossom(canvas,
                          odd ? first : second,
                          at(i, j + 1),
                          pitch * (odd ? 0.3 : 0.22),
                          commission.hue + (odd ? 0 : 0.2),
                          random);
        }
    return {"Printed garden", {"flower", "pattern", "leaves"}};
}

}  // namespace

Label paint_flower(Canvas& canvas, Commission& commission) {
    static constexpr std::array kScenes = {
        portrait, border, portrait, branch, pond, portrait, pattern};
    return kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](
        canvas, commission);
}

}  // namespace haarmony::gallery
