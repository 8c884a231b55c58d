#include <algorithm>
#include <array>
#include <vector>

#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/scene.h"
#include "ingest/gallery/staffage.h"
#include "ingest/gallery/terrain.h"

namespace haarmony::gallery {
namespace {

constexpr int kScenes = 8;  // that take turns

// Down to `floor`, below which something nearer hides them.
void ranges(Scene& s,
            int count,
            double base,
            double height,
            double sharpness,
            double snow,
            double floor) {
    const double hue = s.random.pick({0.08, 0.15, 0.7, 0.8, 0.4});
    for (int i = 0; i < count; ++i) {
        const double near = count == 1 ? 0.6 : static_cast<double>(i) / (count - 1);
        paint_range(
            s.canvas,
            s.sky,
            {.base = mix(base, base + 0.05, near),
             .height = height * mix(1.0, 0.55, near) * s.random.between(0.85, 1.2),
             .frequency = mix(1.0, 1.9, near) * s.random.between(0.8, 1.2),
             .sharpness = sharpness,
             .distance = mix(0.62, 0.12, near),
             .snow = snow * mix(1.0, 0.7, near),
             .rock = oklch(mix(0.55, 0.46, near), 0.05, hue),
             .grass = oklch(0.50, 0.09, kGreen + s.random.between(-0.06, 0.03)),
             .floor = floor,
             .seed = s.random.noise_seed()});
    }
}

void conifers_along(Scene& s, double y, double size, int count, double snow) {
    const Color light = s.sky.sunlight + s.sky.ambient;
    const Color lit =
        mix(oklch(0.48, 0.09, kGreen), Color{0.8, 0.85, 0.95}, snow) * light;
    const Color shaded = oklch(0.24, 0.06, kTeal) * light;
    for (int i = 0; i < count; ++i) {
        const Point at{s.random.between(-0.05, s.canvas.aspect() + 0.05),
                       y + size * s.random.between(-0.05, 0.12)};
        paint_conifer(
            s.canvas, at, size * s.random.between(0.6, 1.15), lit, shaded, s.random);
    }
}

Label mountain_lake(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kMorning, Hour::kGoldenHour, Hour::kNoon, Hour::kDusk},
                          0.54,
                          0.66);
    const double height = s.random.between(0.3, 0.44);
    ranges(s, 3, s.horizon, height, 1, s.random.between(0.3, 0.75), s.horizon + 0.05);
    conifers_along(s, s.horizon + 0.012, 0.07, 90, 0);
    const Color water =
        oklch(0.42, 0.09, s.random.pick({kTeal, kCyan, kSkyBlue, kBlue})) *
        (s.sky.sunlight * 0.8 + s.sky.ambient);
    paint_water(canvas, s.horizon + 0.02, water, s.random.between(0.35, 1.2), s.sky.seed);
    if (s.random.chance(0.5)) {
        const double side = s.random.chance(0.5) ? 0.08 : 0.92;
        for (int i = 0; i < 5; ++i) {
            const Point at{canvas.aspect() * side + s.random.bell() * 0.07, 1.04};
            paint_conifer(canvas,
                          at,
                          s.random.between(0.35, 0.62),
                          oklch(0.38, 0.08, kGreen) * s.sky.sunlight,
                          oklch(0.18, 0.05, kTeal),
                          s.random);
        }
    } else {
        paint_sail_boat(
            canvas,
            {canvas.aspect() * s.random.between(0.25, 0.75), s.horizon + 0.13},
            0.13,
            oklch(0.8, 0.17, s.hue),
            oklch(0.4, 0.1, s.hue + 0.5),
            s.sky);
    }
    return {"Mountain lake " + s.sky.when(), {"mountains", "lake", s.sky.tag()}};
}

Label meadow(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kNoon, Hour::kGoldenHour, Hour::kMorning, Hour::kStorm},
                          0.46,
                          0.6);
    ranges(s, 2, s.horizon, 0.16, 0.4, 0, s.horizon + 0.15);
    const double green = s.random.between(kLime - 0.02, kGreen + 0.02);
    for (int i = 0; i < 3; ++i) {
        const double t = i / 2.0;
        paint_hill(canvas,
                   s.sky,
                   {.base = mix(s.horizon + 0.05, 0.86, t),
                    .height = 0.09,
                    .frequency = mix(1.4, 0.8, t),
                    .lit = oklch(0.72, 0.16, green),
                    .shaded = oklch(0.46, 0.11, green + 0.03),
                    .seed = s.random.noise_seed()});
        for (int k = 0; k < 4 && i < 2; ++k) {
            const Point at{s.random.between(0, canvas.aspect()),
                           mix(s.horizon + 0.06, 0.82, t) + 0.01};
            const double size = mix(0.07, 0.2, t) * s.random.between(0.7, 1.2);
            paint_round_tree(canvas,
                             at,
                             size,
                             oklch(0.5, 0.12, green + s.random.between(-0.02, 0.03)),
                             s.sky,
                             s.random);
        }
    }
    paint_house(canvas,
                {canvas.aspect() * s.random.between(0.2, 0.8), s.horizon + 0.09},
                0.08,
                oklch(0.93, 0.03, 0.2),
                oklch(0.5, 0.16, kRed),
                s.sky);
    const Color petals[] = {oklch(0.66, 0.23, s.hue),
                            oklch(0.95, 0.05, s.hue),
                            oklch(0.85, 0.17, s.hue + 0.15)};
    const Color light = s.sky.sunlight + s.sky.ambient;
    for (int i = 0; i < 900; ++i) {
        const double t = power((i + 0.5) / 900, 0.7);
        const Point p{s.random.between(0, canvas.aspect()), mix(0.72, 1.02, t)};
        if (noise(p.x * 3, p.y * 6, s.sky.seed) < -0.1) continue;
        const Color c = s.random.pick(petals) * light;
        const double r = mix(0.002, 0.011, t) * s.random.between(0.6, 1.2);
        canvas.disc(p, r, c * s.random.between(0.75, 1.1));
        if (r > 0.006) canvas.disc(p, r * 0.35, Color{0.9, 0.6, 0.1} * light);
    }
    return {"Meadow " + s.sky.when(), {"meadow", "flowers", "hills", s.sky.tag()}};
}

Label desert(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kGoldenHour, Hour::kNoon, Hour::kSunset, Hour::kNight},
                          0.36,
                          0.56);
    ranges(s, 1, s.horizon + 0.02, 0.12, 0.7, 0, s.horizon + 0.1);
    const Color sand =
        oklch({s.random.between(0.66, 0.84), 0.13, s.random.between(0.11, 0.22)});
    paint_dunes(canvas, s.sky, s.horizon, 6, sand, s.random.noise_seed());
    if (s.random.chance(0.6)) {
        const int palms = 2 + s.random.below(4);
        const double x = canvas.aspect() * s.random.between(0.2, 0.8);
        for (int i = 0; i < palms; ++i) {
            const Point at{x + s.random.bell() * 0.06, s.horizon + 0.2};
            const double size = s.random.between(0.14, 0.24);
            paint_palm(canvas,
                       at,
                       size,
                       s.random.between(-0.3, 0.3),
                       oklch(0.42, 0.1, kGreen) * (s.sky.sunlight + s.sky.ambient),
                       s.random);
        }
    }
    return {"Dunes " + s.sky.when(), {"desert", "dunes", s.sky.tag()}};
}

Label flower_rows(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kNoon, Hour::kSunset, Hour::kMorning, Hour::kGoldenHour},
                          0.34,
                          0.52);
    ranges(s, 1, s.horizon + 0.01, 0.1, 0.3, 0, s.horizon + 0.02);
    const bool lavender = s.random.chance(0.3);
    std::vector<Color> colors;
    if (lavender) {
        colors = {oklch(0.52, 0.17, kViolet), oklch(0.58, 0.16, kViolet + 0.02)};
    } else {
        for (const double offset : {0.0, 0.18, -0.13, 0.3})
            colors.push_back(oklch(s.random.between(0.6, 0.82), 0.21, s.hue + offset));
    }
    paint_rows(canvas, s.sky, s.horizon, colors, s.random);
    for (int i = 0; i < 14; ++i) {
        const Point at{s.random.between(0, canvas.aspect()), s.horizon + 0.008};
        paint_round_tree(canvas,
                         at,
                         s.random.between(0.025, 0.06),
                         oklch(0.45, 0.1, kGreen),
                         s.sky,
                         s.random);
    }
    const int balloons = s.random.below(4);
    for (int i = 0; i < balloons; ++i) {
        const Point at{canvas.aspect() * s.random.between(0.1, 0.9),
                       s.horizon * s.random.between(0.45, 0.9)};
        paint_balloon(
            canvas, at, s.random.between(0.08, 0.24), s.hue + i * 0.31, s.sky, s.random);
    }
    return {std::string(lavender ? "Lavender " : "Tulip fields ") + s.sky.when(),
            {"field", "flowers", s.sky.tag()}};
}

Label winter(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kNight, Hour::kMorning, Hour::kNoon, Hour::kSunset},
                          0.5,
                          0.64);
    ranges(s, 3, s.horizon, s.random.between(0.24, 0.4), 1, 1, s.horizon + 0.2);
    const Color snow{0.86, 0.9, 1.0};
    conifers_along(s, s.horizon + 0.05, 0.1, 70, 0.25);
    for (int i = 0; i < 2; ++i) {
        paint_hill(canvas,
                   s.sky,
                   {.base = mix(s.horizon + 0.09, 0.88, i),
                    .height = 0.07,
                    .frequency = 1.1,
                    .lit = snow,
                    .shaded = Color{0.45, 0.55, 0.85},
                    .texture = 0.15,
                    .seed = s.random.noise_seed()});
        for (int k = 0; k < 3 && i == 0; ++k) {
            const Point at{canvas.aspect() * (0.3 + 0.2 * k) + s.random.bell() * 0.03,
                           s.horizon + 0.12};
            paint_house(canvas,
                        at,
                        0.07,
                        oklch(0.5, 0.13, s.random.pick({kRed, kOrange, kGold, kBlue})),
                        snow,
                        s.sky);
        }
        conifers_along(
            s, mix(s.horizon + 0.13, 0.97, i), mix(0.13, 0.34, i), 9 - 3 * i, 0.6);
    }
    return {"Winter valley " + s.sky.when(),
            {"winter", "snow", "mountains", s.sky.tag()}};
}

Label autumn(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kGoldenHour, Hour::kNoon, Hour::kStorm, Hour::kMorning},
                          0.42,
                          0.56);
    ranges(s, 2, s.horizon, 0.2, 0.5, 0, 1);
    static constexpr double kLeaves[] = {kRed, 0.1, kOrange, kGold, kGold, kYellow};
    for (int row = 0; row < 3; ++row) {
        const double t = row / 3.0;
        const double y = mix(s.horizon + 0.03, 0.86, t);
        for (int i = 0; i < 16 - 4 * row; ++i) {
            const Point at{s.random.between(-0.05, canvas.aspect() + 0.05),
                           y + 0.02 * s.random.unit()};
            const double size = mix(0.1, 0.34, t) * s.random.between(0.75, 1.2);
            const Color leaf =
                oklch({s.random.between(0.52, 0.74), 0.17, s.random.pick(kLeaves)});
            paint_round_tree(canvas, at, size, leaf, s.sky, s.random);
        }
    }
    if (s.random.chance(0.6)) {
        paint_water(
            canvas, 0.68, oklch(0.33, 0.06, kCyan) * s.sky.sunlight, 0.8, s.sky.seed);
    } else {
        paint_hill(canvas,
                   s.sky,
                   {.base = 0.8,
                    .height = 0.06,
                    .lit = oklch(0.7, 0.13, kGold),
                    .shaded = oklch(0.45, 0.1, kOrange),
                    .seed = s.random.noise_seed()});
        const Point at{canvas.aspect() * s.random.between(0.15, 0.85), 0.93};
        const double size = s.random.between(0.5, 0.72);
        paint_round_tree(
            canvas, at, size, oklch(0.62, 0.2, s.random.pick(kLeaves)), s.sky, s.random);
    }
    return {"Autumn " + s.sky.when(), {"autumn", "trees", s.sky.tag()}};
}

Label misty_ridges(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kSunset, Hour::kMorning, Hour::kDusk, Hour::kGoldenHour},
                          0.5,
                          0.66);
    constexpr int kLayers = 7;
    const Color near = oklch(0.2, 0.08, s.hue);
    for (int i = 0; i < kLayers; ++i) {
        const double t = static_cast<double>(i) / (kLayers - 1);
        const Color tone = mix(s.sky.haze, near, power(t, 0.8));
        const Range range{.base = mix(s.horizon, 1.02, t),
                          .height = mix(0.13, 0.2, t),
                          .frequency = mix(1.2, 2.2, t),
                          .sharpness = 0.35,
                          .seed = s.random.noise_seed()};
        Canvas& c = canvas;
        for (int x = 0; x < c.width(); ++x) {
            const double crest =
                range.crest(c.point(x, 0).x) -
                (i > 3 ? 0.016 * t * clamp01(noise(c.point(x, 0).x * 70, t, range.seed))
                       : 0);
            for (int y = std::max(0, floor_int(crest * c.height())); y < c.height();
                 ++y) {
                const double depth = c.point(x, y).y - crest;
                const double cover = clamp01(depth * c.height() + 0.5);
                const Color mist = mix(
                    tone, s.sky.haze, 0.7 * smoothstep(0.0, 0.24, depth) * (1 - t * 0.6));
                c.set(x, y, mix(c.at(x, y), mist, cover));
            }
        }
    }
    paint_birds(canvas,
                {canvas.aspect() * s.random.between(0.3, 0.7), s.horizon * 0.5},
                6,
                near,
                s.random);
    return {"Misty ridges " + s.sky.when(), {"mountains", "mist", s.sky.tag()}};
}

Label balloons(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(canvas,
                          commission,
                          kScenes,
                          {Hour::kMorning, Hour::kNoon, Hour::kSunset, Hour::kGoldenHour},
                          0.7,
                          0.82);
    ranges(s, 3, s.horizon, 0.2, s.random.between(0.2, 1), 0.1, 1);
    paint_hill(canvas,
               s.sky,
               {.base = 0.92,
                .height = 0.07,
                .lit = oklch(0.68, 0.13, s.random.between(kGold, kGreen)),
                .shaded = oklch(0.42, 0.09, kGreen),
                .seed = s.random.noise_seed()});
    const int count = 5 + s.random.below(6);
    for (int i = 0; i < count; ++i) {
        const double t = static_cast<double>(i) / (count - 1);
        paint_balloon(
            canvas,
            {canvas.aspect() * fraction(0.17 + i * 0.618 + s.random.between(-0.05, 0.05)),
             s.random.between(0.35, 0.8)},
            mix(0.08, 0.44, t * t),
            s.hue + i * 0.137,
            s.sky,
            s.random);
    }
    return {"Balloons " + s.sky.when(), {"balloons", "sky", s.sky.tag()}};
}

}  // namespace

Label paint_landscape(Canvas& canvas, Commission& commission) {
    static constexpr std::array kScenes = {mountain_lake,
                                           flower_rows,
                                           winter,
                                           desert,
                                           autumn,
                                           misty_ridges,
                                           meadow,
                                           balloons};
    Label label = kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](
        canvas, commission);
    label.tags.insert(label.tags.begin(), "landscape");
    return label;
}

}  // namespace haarmony::gallery
