#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "ingest/gallery/blossom.h"
#include "ingest/gallery/crockery.h"
#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"

namespace haarmony::gallery {
namespace {

struct Table {
    Canvas& canvas;
    Random& random;
    double hue;
    Lamp lamp;
    double edge;  // y where the table meets the wall
    bool dark;
};

void wall(Table& t) {
    const Color paint =
        oklch({t.dark ? t.random.between(0.2, 0.34) : t.random.between(0.55, 0.86),
               t.random.between(0.06, 0.13),
               t.hue + 0.5});
    const std::uint32_t seed = t.random.noise_seed();
    const int manner = t.random.below(4);
    const Color second = shade_of(paint, t.dark ? 1.25 : 0.86);
    const Point window{t.canvas.aspect() * (0.5 - t.lamp.side * 0.12), 0.25};
    t.canvas.cover([&](Point p) {
        Color c = paint;
        if (manner == 1 && fraction(p.x * 7) < 0.5) c = second;
        if (manner == 2) {  // a papered wall
            const double u = fraction(p.x * 6 + (floor_int(p.y * 6) % 2) * 0.5) - 0.5;
            const double v = fraction(p.y * 6) - 0.5;
            if (std::fabs(u) + std::fabs(v) < 0.22) c = second;
        }
        if (manner == 3 && p.y > t.edge - 0.28) c = second;
        const Point d = p - window;
        // A pool of light on the wall, away from the lamp.
        const double pool = exponential(-3.2 * (d.x * d.x * 0.8 + d.y * d.y));
        const double plaster = 1 + 0.07 * fbm(p.x * 4, p.y * 4, 4, seed);
        return c * (t.lamp.shade * 0.55 + t.lamp.light * (0.25 + 0.75 * pool)) * plaster;
    });
}

void board(Table& t) {
    const bool cloth = t.random.chance(0.5);
    const int check = t.random.below(3);
    const Color wood =
        oklch({t.random.between(0.4, 0.62), 0.08, t.random.between(0.12, 0.2)});
    const Color linen =
        oklch({t.random.between(0.8, 0.95), 0.05, t.hue + t.random.between(-0.1, 0.3)});
    const Color stripe = oklch(0.55, 0.17, t.hue + t.random.pick({0.0, 0.33, 0.5}));
    const std::uint32_t seed = t.random.noise_seed();
    const double aspect = t.canvas.aspect();
    t.canvas.rework([&](Point p, const Color& below) {
        if (p.y < t.edge - t.canvas.pixel()) return below;
        const double depth = 1 / (0.55 + (p.y - t.edge));
        const double u = (p.x - aspect / 2) * depth;
        Color c;
        if (cloth) {
            c = linen;
            const bool across = fraction(u * 3.4 + 8) < 0.5;
            const bool along = fraction(depth * 9) < 0.5;
            if (check == 1 && across != along) c = stripe;
            if (check == 2 && across) c = mix(linen, stripe, 0.8);
            c = c * (1 + 0.09 * fbm(p.x * 3, p.y * 7, 3, seed) +
                     0.03 * noise(p.x * 200, p.y * 200, seed));
        } else {
            const double grain = fbm(u * 3 + 9, depth * 34, 3, seed) +
                                 0.4 * noise(u * 6, depth * 120, seed + 1);
            c = wood * (1 + 0.22 * grain) * (fraction(depth * 3.2) < 0.03 ? 0.6 : 1);
        }
        const double near_lamp = 0.62 +
                                 0.4 * clamp01(0.5 + t.lamp.side * (p.x / aspect - 0.5)) -
                                 0.25 * (p.y - t.edge);
        const Color lit = c * (t.lamp.shade * 0.4 + t.lamp.light * near_lamp);
        return mix(below, lit, clamp01((p.y - t.edge) * t.canvas.height() + 0.5));
    });
    const Point line[] = {{-0.1, t.edge + 0.004}, {aspect + 0.1, t.edge + 0.004}};
    const double radii[] = {0.006, 0.006};
    t.canvas.glaze(
        soften(t.canvas.frame(), cover_stroke(t.canvas.frame(), line, radii), 0.006),
        {0.2, 0.2, 0.24},
        0.5);
}

Table lay(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const bool dark = random.chance(0.4);
    Table table{canvas, random, commission.hue, {}, random.between(0.54, 0.68), dark};
    table.lamp.side = random.sign();
    const bool warm = random.chance(0.65);
    table.lamp.light = warm ? Color{1.12, 1.0, 0.84} : Color{0.98, 1.02, 1.08};
    table.lamp.shade =
        (warm ? Color{0.5, 0.5, 0.68} : Color{0.55, 0.5, 0.5}) * (dark ? 0.6 : 1);
    wall(table);
    board(table);
    return table;
}

Fruit fruit_of(Commission& commission, int offset) {
    return static_cast<Fruit>((commission.turn * 2 + commission.turn / 5 + offset) %
                              kFruits);
}

void place_fruit(Table& t, Fruit fruit, Point at, double size) {
    paint_cast_shadow(t.canvas, t.lamp, at, size, size * 1.8);
    paint_fruit(t.canvas, t.lamp, fruit, at, size, t.random);
}

constexpr double kBowlShape[] = {0.45, 0.62, 0.86, 0.98, 1.02};

void bowl_of(Table& t, Point at, double half, Fruit fruit, Fruit second) {
    const double height = half * 0.62;
    paint_cast_shadow(t.canvas, t.lamp, at, half * 0.8, height);
    const double size = half * 0.31;
    // The fruit behind the rim first, then the bowl, so that it hides their feet.
    for (int row = 0; row < 3; ++row) {
        const int count = 4 - row;
        for (int i = 0; i < count; ++i) {
            const double x = (i - (count - 1) / 2.0) * size * 1.65;
            const double y = height * 0.72 + row * size * 1.15;
            paint_fruit(t.canvas,
                        t.lamp,
                        (i + row) % 3 == 1 ? second : fruit,
                        at + Point{x, -y},
                        size * t.random.between(0.92, 1.05),
                        t.random);
        }
    }
    // Only the outside of the bowl: its mouth is full.
    std::vector<Point> outline;
    for (int i = 0; i <= 24; ++i) {
        const double a = kPi * i / 24;
        outline.push_back(at + Point{half * cosine(a), -height + half * 0.16 * sine(a)});
    }
    for (const double y : {0.7, 0.4, 0.12})
        outline.push_back(at + Point{-half * (0.5 + 0.5 * power(y, 0.6)), -height * y});
    for (int i = 0; i <= 8; ++i)
        outline.push_back(at + Point{half * 0.5 * -cosine(kPi * i / 8),
                                     half * 0.07 * sine(kPi * i / 8)});
    for (const double y : {0.12, 0.4, 0.7})
        outline.push_back(at + Point{half * (0.5 + 0.5 * power(y, 0.6)), -height * y});
    const Color body = oklch(
        {t.random.between(0.5, 0.9), 0.12, t.hue + t.random.pick({0.0, 0.4, 0.55})});
    const Color decor = shade_of(body, 0.6);
    const int pattern = t.random.below(3);
    t.canvas.shade(cover_polygon(t.canvas.frame(), outline), 1, [&](Point p) {
        const double u = clamp((p.x - at.x) / half, -1, 1);
        const double up = (at.y - p.y) / height - 0.15 * (1 - u * u);
        const double nz = std::sqrt(std::max(0.0, 1 - u * u));
        const double facing =
            clamp01(0.35 + 0.5 * u * t.lamp.side + 0.25 * nz + 0.2 * (up - 0.5));
        const bool drawn =
            (pattern == 1 && up > 0.55 && up < 0.72) ||
            (pattern == 2 && fraction(u * 3 / (0.5 + nz) + up * 0.5 + 4) < 0.3);
        const Color c = drawn ? decor : body;
        return c * (t.lamp.shade * 0.35 + t.lamp.light * facing) +
               t.lamp.light *
                   (0.3 * power(clamp01(0.9 * nz + 0.42 * u * t.lamp.side), 30));
    });
}

constexpr std::array<std::array<double, 6>, 5> kVaseShapes = {
    {{0.45, 0.8, 1.0, 0.75, 0.42, 0.55},
     {0.6, 0.62, 0.7, 0.82, 0.95, 1.0},
     {0.7, 1.0, 0.9, 0.5, 0.34, 0.4},
     {0.5, 0.6, 0.85, 1.0, 0.7, 0.6},
     {0.95, 1.0, 1.0, 0.98, 0.4, 0.36}}};

// A vase of some shape and glaze.
void vase(Table& t, Point at, double height, double half) {
    std::vector<double> widths;
    for (const double w :
         t.random.pick(std::span<const std::array<double, 6>>(kVaseShapes)))
        widths.push_back(w * half);
    paint_cast_shadow(t.canvas, t.lamp, at, half * 0.8, height);
    const Color body = oklch({t.random.between(0.35, 0.82),
                              0.13,
                              t.hue + t.random.pick({0.0, 0.5, 0.33, 0.15})});
    const Color decor =
        t.random.chance(0.5) ? Color{0.85, 0.83, 0.78} : shade_of(body, 0.5);
    const auto glaze = static_cast<Glaze>(t.random.below(kGlazes));
    paint_vessel(t.canvas, t.lamp, at, {widths, height}, glaze, body, decor);
}

Label fruit_bowl(Canvas& canvas, Commission& commission) {
    Table t = lay(canvas, commission);
    const Fruit fruit = fruit_of(commission, 0);
    const Fruit first =
        fruit == Fruit::kGrapes || fruit == Fruit::kMelon ? Fruit::kApple : fruit;
    const double x = canvas.aspect() * t.random.between(0.4, 0.6);
    const double half = 0.27 * std::min(1.2, canvas.aspect());
    if (t.random.chance(0.6)) {
        const Point at{x + t.random.sign() * half * 1.15, t.edge + 0.07};
        vase(t, at, t.random.between(0.36, 0.5), 0.09);
    }
    bowl_of(t,
            {x, t.edge + 0.17},
            half,
            first,
            t.random.chance(0.5) ? Fruit::kMandarin : Fruit::kPlum);
    for (int i = 0; i < 3; ++i)
        place_fruit(
            t,
            fruit_of(commission, i),
            {canvas.aspect() * fraction(0.14 + i * 0.618), t.edge + 0.24 + 0.03 * i},
            0.06);
    return {std::string("Bowl of ") + name_of(first), {"bowl", "fruit"}};
}

Label vase_of_flowers(Canvas& canvas, Commission& commission) {
    Table t = lay(canvas, commission);
    const Point foot{canvas.aspect() * t.random.between(0.4, 0.6),
                     t.edge + t.random.between(0.14, 0.2)};
    const double height = t.random.between(0.28, 0.36);
    const Point mouth{foot.x, foot.y - height};
    const Color green =
        oklch(0.48, 0.11, kGreen) * (t.lamp.light * 0.7 + t.lamp.shade * 0.3);
    const double reach = std::min(0.34 * std::min(1.1, canvas.aspect()), mouth.y - 0.09);
    const int count = 9 + t.random.below(6);
    std::vector<Point> heads;
    for (int i = 0; i < count; ++i) {
        const double a = mix(-1.25, 1.25, (i + 0.5) / count) + t.random.bell() * 0.07;
        heads.push_back(mouth + turned({0, -reach * t.random.between(0.45, 1.05)}, a));
    }
    for (const Point& head : heads) {
        const Point way[] = {mouth, (mouth + head) * 0.5 + Point{0, -0.02}, head};
        canvas.taper(smooth_path(way, 8), 0.006, 0.004, green);
    }
    for (int i = 0; i < 12; ++i) {
        const double angle = t.random.between(-1.7, 1.7);
        paint_leaf(canvas,
                   mouth - Point{0, 0.02},
                   angle,
                   reach * t.random.between(0.5, 0.9),
                   0.36,
                   green);
    }
    const auto first = static_cast<Species>(commission.turn % kSpecies);
    const auto second = static_cast<Species>((commission.turn * 3 + 2) % kSpecies);
    for (std::size_t i = 0; i < heads.size(); ++i)
        paint_blossom(
            canvas,
            i % 3 == 0 ? second : first,
            heads[i],
            t.random.between(0.065, 0.115),
            commission.hue + (i % 3 == 0 ? 0.3 : 0.04 * static_cast<double>(i % 4)),
            t.random);
    vase(t, foot, height, t.random.between(0.1, 0.14));
    const int fruits = t.random.below(4);
    for (int i = 0; i < fruits; ++i)
        place_fruit(t,
                    fruit_of(commission, 0),
                    {foot.x + (i - 1) * 0.2 + 0.1, foot.y + 0.1},
                    0.055);
    return {std::string("Vase of ") + name_of(first), {"vase", "flowers"}};
}

Label row_of_vessels(Canvas& canvas, Commission& commission) {
    Table t = lay(canvas, commission);
    const int count = 3 + static_cast<int>(canvas.aspect() * 1.6);
    for (int i = 0; i < count; ++i) {
        const double height = t.random.between(0.18, 0.52);
        t.hue = commission.hue + 0.11 * i;
        const Point at{
            canvas.aspect() * (i + 0.5 + t.random.between(-0.15, 0.15)) / count,
            t.edge + t.random.between(0.06, 0.13)};
        vase(t, at, height, t.random.between(0.055, 0.1));
    }
    for (int i = 0; i < 3; ++i)
        place_fruit(t,
                    fruit_of(commission, i),
                    {canvas.aspect() * fraction(0.22 + i * 0.37), t.edge + 0.24},
                    t.random.between(0.045, 0.065));
    return {"Jugs and bottles", {"vessels", "bottles"}};
}

Label fruit_on_table(Canvas& canvas, Commission& commission) {
    Table t = lay(canvas, commission);
    const Fruit main = fruit_of(commission, 0);
    const double size = t.random.between(0.1, 0.145) * std::min(1.1, canvas.aspect());
    const int count = 5 + t.random.below(4);
    for (int i = 0; i < count; ++i) {
        const double depth = static_cast<double>(i) / (count - 1);
        const Fruit fruit = i % 3 == 2 ? fruit_of(commission, 1 + i) : main;
        place_fruit(t,
                    fruit,
                    {canvas.aspect() * mix(0.14, 0.86, fraction(0.2 + i * 0.618)),
                     mix(t.edge + 0.07, 0.96, depth)},
                    size * mix(0.8, 1.15, depth));
    }
    return {std::string("Table with ") + name_of(main), {"table", "fruit"}};
}

Label by_candle(Canvas& canvas, Commission& commission) {
    Table t = lay(canvas, commission);
    canvas.rework([&](Point p, const Color& c) {
        const Point d = p - Point{canvas.aspect() * 0.5, 0.45};
        return c * Color{0.5, 0.38, 0.3} * exponential(-1.6 * (d.x * d.x + d.y * d.y));
    });
    t.lamp.light = {0.95, 0.68, 0.36};
    t.lamp.shade = {0.16, 0.13, 0.2};
    const double x = canvas.aspect() * t.random.between(0.38, 0.62);
    const int candles = 1 + t.random.below(3);
    const Color wax = oklch(t.random.between(0.6, 0.92), 0.1, commission.hue);
    const double beside = t.random.sign();
    t.lamp.side = -beside;
    vase(t, {x + beside * 0.3, t.edge + 0.1}, 0.34, 0.1);
    for (int i = 0; i < candles; ++i) {
        const Point at{x + (i - (candles - 1) / 2.0) * 0.12,
                       t.edge + 0.13 + 0.03 * (i % 2)};
        paint_cast_shadow(canvas, t.lamp, at, 0.04, 0.05);
        paint_candle(canvas, t.lamp, at, t.random.between(0.24, 0.4), wax);
    }
    for (int i = 0; i < 3; ++i)
        place_fruit(t,
                    fruit_of(commission, i),
                    {x + beside * (0.1 + 0.16 * i), t.edge + 0.25},
                    0.065);
    return {"By candlelight", {"candle", "night"}};
}

}  // namespace

Label paint_still_life(Canvas& canvas, Commission& commission) {
    static constexpr std::array kScenes = {fruit_bowl,
                                           vase_of_flowers,
                                           fruit_on_table,
                                           row_of_vessels,
                                           vase_of_flowers,
                                           by_candle};
    Label label = kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](
        canvas, commission);
    label.tags.insert(label.tags.begin(), "still life");
    return label;
}

}  // namespace haarmony::gallery
