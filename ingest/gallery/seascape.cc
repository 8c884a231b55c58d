#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"
#include "ingest/gallery/reef.h"
#include "ingest/gallery/scene.h"
#include "ingest/gallery/staffage.h"
#include "ingest/gallery/terrain.h"

namespace haarmony::gallery {
namespace {

constexpr int kScenes = 6;  // that take turns

// Open water from the horizon down: waves in perspective that mirror the sky's ramp, the
// glitter of the sun, foam on the crests when it is rough (0 calm .. 1 gale).
void open_sea(Scene& s, const Color& deep, const Color& shallow, double rough) {
    const std::uint32_t seed = s.random.noise_seed();
    Canvas& canvas = s.canvas;
    const Color light = s.sky.sunlight * 0.6 + s.sky.ambient * 0.9;
    for (int y = std::max(0, floor_int(s.horizon * canvas.height())); y < canvas.height();
         ++y) {
        const double depth = std::max(0.002, canvas.point(0, y).y - s.horizon);
        const double near = depth / (1 - s.horizon);
        const double z = 0.16 / (depth + 0.015);
        for (int x = 0; x < canvas.width(); ++x) {
            const Point p = canvas.point(x, y);
            const double u = (p.x - 0.6) * z * 3.2;
            const double v = z * 9;
            const double swell = noise(u * 0.35 + 4, v * 0.5, seed);
            const double wave = 0.6 * swell + 0.5 * noise(u + swell, v * 1.6, seed + 1) +
                                0.3 * noise(u * 2.7, v * 4.1, seed + 2);
            // A face turned to us shows the water, one turned away the sky above.
            const double mirror = clamp01(0.78 - 0.55 * near + 0.42 * wave);
            Color c =
                mix(mix(deep, shallow, clamp01(0.35 + 0.6 * wave + 0.25 * near)) * light,
                    s.sky.ramp.at(clamp01(0.98 - 0.75 * near - 0.2 * wave)),
                    mirror * (0.9 - 0.45 * rough));
            const double spread = 0.05 + 0.32 * near;
            const double off = (p.x - s.sky.sun.x) / spread;
            const double glitter = exponential(-off * off) *
                                   smoothstep(0.25, 0.75, wave + 0.35 * (1 - near));
            if (s.sky.hour != Hour::kStorm) c = c + s.sky.sunlight * (1.5 * glitter);
            const double foam = smoothstep(
                0.62 - 0.3 * rough, 0.95, wave + 0.25 * noise(u * 9, v * 9, seed + 5));
            c = mix(c,
                    Color{0.9, 0.93, 0.95} * (light + Color{0.25, 0.25, 0.25}),
                    foam * rough * smoothstep(0.02, 0.3, near));
            const double edge = clamp01((p.y - s.horizon) * canvas.height() + 0.5);
            canvas.set(x, y, mix(canvas.at(x, y), c, edge));
        }
    }
}

Label sailing(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(
        canvas,
        commission,
        kScenes,
        {Hour::kSunset, Hour::kNoon, Hour::kMorning, Hour::kGoldenHour, Hour::kDusk},
        0.4,
        0.62);
    const double water = s.random.pick({kTeal, kCyan, kSkyBlue, kBlue});
    open_sea(s, oklch(0.35, 0.11, water), oklch(0.66, 0.12, water - 0.05), 0.15);
    const int boats = 1 + s.random.below(5);
    for (int i = 0; i < boats; ++i) {
        const double t = boats == 1 ? 0.8 : static_cast<double>(i) / (boats - 1);
        const Point at{
            canvas.aspect() * fraction(s.random.unit() * 0.2 + 0.15 + i * 0.618),
            mix(s.horizon + 0.02, 0.82, t * t)};
        const double size = mix(0.07, 0.5, t * t) * s.random.between(0.8, 1.1);
        const Color sail = s.random.chance(0.4) ? Color{0.93, 0.92, 0.88}
                                                : oklch(0.72, 0.2, s.hue + i * 0.3);
        paint_sail_boat(canvas, at, size, sail, oklch(0.38, 0.13, s.hue + 0.5), s.sky);
    }
    paint_birds(canvas,
                {canvas.aspect() * 0.5, s.horizon * 0.45},
                5,
                {0.05, 0.05, 0.07},
                s.random);
    return {"Sailing " + s.sky.when(), {"sea", "boats", s.sky.tag()}};
}

Label lighthouse(Canvas& canvas, Commission& commission) {
    Scene s =
        begin_scene(canvas,
                    commission,
                    kScenes,
                    {Hour::kDusk, Hour::kStorm, Hour::kNoon, Hour::kSunset, Hour::kNight},
                    0.5,
                    0.64);
    const double water = s.random.pick({kTeal, kSkyBlue, kBlue});
    open_sea(
        s, oklch(0.3, 0.09, water), oklch(0.58, 0.1, water), s.random.between(0.3, 0.9));
    const bool left = s.random.chance(0.5);
    const double foot = s.horizon + 0.16;
    const auto crest = [&](double x) {
        const double from_side = left ? x : canvas.aspect() - x;
        const double fall =
            smoothstep(canvas.aspect() * 0.62, canvas.aspect() * 0.12, from_side);
        return foot + 0.2 - 0.36 * fall + 0.03 * fbm(x * 5, 0.5, 4, s.sky.seed);
    };
    const double at = canvas.aspect() * (left ? 0.24 : 0.76);
    const double height = s.random.between(0.4, 0.5);
    paint_lighthouse(canvas,
                     {at, crest(at) + 0.03},
                     height,
                     oklch(0.5, 0.2, s.random.pick({kRed, s.hue})),
                     s.sky);
    const Color light = s.sky.sunlight * 0.7 + s.sky.ambient;
    for (int x = 0; x < canvas.width(); ++x) {
        const double top = crest(canvas.point(x, 0).x);
        for (int y = std::max(0, floor_int(top * canvas.height())); y < canvas.height();
             ++y) {
            const Point p = canvas.point(x, y);
            const double depth = p.y - top;
            const double rough = ridged(p.x * 6, p.y * 4.5, 4, s.sky.seed + 4);
            const Color grass = oklch(0.5, 0.12, kGreen);
            const Color rock = oklch(0.46, 0.04, 0.15) * (0.35 + 1.1 * rough);
            const Color c = mix(grass * (0.7 + 0.4 * rough),
                                rock,
                                smoothstep(0.0, 0.07, depth - 0.03 * rough)) *
                            light;
            const double bottom = foot + 0.19 - 0.02 * noise(p.x * 9, 0.2, s.sky.seed);
            const double cover = clamp01(depth * canvas.height() + 0.5) *
                                 smoothstep(bottom, bottom - 0.012, p.y);
            const double surf = smoothstep(0.03, 0.0, std::fabs(p.y - bottom)) *
                                smoothstep(0.0, 0.02, depth);
            Color below = mix(canvas.at(x, y), c, cover);
            below = mix(below,
                        Color{0.9, 0.94, 0.96} * (light + Color{0.15, 0.15, 0.15}),
                        0.75 * surf * clamp01(0.6 + noise(p.x * 40, p.y * 40, 3)));
            canvas.set(x, y, below);
        }
    }
    return {"Lighthouse " + s.sky.when(), {"sea", "lighthouse", s.sky.tag()}};
}

Label beach(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(
        canvas,
        commission,
        kScenes,
        {Hour::kNoon, Hour::kSunset, Hour::kMorning, Hour::kNoon, Hour::kGoldenHour},
        0.36,
        0.5);
    open_sea(s, oklch(0.5, 0.12, kSkyBlue), oklch(0.82, 0.12, kTeal), 0.1);
    const std::uint32_t seed = s.random.noise_seed();
    const double slant = s.random.between(-0.3, 0.3);
    const Color sand =
        oklch({0.86, s.random.between(0.05, 0.09), s.random.between(0.16, 0.24)});
    const Color light = s.sky.sunlight * 0.75 + s.sky.ambient * 0.8;
    canvas.rework([&](Point p, const Color& below) {
        const double shore = 0.72 + slant * (p.x - canvas.aspect() / 2) +
                             0.05 * noise(p.x * 2.4, 0.5, seed) +
                             0.012 * noise(p.x * 11, 0.5, seed);
        const double up = p.y - shore;
        if (p.y < s.horizon + 0.03 || up < -0.2) return below;
        // The turquoise of the shallows, two lines of foam, wet sand, dry sand.
        Color c = mix(
            below, oklch(0.86, 0.11, kTeal) * light, 0.75 * smoothstep(-0.2, -0.02, up));
        const double lace = noise(p.x * 30, p.y * 44, seed + 2) * 0.012;
        const double foam =
            smoothstep(0.02, 0.0, std::fabs(up + lace)) +
            0.7 * smoothstep(0.012, 0.0, std::fabs(up + 0.075 + 1.5 * lace));
        const double ripple = 1 + 0.05 * fbm(p.x * 22, p.y * 60, 3, seed + 3);
        const Color ground =
            mix(sand * Color{0.62, 0.58, 0.55}, sand, smoothstep(0.0, 0.11, up)) * light *
            ripple;
        c = mix(c, ground, smoothstep(0.0, 0.008, up));
        return mix(
            c, Color{0.97, 0.98, 0.98} * (light + Color{0.1, 0.1, 0.1}), clamp01(foam));
    });
    const bool left = s.random.chance(0.5);
    const int palms = 2 + s.random.below(2);
    for (int i = 0; i < palms; ++i) {
        const Point at{canvas.aspect() * (left ? 0.1 : 0.9) + s.random.bell() * 0.06,
                       1.0 - 0.05 * i};
        const double size = s.random.between(0.55, 0.8);
        const double lean = (left ? 1 : -1) * s.random.between(0.1, 0.4);
        paint_palm(canvas, at, size, lean, oklch(0.45, 0.12, kGreen) * light, s.random);
    }
    const double x = canvas.aspect() * (left ? 0.66 : 0.34);
    // A parasol and its towel.
    const Color cloth = oklch(0.62, 0.22, s.hue);
    const Point towel[] = {
        {x - 0.1, 0.93}, {x + 0.08, 0.91}, {x + 0.12, 0.95}, {x - 0.07, 0.975}};
    canvas.polygon(towel, oklch(0.75, 0.16, s.hue + 0.4) * light);
    canvas.line({x, 0.72}, {x + 0.02, 0.93}, 0.004, {0.6, 0.55, 0.5});
    for (int gore = 0; gore < 6; ++gore) {
        std::vector<Point> outline{{x, 0.69}};
        for (int k = 0; k <= 6; ++k) {
            const double angle = kPi * (1 + (gore + k / 6.0) / 6);
            outline.push_back({x + 0.13 * cosine(angle), 0.77 + 0.085 * sine(angle)});
        }
        canvas.polygon(outline, (gore % 2 == 0 ? cloth : Color{0.95, 0.94, 0.9}) * light);
    }
    return {"Beach " + s.sky.when(), {"sea", "beach", s.sky.tag()}};
}

// Overlapping curled waves in flat colours with light crests, as in a woodcut.
Label woodcut(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const double hue =
        commission.turn % 2 == 0 ? random.between(kCyan, kBlue) : commission.hue;
    const Color paper = oklch(0.92, 0.05, random.pick({0.22, 0.12, hue + 0.5}));
    const Color sky_top =
        oklch({random.between(0.6, 0.85), 0.1, hue + random.pick({0.5, 0.3, 0.42})});
    const Ramp sky{sky_top, paper};
    const double horizon = random.between(0.36, 0.5);
    const std::uint32_t seed = random.noise_seed();
    canvas.cover([&](Point p) {
        return sky.at(p.y / horizon) * (1 + 0.03 * noise(p.x * 3, p.y * 90, seed));
    });
    const Point sun{canvas.aspect() * random.between(0.2, 0.8),
                    horizon * random.between(0.3, 0.7)};
    const double sun_radius = random.between(0.09, 0.17);
    canvas.disc(sun, sun_radius, oklch(0.62, 0.22, random.pick({kRed, hue + 0.5})));
    constexpr int kRows = 9;
    const double frequency = random.between(0.9, 1.6);
    for (int row = 0; row < kRows; ++row) {
        const double t = (row + 0.5) / kRows;
        const double base = mix(horizon, 1.0, t);
        const double height = mix(0.03, 0.16, t);
        const double wave = 1 / (frequency * mix(2.4, 0.8, t));
        const double phase = random.unit();
        std::vector<Point> crest;
        for (int k = -1; (k - 1) * wave < canvas.aspect() + wave; ++k) {
            const double x = (k + phase) * wave;
            const double h = height * (0.75 + 0.4 * lattice_unit(k, row, seed));
            crest.push_back({x - wave * 0.5, base + height * 0.35});
            crest.push_back({x - wave * 0.22, base - h * 0.25});
            crest.push_back({x + wave * 0.02, base - h * 0.95});
            crest.push_back({x + wave * 0.16, base - h * 0.8});
            crest.push_back({x + wave * 0.12, base - h * 0.45});
        }
        const auto line = smooth_path(crest, 8);
        std::vector<Point> outline = line;
        outline.push_back({canvas.aspect() + 2, 1.2});
        outline.push_back({-2, 1.2});
        const Color c = oklch(mix(0.72, 0.3, t), 0.12, hue + 0.04 * (row % 3));
        canvas.shade(cover_polygon(canvas.frame(), outline), 1, [&](Point p) {
            const double grain = 1 + 0.05 * noise(p.x * 4, p.y * 120, seed + 1);
            const double band = fraction((p.y - base) / (height * 0.42) +
                                         0.15 * noise(p.x * 5, p.y * 5, seed)) < 0.16
                                    ? 0.75
                                    : 1;
            return c * (grain * band);
        });
        for (std::size_t k = 0; k < line.size(); k += 2) {
            const double high = clamp01((base - line[k].y) / height);
            if (high > 0.35)
                canvas.disc(line[k] + Point{0, 0.2 * height * (1 - high)},
                            height * 0.11 * high,
                            {0.95, 0.95, 0.92});
        }
        canvas.taper(line, 0.004 * (0.5 + t), 0.004 * (0.5 + t), {0.93, 0.94, 0.92});
    }
    if (random.chance(0.5)) {
        const Sky day = make_sky(random, Hour::kNoon, canvas.aspect(), horizon);
        paint_sail_boat(canvas,
                        {canvas.aspect() * random.between(0.3, 0.7), horizon + 0.2},
                        0.2,
                        oklch(0.8, 0.15, hue + 0.5),
                        oklch(0.35, 0.1, 0.1),
                        day);
    }
    return {"Woodcut waves", {"sea", "waves", "woodcut"}};
}

Label islands(Canvas& canvas, Commission& commission) {
    Scene s = begin_scene(
        canvas,
        commission,
        kScenes,
        {Hour::kGoldenHour, Hour::kMorning, Hour::kNight, Hour::kSunset, Hour::kNoon},
        0.48,
        0.6);
    for (int i = 0; i < 4; ++i) {
        const double t = i / 3.0;
        const double x =
            canvas.aspect() * fraction(0.1 + i * 0.618 + s.random.unit() * 0.1);
        const double height = s.random.between(0.1, 0.34) * mix(0.7, 1.2, t);
        const double width = height * s.random.between(0.5, 1.1);
        std::vector<Point> outline;
        const std::uint32_t seed = s.random.noise_seed();
        for (int k = 0; k <= 60; ++k) {
            const double u = k / 30.0 - 1;
            const double stack = power(std::max(0.0, 1 - u * u * u * u), 0.55);
            outline.push_back(
                {x + u * width,
                 s.horizon + 0.012 -
                     height * stack * (0.85 + 0.3 * noise(u * 2.3, 0.5, seed))});
        }
        const Color rock = oklch(0.45, 0.05, 0.15);
        const Color green = oklch(0.5, 0.12, kGreen);
        const double side = s.sky.sun.x > x ? 1 : -1;
        canvas.shade(cover_polygon(canvas.frame(), outline), 1, [&](Point p) {
            const double r = ridged(p.x * 9, p.y * 3, 4, seed);
            const double up = (s.horizon - p.y) / height;
            const Color c = mix(rock, green, smoothstep(0.3, 0.8, up + 0.5 * (r - 0.4))) *
                            (0.4 + 0.9 * r + 0.4 * side * (p.x - x) / width);
            return mix(
                c * (s.sky.sunlight + s.sky.ambient), s.sky.haze, mix(0.55, 0.05, t));
        });
    }
    const double tone = s.random.pick({kTeal, kCyan, kBlue});
    paint_water(canvas,
                s.horizon + 0.01,
                oklch(0.45, 0.12, tone) * (s.sky.sunlight * 0.8 + s.sky.ambient),
                0.9,
                s.sky.seed);
    const Point boat{canvas.aspect() * s.random.between(0.2, 0.8),
                     s.random.between(0.72, 0.86)};
    paint_sail_boat(canvas,
                    boat,
                    s.random.between(0.16, 0.34),
                    oklch(0.72, 0.2, s.hue),
                    oklch(0.4, 0.1, s.hue + 0.4),
                    s.sky);
    return {"Islands " + s.sky.when(), {"sea", "islands", s.sky.tag()}};
}

}  // namespace

Label paint_seascape(Canvas& canvas, Commission& commission) {
    static constexpr std::array kScenes = {
        sailing, beach, paint_reef, lighthouse, woodcut, islands};
    Label label = kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](
        canvas, commission);
    label.tags.insert(label.tags.begin(), "seascape");
    return label;
}

}  // namespace haarmony::gallery
