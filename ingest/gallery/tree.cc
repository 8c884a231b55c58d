#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "ingest/gallery/blossom.h"
#include "ingest/gallery/lsystem.h"
#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/sky.h"
#include "ingest/gallery/terrain.h"

namespace haarmony::gallery {
namespace {

struct Kindred {
    const char* title;
    Grammar grammar;
    int generations;
    Turtle turtle;
};

// Stochastic relatives of the bracketed systems of the book's figures 1.24 and 1.27.
const Kindred& kindred(int which) {
    static const std::array<Kindred, 5> kAll = {{
        {"Broad tree",
         {"FFX", {{'X', {"F[--X][+X]", "F[-X][++X]", "F[-X]F[+X]X"}}}},
         7,
         {.angle = 0.34, .wander = 0.1, .shrink = 0.85, .lift = -0.02}},
        {"Slender tree",
         {"FFX", {{'X', {"F[-X]F[+X]FX", "F[+X]F[-X]FX"}}}},
         5,
         {.angle = 0.62, .wander = 0.08, .shrink = 0.66, .lift = 0.04}},
        {"Round tree",
         {"FX", {{'X', {"F[-X][X][+X]", "F[-X][++X]F[X]", "F[--X][+X]F[X]"}}}},
         5,
         {.angle = 0.42, .wander = 0.1, .shrink = 0.8, .lift = -0.03}},
        {"Weed",
         {"F", {{'F', {"F[+FX]F[-FX]F", "F[+FX]F", "F[-FX]F"}}}},
         4,
         {.angle = 0.45, .wander = 0.06, .shrink = 0.9, .lift = 0.05}},
        {"Fern",
         {"X", {{'X', {"F[+Y][-Y]X"}}, {'Y', {"FL[+FL][-FL]Y"}}}},
         14,
         {.angle = 1.05, .wander = 0.02, .shrink = 0.4, .lift = -0.015}},
    }};
    return kAll[static_cast<std::size_t>(which) % kAll.size()];
}

Plant plant_of(const Kindred& kin, Random& random) {
    constexpr std::size_t kMostSymbols = 14000;
    const Grammar ripening{rewrite(kin.grammar, kin.generations, kMostSymbols, random),
                           {{'X', {"L", "LL", "*L"}}}};
    return grow(rewrite(ripening, 1, 2 * kMostSymbols, random), kin.turtle, random);
}

void draw_wood(Canvas& canvas,
               const Plant& plant,
               double thickness,
               const Color& lit,
               const Color& dark) {
    const auto radius = [&](const Twig& twig) {
        const double taper =
            power(0.66, twig.depth) * (1 - 0.5 * (twig.depth == 0 ? twig.age : 0));
        return std::max(thickness * taper, canvas.pixel() * 0.35);
    };
    for (const Twig& twig : plant.twigs)
        canvas.line(twig.from, twig.to, radius(twig), dark);
    for (const Twig& twig : plant.twigs) {
        const double r = radius(twig);
        if (r < 1.5 * canvas.pixel()) continue;
        const Point aside{r * 0.35, 0};
        canvas.line(twig.from - aside, twig.to - aside, r * 0.4, lit, 0.6);
    }
}

struct Foliage {
    std::vector<Color> leaves;
    Color blossom;
    double size;
    double density;
};

// Small and many: a plain outline is enough, and quick.
void draw_leaf(Canvas& canvas,
               Point root,
               double angle,
               double size,
               const Color& color) {
    const double c = cosine(angle) * size;
    const double s = sine(angle) * size;
    const auto place = [&](double x, double y) {
        return root + Point{x * c - y * s, x * s + y * c};
    };
    const Point outline[] = {root,
                             place(-0.24, -0.3),
                             place(-0.22, -0.65),
                             place(0, -1),
                             place(0.22, -0.65),
                             place(0.24, -0.3)};
    canvas.polygon(outline, color);
}

void draw_foliage(Canvas& canvas,
                  const Plant& plant,
                  const Foliage& foliage,
                  const Color& light,
                  Random& random) {
    // Colours are made once: a shade costs more than a leaf.
    std::vector<Color> shades;
    for (const double tone : {0.62, 0.76, 0.9, 1.0, 1.12})
        for (const Color& leaf : foliage.leaves)
            shades.push_back(shade_of(leaf, tone) * light);
    const std::size_t hues = foliage.leaves.size();
    const Color petal = foliage.blossom * light;
    const Color heart = oklch(0.85, 0.16, kGold) * light;
    constexpr int kLayers = 5;
    for (int layer = 0; layer < kLayers; ++layer) {
        for (const Bud& bud : plant.buds) {
            if (!random.chance(foliage.density)) continue;
            const double size = foliage.size * random.between(0.6, 1.3);
            const Point at =
                bud.at + Point{random.bell() * size * 0.8,
                               (random.bell() + 0.8 - 0.4 * layer) * size * 0.7};
            if (bud.blossom && layer == kLayers - 1) {
                const double start = random.between(0, kTurn);
                for (int k = 0; k < 5; ++k)
                    draw_leaf(canvas, at, start + kTurn * k / 5, size * 1.2, petal);
                canvas.disc(at, size * 0.25, heart);
                continue;
            }
            const auto hue =
                static_cast<std::size_t>(random.below(static_cast<int>(hues)));
            draw_leaf(canvas,
                      at,
                      bud.heading + random.bell(),
                      size * 1.4,
                      shades[static_cast<std::size_t>(layer) * hues + hue]);
        }
    }
}

Foliage foliage_of(Random& random, double hue, int season, double size) {
    switch (season) {
        case 0:  // blossom
            return {
                {oklch(0.86, 0.1, hue), oklch(0.93, 0.06, hue), oklch(0.7, 0.17, hue)},
                oklch(0.92, 0.08, hue),
                size,
                1};
        case 1:  // summer
            return {{oklch(0.5, 0.13, kGreen),
                     oklch(0.62, 0.15, kLime + 0.02),
                     oklch(0.42, 0.1, kGreen + 0.03)},
                    oklch(0.7, 0.22, hue),
                    size,
                    1};
        case 2:  // autumn
            return {{oklch(0.6, 0.2, kRed),
                     oklch(0.7, 0.18, kOrange),
                     oklch(0.82, 0.17, kGold)},
                    oklch(0.55, 0.22, kRed),
                    size,
                    random.between(0.6, 1)};
        default:  // a tree of fancy
            return {{oklch(0.6, 0.18, hue),
                     oklch(0.72, 0.16, hue + 0.08),
                     oklch(0.5, 0.18, hue - 0.08)},
                    oklch(0.85, 0.16, hue + 0.5),
                    size,
                    1};
    }
}

Label tree_in_country(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    static constexpr Hour kHoursOfTree[] = {Hour::kNoon,
                                            Hour::kSunset,
                                            Hour::kMorning,
                                            Hour::kGoldenHour,
                                            Hour::kNight,
                                            Hour::kStorm,
                                            Hour::kDusk};
    const Hour hour = kHoursOfTree[static_cast<std::size_t>(commission.turn / 2) %
                                   std::size(kHoursOfTree)];
    const double horizon = random.between(0.68, 0.8);
    const Sky sky = make_sky(random, hour, canvas.aspect(), horizon);
    paint_sky(canvas, sky, horizon, random);
    const int season = commission.turn / 2 % 4;
    const double ground =
        season == 2 ? kGold : (season == 3 ? commission.hue + 0.5 : kLime + 0.03);
    paint_range(canvas,
                sky,
                {.base = horizon,
                 .height = 0.12,
                 .sharpness = 0.2,
                 .distance = 0.6,
                 .rock = oklch(0.4, 0.06, kGreen),
                 .grass = oklch(0.5, 0.1, kGreen),
                 .seed = random.noise_seed()});
    paint_hill(canvas,
               sky,
               {.base = horizon + 0.08,
                .height = 0.05,
                .lit = oklch(0.72, 0.14, ground),
                .shaded = oklch(0.42, 0.1, ground + 0.03),
                .seed = random.noise_seed()});
    const Point foot{canvas.aspect() * random.between(0.35, 0.65),
                     horizon + random.between(0.1, 0.16)};
    Mask shadow = cover_ellipse(canvas.frame(),
                                foot + Point{sky.sun.x > foot.x ? -0.1 : 0.1, 0.015},
                                0.27,
                                0.028,
                                0);
    canvas.glaze(soften(canvas.frame(), shadow, 0.012), {0.2, 0.22, 0.3}, 0.65);
    const Kindred& kin = kindred(commission.turn / 4 % 3);
    const Plant plant =
        fitted(plant_of(kin, random), foot, canvas.aspect() * 0.92, foot.y - 0.07);
    const Color light = sky.sunlight * 0.75 + sky.ambient + Color{0.05, 0.05, 0.06};
    draw_wood(canvas,
              plant,
              random.between(0.018, 0.026),
              oklch(0.5, 0.06, 0.16) * light,
              oklch(0.27, 0.04, 0.12) * light);
    const Foliage foliage = foliage_of(random, commission.hue, season, 0.019);
    draw_foliage(canvas, plant, foliage, light, random);
    for (int i = 0; i < 40; ++i) {
        const Point p{foot.x + random.bell() * 0.2,
                      foot.y + 0.01 + std::fabs(random.bell()) * 0.04};
        canvas.disc(p,
                    random.between(0.002, 0.005),
                    foliage.leaves[static_cast<std::size_t>(i) % 3] * light);
    }
    return {std::string(kin.title) + " " + sky.when(), {"tree", "plant", sky.tag()}};
}

// Plants side by side on paper, as in a herbarium.
Label herbarium(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const bool dark = random.chance(0.4);
    const Ramp paper{oklch(dark ? 0.22 : 0.95, 0.05, commission.hue + 0.45),
                     oklch(dark ? 0.34 : 0.86, 0.08, commission.hue + 0.4)};
    const std::uint32_t seed = random.noise_seed();
    canvas.cover([&](Point p) {
        return paper.at(p.y * 0.7 + 0.25 * noise(p.x * 1.5, p.y * 1.5, seed)) *
               (1 + 0.03 * noise(p.x * 90, p.y * 90, seed));
    });
    const int count = canvas.aspect() > 0.9 ? 3 + random.below(2) : 2;
    for (int i = 0; i < count; ++i) {
        const Kindred& kin = kindred(2 + (commission.turn + i) % 3);
        const Point foot{canvas.aspect() * (i + 0.5) / count, 0.96};
        const Plant wild = plant_of(kin, random);
        const Plant plant =
            fitted(wild, foot, canvas.aspect() / count * 1.25, random.between(0.7, 0.88));
        const Color green =
            oklch(dark ? 0.62 : 0.42, 0.11, kGreen + random.between(-0.06, 0.06));
        draw_wood(canvas, plant, 0.007, shade_of(green, 1.2), green);
        const Foliage foliage = foliage_of(
            random, commission.hue + 0.13 * i, (commission.turn + i) % 4, 0.02);
        draw_foliage(canvas, plant, foliage, {1, 1, 1}, random);
    }
    return {"Herbarium", {"plant", "leaves", "flowers"}};
}

// Fronds that fill the picture, light falling through from above.
Label undergrowth(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const double green =
        random.chance(0.65) ? random.between(kLime, kTeal) : commission.hue;
    const Ramp air{oklch(0.93, 0.1, green - 0.06),
                   oklch(0.6, 0.13, green),
                   oklch(0.2, 0.07, green + 0.05)};
    const Point source{canvas.aspect() * random.between(0.2, 0.8),
                       random.between(-0.1, 0.25)};
    canvas.cover([&](Point p) { return air.at(length(p - source) * 0.95); });
    const Kindred& fern = kindred(4);
    constexpr int kFerns = 6;
    for (int i = 0; i < kFerns; ++i) {
        const double t = (i + 0.5) / kFerns;
        const Point foot{canvas.aspect() * fraction(0.2 + i * 0.618), 1.08};
        const double height = mix(1.0, 0.62, t) * random.between(0.75, 1.05);
        const Plant plant = fitted(plant_of(fern, random), {0, 0}, height, height);
        const double lean = random.between(-0.55, 0.55);
        const auto place = [&](Point p) {
            return foot + turned(p, lean - p.y * lean * 0.9);
        };
        const Color c = mix(
            air.at(0.3),
            oklch({random.between(0.36, 0.6), 0.14, green + random.between(-0.05, 0.05)}),
            0.2 + 0.8 * t);
        const Color pale = shade_of(c, 1.15);
        for (const Twig& twig : plant.twigs)
            canvas.line(place(twig.from),
                        place(twig.to),
                        (twig.depth == 0 ? 0.006 : 0.0018) * height,
                        shade_of(c, 0.8));
        for (std::size_t k = 0; k < plant.buds.size(); ++k)
            draw_leaf(canvas,
                      place(plant.buds[k].at),
                      plant.buds[k].heading + lean,
                      0.047 * height,
                      k % 2 == 0 ? c : pale);
    }
    for (int i = 0; i < 5; ++i) {
        const Point at{canvas.aspect() * random.between(0.1, 0.9),
                       random.between(0.55, 0.92)};
        const auto species = static_cast<Species>(random.below(kSpecies));
        paint_blossom(canvas,
                      species,
                      at,
                      random.between(0.03, 0.08),
                      commission.hue + 0.4,
                      random);
    }
    return {"Undergrowth", {"plant", "fern", "forest"}};
}

}  // namespace

Label paint_tree(Canvas& canvas, Commission& commission) {
    static constexpr std::array kScenes = {
        tree_in_country, herbarium, tree_in_country, undergrowth};
    Label label = kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](
        canvas, commission);
    label.tags.erase(std::remove(label.tags.begin(), label.tags.end(), "plant"),
                     label.tags.end());
    label.tags.insert(label.tags.begin(), "plant");
    return label;
}

}  // namespace haarmony::gallery
