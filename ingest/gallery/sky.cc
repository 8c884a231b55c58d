#include "ingest/gallery/sky.h"

#include <algorithm>
#include <cmath>

#include "ingest/gallery/field.h"
#include "ingest/gallery/noise.h"

namespace haarmony::gallery {
namespace {

// Colours of an hour, as lightness, chroma and hue of zenith, middle and horizon.
Ramp sky_ramp(Random& random, Hour hour) {
    const double turn = random.between(-0.02, 0.02);
    const auto c = [&](double l, double chroma, double hue) {
        return oklch(l, chroma, hue + turn);
    };
    switch (hour) {
        case Hour::kMorning:
            return {c(0.66, 0.11, 0.70), c(0.82, 0.07, 0.78), c(0.92, 0.07, 0.12)};
        case Hour::kNoon:
            return {c(0.50, 0.17, 0.71), c(0.68, 0.13, 0.68), c(0.88, 0.06, 0.63)};
        case Hour::kGoldenHour:
            return {c(0.55, 0.10, 0.68), c(0.80, 0.09, 0.22), c(0.90, 0.15, 0.21)};
        case Hour::kSunset:
            if (random.chance(0.5))
                return {c(0.30, 0.14, 0.80), c(0.55, 0.20, 0.97), c(0.80, 0.17, 0.16)};
            return {c(0.38, 0.12, 0.74), c(0.64, 0.18, 0.07), c(0.87, 0.17, 0.24)};
        case Hour::kDusk:
            return {c(0.20, 0.10, 0.76), c(0.38, 0.13, 0.83), c(0.66, 0.13, 0.02)};
        case Hour::kNight:
            return {c(0.10, 0.06, 0.76), c(0.19, 0.09, 0.74), c(0.32, 0.09, 0.70)};
        case Hour::kStorm:
            break;
    }
    return {c(0.36, 0.03, 0.70), c(0.52, 0.03, 0.62), c(0.78, 0.06, 0.28)};
}

void paint_stars(Canvas& canvas, double horizon, Random& random) {
    const int count = static_cast<int>(420 * canvas.aspect());
    for (int i = 0; i < count; ++i) {
        const Point p{random.between(0, canvas.aspect()), horizon * random.unit()};
        const double brightness = power(random.unit(), 6) * (1 - p.y / horizon);
        const Color tint = oklch(0.93, 0.05, random.chance(0.4) ? 0.2 : 0.7);
        canvas.glow(p, 0.0022 + 0.004 * brightness, tint * (0.35 + 2.5 * brightness));
    }
}

void paint_aurora(Canvas& canvas, double horizon, Random& random) {
    const std::uint32_t seed = random.noise_seed();
    const double hue = random.pick({kGreen, kTeal, kMagenta, kLime});
    const double foot = horizon * random.between(0.62, 0.85);
    const Color low = oklch(0.86, 0.22, hue);
    const Color high = oklch(0.55, 0.24, hue + random.pick({0.3, -0.2, 0.45}));
    const double slant = random.between(-0.35, 0.35);
    canvas.rework([&](Point p, const Color& below) {
        if (p.y > horizon) return below;
        Color c = below;
        for (int band = 0; band < 2; ++band) {
            const std::uint32_t own = seed + static_cast<std::uint32_t>(band) * 77U;
            const double edge = foot - 0.14 * band * horizon + slant * (p.x - 0.6) +
                                0.13 * fbm(p.x * 1.7, band * 5.0, 3, own);
            const double above = (edge - p.y) / horizon;
            if (above < -0.05) continue;
            const double curtain =
                0.35 + 0.65 * clamp01(0.5 + noise(p.x * 26, p.y * 1.2, own + 9) +
                                      0.5 * noise(p.x * 7, 0.5, own + 5));
            const double light = smoothstep(-0.05, 0.03, above) *
                                 exponential(-3.4 * std::max(0.0, above)) * curtain;
            c = c + mix(low, high, smoothstep(0.0, 0.55, above)) * (0.75 * light);
        }
        return c;
    });
}

void paint_sun(Canvas& canvas, const Sky& sky) {
    const double r = sky.sun_radius;
    if (sky.hour == Hour::kStorm) {
        canvas.glow(sky.sun, 0.6, sky.sunlight * 0.25);
        return;
    }
    if (!sky.dark()) {
        canvas.glow(sky.sun, r * 16, sky.sunlight * 0.16);
        canvas.glow(sky.sun, r * 6, sky.sunlight * 0.3);
        canvas.glow(sky.sun, r * 2.2, sky.sunlight * 0.6);
        canvas.disc(sky.sun, r, mix(sky.sunlight * 3, {4, 4, 3.6}, 0.35));
        return;
    }
    canvas.glow(sky.sun, r * 9, sky.sunlight * 0.18);
    canvas.glow(sky.sun, r * 3, sky.sunlight * 0.3);
    Mask moon = cover_disc(canvas.frame(), sky.sun, r);
    if (sky.seed % 3 == 0) {
        const Point offset = turned({r * 0.6, 0}, (sky.seed % 100) * 0.06);
        moon = without(moon, cover_disc(canvas.frame(), sky.sun + offset, r * 0.95));
    }
    canvas.shade(moon, 1, [&](Point p) {
        const Point q = (p - sky.sun) * (1 / r);
        const double seas =
            smoothstep(0.05, 0.35, fbm(q.x * 1.5, q.y * 1.5, 4, sky.seed));
        return mix(Color{1.5, 1.45, 1.3}, Color{0.85, 0.86, 0.9}, seas * 0.8);
    });
}

void paint_clouds(Canvas& canvas, const Sky& sky, double horizon) {
    const double threshold = mix(0.34, -0.32, sky.cloudiness);
    const double softness = sky.hour == Hour::kStorm ? 0.55 : 0.34;
    // A layer of clouds seen in perspective: it thins out towards the horizon.
    const auto overhead = [&](Point p) {
        const double depth = 1 / (0.10 + std::max(0.0, horizon - p.y));
        return Point{(p.x - 0.7) * depth * 0.62, depth * 0.85};
    };
    const Field mass(canvas.frame(), horizon, [&](Point p) {
        const Point q = overhead(p);
        return fbm(q.x, q.y, 5, sky.seed) - threshold;
    });
    const Field towards_light(canvas.frame(), horizon, [&](Point p) {
        const Point q = overhead(p);
        const double aside = clamp((sky.sun.x - p.x) * 0.35, -0.22, 0.22);
        return fbm(q.x + aside, q.y + 0.18, 3, sky.seed);
    });
    const int last =
        std::min(canvas.height(), static_cast<int>(clamp01(horizon) * canvas.height()));
    for (int y = 0; y < last; ++y) {
        const double near = smoothstep(0.0, 0.22, horizon - canvas.point(0, y).y);
        for (int x = 0; x < canvas.width(); ++x) {
            const double density = mass.at(x, y);
            if (density <= 0) continue;
            const double lit =
                clamp01(0.62 + 1.25 * (density + threshold - towards_light.at(x, y)));
            const Point d = canvas.point(x, y) - sky.sun;
            const double rim = exponential(-6 * (d.x * d.x + d.y * d.y));
            const Color c =
                mix(sky.cloud_dark, sky.cloud_lit, clamp01(lit + 0.35 * rim)) +
                sky.sunlight * (0.3 * rim * (1 - clamp01(density * 2)));
            const double cover = smoothstep(0, softness, density) * near;
            canvas.set(x, y, mix(canvas.at(x, y), c, 0.92 * cover));
        }
    }
}

}  // namespace

std::string Sky::when() const {
    static constexpr const char* kWhen[] = {"in the morning",
                                            "at noon",
                                            "in the late light",
                                            "at sunset",
                                            "at dusk",
                                            "at night",
                                            "before the storm"};
    return kWhen[static_cast<int>(hour)];
}

std::string Sky::tag() const {
    static constexpr const char* kTag[] = {
        "morning", "noon", "golden hour", "sunset", "dusk", "night", "storm"};
    return kTag[static_cast<int>(hour)];
}

Sky make_sky(Random& random, Hour hour, double aspect, double horizon) {
    Sky sky{.hour = hour, .ramp = sky_ramp(random, hour)};
    sky.seed = random.noise_seed();
    sky.haze = sky.ramp.at(0.92);
    const bool low =
        hour == Hour::kSunset || hour == Hour::kGoldenHour || hour == Hour::kMorning;
    sky.sun = {aspect * random.between(0.12, 0.88),
               horizon * (low ? random.between(0.72, 0.98) : random.between(0.15, 0.5))};
    sky.sun_radius = low ? random.between(0.04, 0.085) : random.between(0.028, 0.06);
    sky.cloudiness = random.between(0.2, 0.75);
    switch (hour) {
        case Hour::kMorning:
            sky.sunlight = oklch(0.93, 0.08, 0.17);
            sky.cloud_lit = oklch(0.96, 0.04, 0.08);
            sky.cloud_dark = oklch(0.72, 0.07, 0.85);
            break;
        case Hour::kNoon:
            sky.sunlight = oklch(0.98, 0.04, 0.27) * 1.15;
            sky.cloud_lit = oklch(0.99, 0.01, 0.2);
            sky.cloud_dark = oklch(0.74, 0.04, 0.7);
            break;
        case Hour::kGoldenHour:
            sky.sunlight = oklch(0.90, 0.15, 0.22) * 1.1;
            sky.cloud_lit = oklch(0.95, 0.09, 0.22);
            sky.cloud_dark = oklch(0.62, 0.07, 0.06);
            break;
        case Hour::kSunset:
            sky.sunlight = oklch(0.80, 0.18, 0.14) * 1.1;
            sky.cloud_lit = oklch(0.80, 0.17, 0.12);
            sky.cloud_dark = oklch(0.34, 0.11, 0.87);
            break;
        case Hour::kDusk:
            sky.sunlight = oklch(0.72, 0.10, 0.98) * 0.7;
            sky.cloud_lit = oklch(0.62, 0.13, 0.98);
            sky.cloud_dark = oklch(0.27, 0.08, 0.78);
            break;
        case Hour::kNight:
            sky.sunlight = oklch(0.80, 0.05, 0.68) * 0.35;
            sky.cloud_lit = oklch(0.40, 0.06, 0.72);
            sky.cloud_dark = oklch(0.17, 0.05, 0.74);
            sky.aurora = random.chance(0.55);
            sky.cloudiness = random.between(0, 0.3);
            break;
        case Hour::kStorm:
            sky.sunlight = oklch(0.88, 0.07, 0.26) * 0.8;
            sky.cloud_lit = oklch(0.80, 0.04, 0.3);
            sky.cloud_dark = oklch(0.27, 0.04, 0.72);
            sky.cloudiness = random.between(0.8, 1.0);
            break;
    }
    sky.ambient = sky.ramp.at(0.45) * 0.55;
    return sky;
}

void paint_sky(Canvas& canvas, const Sky& sky, double horizon, Random& random) {
    for (int y = 0; y < canvas.height(); ++y) {
        const double t = clamp01(canvas.point(0, y).y / horizon);
        const Color c = sky.ramp.at(t * t * 0.35 + t * 0.65);
        for (int x = 0; x < canvas.width(); ++x) canvas.set(x, y, c);
    }
    if (sky.dark()) paint_stars(canvas, horizon, random);
    if (sky.aurora) paint_aurora(canvas, horizon, random);
    paint_sun(canvas, sky);
    if (sky.cloudiness > 0.05 && !sky.aurora) paint_clouds(canvas, sky, horizon);
}

void paint_birds(Canvas& canvas,
                 Point around,
                 int count,
                 const Color& color,
                 Random& random) {
    for (int i = 0; i < count; ++i) {
        const double span = random.between(0.008, 0.02);
        const Point p = around + Point{random.bell() * 0.09, random.bell() * 0.035};
        const double lift = span * random.between(0.2, 0.6);
        const Point wings[] = {p + Point{-span, -lift},
                               p + Point{-span * 0.4, -lift * 0.9},
                               p,
                               p + Point{span * 0.4, -lift * 0.9},
                               p + Point{span, -lift}};
        canvas.taper(smooth_path(wings, 4), 0.0016, 0.0016, color, 0.85);
    }
}

}  // namespace haarmony::gallery
