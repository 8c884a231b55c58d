#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/sky.h"

namespace haarmony::gallery {
namespace {

// The flat design, before the wind takes it. Colours that heraldry would allow: strong
// ones beside light ones.
struct Cloth {
    Canvas& canvas;
    Random& random;
    Color main;
    Color light;
    Color other;
    Color accent;

    [[nodiscard]] double w() const { return canvas.aspect(); }
};

void star(Canvas& canvas,
          Point centre,
          double radius,
          int points,
          double depth,
          double angle,
          const Color& c) {
    std::vector<Point> outline;
    for (int i = 0; i < 2 * points; ++i) {
        const double r = i % 2 == 0 ? radius : radius * depth;
        outline.push_back(centre + turned({0, -r}, angle + kPi * i / points));
    }
    canvas.polygon(outline, c);
}

void emblem(Cloth& f, Point at, double size, const Color& c, const Color& ground) {
    const auto five = [&](Point p, double r) { star(f.canvas, p, r, 5, 0.382, 0, c); };
    switch (f.random.below(7)) {
        case 0:
            five(at, size);
            break;
        case 1:
            f.canvas.disc(at, size * 0.85, c);
            break;
        case 2: {  // crescent and star
            Mask moon = cover_disc(f.canvas.frame(), at, size * 0.9);
            moon = without(
                moon,
                cover_disc(f.canvas.frame(), at + Point{size * 0.28, 0}, size * 0.72));
            f.canvas.fill(moon, c);
            five(at + Point{size * 0.55, 0}, size * 0.42);
            break;
        }
        case 3: {  // a sun with rays
            star(f.canvas, at, size * 1.15, 12 + 4 * f.random.below(2), 0.62, 0.1, c);
            f.canvas.disc(at, size * 0.58, ground);
            f.canvas.disc(at, size * 0.48, c);
            break;
        }
        case 4: {  // a ring of stars
            const int count = 7 + f.random.below(6);
            for (int i = 0; i < count; ++i)
                five(at + turned({0, -size}, kTurn * i / count), size * 0.24);
            break;
        }
        case 5: {  // a diamond in a diamond
            for (const double r : {1.15, 0.7, 0.36}) {
                const Point corners[] = {at + Point{0, -size * r},
                                         at + Point{size * r * 1.25, 0},
                                         at + Point{0, size * r},
                                         at + Point{-size * r * 1.25, 0}};
                f.canvas.polygon(corners, r == 0.7 ? ground : c);
            }
            break;
        }
        default: {  // a tree: a trunk and a crown of discs
            f.canvas.rectangle(
                at + Point{-size * 0.1, 0}, at + Point{size * 0.1, size}, c);
            for (int i = 0; i < 5; ++i)
                f.canvas.disc(at + turned({0, -size * 0.5}, (i - 2) * 0.75) +
                                  Point{0, -size * 0.05},
                              size * 0.38,
                              c);
            break;
        }
    }
}

void stripes(Cloth& f, bool upright, std::span<const Color> colors) {
    const auto n = static_cast<double>(colors.size());
    for (std::size_t i = 0; i < colors.size(); ++i) {
        const double a = static_cast<double>(i) / n;
        const double b = static_cast<double>(i + 1) / n;
        if (upright)
            f.canvas.rectangle({f.w() * a, 0}, {f.w() * b, 1}, colors[i]);
        else
            f.canvas.rectangle({0, a}, {f.w(), b}, colors[i]);
    }
}

void tricolour(Cloth& f) {
    const Color bands[] = {f.main, f.light, f.other};
    stripes(f, f.random.chance(0.5), bands);
    if (f.random.chance(0.6)) emblem(f, {f.w() / 2, 0.5}, 0.15, f.accent, f.light);
}

void nordic_cross(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.main);
    const double x = f.w() * 0.37;
    for (const bool inner : {false, true}) {
        const double r = inner ? 0.065 : 0.13;
        const Color c = inner ? f.other : f.light;
        f.canvas.rectangle({x - r, 0}, {x + r, 1}, c);
        f.canvas.rectangle({0, 0.5 - r}, {f.w(), 0.5 + r}, c);
    }
}

void saltire(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.main);
    const Point side_1[] = {{0, 0}, {0, 1}, {f.w() / 2, 0.5}};
    const Point side_2[] = {{f.w(), 0}, {f.w(), 1}, {f.w() / 2, 0.5}};
    if (f.random.chance(0.6)) {
        f.canvas.polygon(side_1, f.other);
        f.canvas.polygon(side_2, f.other);
    }
    for (const double r : {0.1, 0.05}) {
        const Color c = r > 0.07 ? f.light : f.accent;
        f.canvas.line({-0.2, -0.2 / f.w()}, {f.w() + 0.2, 1 + 0.2 / f.w()}, r, c);
        f.canvas.line({-0.2, 1 + 0.2 / f.w()}, {f.w() + 0.2, -0.2 / f.w()}, r, c);
    }
}

void disc_on_field(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.random.chance(0.5) ? f.light : f.main);
    const Color c = f.other;
    const Point centre{f.w() * f.random.pick({0.5, 0.42}), 0.5};
    f.canvas.disc(centre, 0.33, c);
    if (f.random.chance(0.5)) {
        f.canvas.disc(centre, 0.24, f.accent);
        emblem(f, centre, 0.12, f.light, f.accent);
    }
}

void canton(Cloth& f) {
    std::vector<Color> bands;
    const int count = 7 + 2 * f.random.below(3);
    for (int i = 0; i < count; ++i) bands.push_back(i % 2 == 0 ? f.main : f.light);
    stripes(f, false, bands);
    const Point corner{f.w() * 0.42, (count / 2 + 1.0) / count};
    f.canvas.rectangle({0, 0}, corner, f.other);
    const int rows = 3 + f.random.below(2);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < rows + 1; ++i)
            star(f.canvas,
                 {corner.x * (i + 0.5 + 0.25 * (j % 2)) / (rows + 1.2),
                  corner.y * (j + 0.5) / rows},
                 0.045,
                 5,
                 0.4,
                 0,
                 f.light);
}

void hoist_triangle(Cloth& f) {
    const Color bands[] = {f.main, f.light, f.accent};
    stripes(f,
            false,
            std::span(bands).first(2 + static_cast<std::size_t>(f.random.below(2))));
    const Point triangle[] = {
        {0, 0}, {f.w() * f.random.between(0.36, 0.55), 0.5}, {0, 1}};
    f.canvas.polygon(triangle, f.other);
    emblem(f, {f.w() * 0.16, 0.5}, 0.11, f.light, f.other);
}

void diagonal(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.main);
    const Point half[] = {{0, 1}, {f.w(), 0}, {f.w(), 1}};
    f.canvas.polygon(half, f.other);
    f.canvas.line({-0.2, 1 + 0.2 / f.w()}, {f.w() + 0.2, -0.2 / f.w()}, 0.11, f.light);
    if (f.random.chance(0.7))
        f.canvas.line(
            {-0.2, 1 + 0.2 / f.w()}, {f.w() + 0.2, -0.2 / f.w()}, 0.05, f.accent);
    emblem(f, {f.w() * 0.22, 0.26}, 0.13, f.light, f.main);
}

void rays(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.light);
    const Point centre{f.w() * f.random.pick({0.5, 0.32, 0.5}),
                       f.random.pick({0.5, 0.5, 1.0})};
    const int count = 8 + 2 * f.random.below(5);
    for (int i = 0; i < count; ++i) {
        const double a = kTurn * (i + 0.25) / count;
        const double b = kTurn * (i + 0.75) / count;
        const Point ray[] = {centre,
                             centre + Point{4 * cosine(a), 4 * sine(a)},
                             centre + Point{4 * cosine(b), 4 * sine(b)}};
        f.canvas.polygon(ray, f.main);
    }
    f.canvas.disc(centre, 0.25, f.light);
    f.canvas.disc(centre, 0.2, f.accent);
}

void quarters(Cloth& f) {
    const Color colors[] = {f.main, f.light, f.other, f.accent};
    const bool checked = f.random.chance(0.35);
    const int columns = checked ? 6 : 2;
    const int rows = checked ? 4 : 2;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            f.canvas.rectangle({f.w() * i / columns, static_cast<double>(j) / rows},
                               {f.w() * (i + 1) / columns, (j + 1.0) / rows},
                               checked ? colors[(i + j) % 2] : colors[(i + 2 * j) % 4]);
    if (checked) return;
    emblem(f, {f.w() * 0.25, 0.25}, 0.12, f.light, f.main);
    emblem(f, {f.w() * 0.75, 0.75}, 0.12, f.light, f.accent);
}

void waves(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.main);
    const Color bands[] = {f.light, f.other, f.light, f.accent};
    for (int i = 0; i < 4; ++i) {
        std::vector<Point> outline{{f.w() + 0.1, 1.1}, {-0.1, 1.1}};
        for (int k = -2; k <= 60; ++k) {
            const double x = f.w() * k / 58;
            outline.push_back(
                {x, 0.42 + 0.15 * i + 0.045 * sine(x * kTurn * 2.2 / f.w() + i * 0.5)});
        }
        f.canvas.polygon(outline, bands[i]);
    }
    emblem(f, {f.w() / 2, 0.22}, 0.13, f.light, f.main);
}

void bordered(Cloth& f) {
    f.canvas.rectangle({0, 0}, {f.w(), 1}, f.accent);
    f.canvas.rectangle({0.09, 0.09}, {f.w() - 0.09, 0.91}, f.light);
    f.canvas.rectangle({0.13, 0.13}, {f.w() - 0.13, 0.87}, f.main);
    const Point diamond[] = {
        {f.w() / 2, 0.17}, {f.w() - 0.2, 0.5}, {f.w() / 2, 0.83}, {0.2, 0.5}};
    f.canvas.polygon(diamond, f.light);
    emblem(f, {f.w() / 2, 0.5}, 0.17, f.other, f.light);
}

// Height of the cloth towards the viewer and its slope, where the wind moves it.
struct Wind {
    double frequency;
    double slant;
    double phase;
    double strength;
    std::uint32_t seed;

    [[nodiscard]] double height(Point p) const {
        const double along = p.x * frequency + p.y * slant;
        return strength * (sine(along * kTurn + phase) +
                           0.35 * sine(along * kTurn * 2.3 + 1.7 * phase) +
                           0.3 * noise(p.x * 2.4, p.y * 2.4, seed));
    }
};

// Lays the flat cloth over the canvas: corner, width and height in the canvas.
void fly(Canvas& canvas,
         const Canvas& cloth,
         Point corner,
         Point size,
         const Wind& wind,
         bool pinned) {
    canvas.rework([&](Point p, const Color& below) {
        const Point q{(p.x - corner.x) / size.x, (p.y - corner.y) / size.y};
        const Point on{q.x * cloth.aspect(), q.y};
        const double hold = pinned ? smoothstep(0.0, 0.4, q.x) : 1;
        const double h = wind.height(on);
        const Point at{on.x + 0.05 * h * hold, on.y + 0.13 * h * hold};
        const double edge = canvas.pixel() / size.y;
        const double inside =
            clamp01(0.5 + std::min({q.x, 1 - q.x}) * size.x / canvas.pixel()) *
            clamp01(0.5 + std::min(at.y, 1 - at.y) / edge);
        if (inside <= 0) return below;
        const double slope =
            (wind.height({on.x + 0.01, on.y + 0.004}) - h) / 0.01 * (0.4 + 0.6 * hold);
        const double light = clamp(0.86 - 0.085 * slope, 0.25, 1.25);
        const double sheen = power(clamp01(0.5 - 0.07 * slope), 6) * 0.25;
        const double weave = 1 + 0.02 * noise(on.x * 230, on.y * 230, wind.seed);
        const Color c = cloth.sample(at) * (light * weave) + Color{1, 0.98, 0.94} * sheen;
        return mix(below, c, inside);
    });
}

}  // namespace

Label paint_flag(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const double turn_about = random.pick({0.5, 0.33, -0.28, 0.42});
    const double hue = commission.hue;
    const bool deep = random.chance(0.25);
    Canvas flat(static_cast<int>(canvas.height() * std::max(1.3, canvas.aspect())),
                canvas.height());
    Cloth cloth{
        flat,
        random,
        oklch(deep ? 0.3 : random.between(0.48, 0.62), deep ? 0.1 : 0.2, hue),
        random.chance(0.6) ? Color{0.92, 0.92, 0.9}
                           : oklch(0.88, 0.17, random.pick({kGold, kYellow, hue + 0.2})),
        oklch(random.between(0.34, 0.6), 0.19, hue + turn_about),
        oklch({random.between(0.68, 0.84), 0.18, hue + random.pick({0.2, -0.2, 0.5})})};
    struct Design {
        void (*draw)(Cloth&);
        const char* title;
    };
    static constexpr std::array<Design, 11> kDesigns = {{{tricolour, "tricolour"},
                                                         {nordic_cross, "cross"},
                                                         {rays, "rays"},
                                                         {canton, "stars and stripes"},
                                                         {disc_on_field, "disc"},
                                                         {saltire, "saltire"},
                                                         {hoist_triangle, "triangle"},
                                                         {waves, "waves"},
                                                         {quarters, "quarters"},
                                                         {diagonal, "diagonal"},
                                                         {bordered, "diamond"}}};
    const Design& design =
        kDesigns[static_cast<std::size_t>(commission.turn) % kDesigns.size()];
    design.draw(cloth);

    const Wind wind{random.between(0.7, 1.5),
                    random.between(-0.5, 0.6),
                    random.between(0, kTurn),
                    random.between(0.35, 0.75),
                    random.noise_seed()};
    const bool on_pole = commission.turn % 3 == 1;
    if (!on_pole) {
        // Larger than the picture, so that no edge of the cloth shows.
        fly(canvas, flat, {-0.04, -0.17}, {canvas.aspect() + 0.08, 1.34}, wind, false);
        return {std::string("Flag with ") + design.title, {"flag", design.title}};
    }
    const Sky sky = make_sky(
        random,
        random.pick({Hour::kNoon, Hour::kMorning, Hour::kSunset, Hour::kGoldenHour}),
        canvas.aspect(),
        1.1);
    paint_sky(canvas, sky, 1.1, random);
    const double pole = canvas.aspect() * 0.12;
    canvas.line({pole, 0.06}, {pole, 1.1}, 0.014, {0.55, 0.55, 0.58});
    canvas.line({pole - 0.004, 0.06}, {pole - 0.004, 1.1}, 0.004, {1.1, 1.1, 1.1});
    canvas.disc({pole, 0.055}, 0.028, oklch(0.8, 0.15, kGold));
    const double width = canvas.aspect() * random.between(0.7, 0.82);
    const double height = std::min(0.66, width / flat.aspect());
    fly(canvas, flat, {pole + 0.012, 0.14}, {width, height}, wind, true);
    return {std::string("Flag with ") + design.title + " on a pole",
            {"flag", design.title, "sky"}};
}

}  // namespace haarmony::gallery
