#include <algorithm>
#include <array>
#include <cmath>

#include "ingest/gallery/field.h"
#include "ingest/gallery/noise.h"
#include "ingest/gallery/painters.h"

namespace haarmony::gallery {
namespace {

struct Space {
    Canvas& canvas;
    Random& random;
    double hue;
    Point light;  // towards the sun, length 1 on the picture
};

void nebula(Space& s, double brightness) {
    const std::uint32_t seed = s.random.noise_seed();
    const std::vector<double> hues = harmony(s.random, s.hue);
    const Ramp ramp{{0.004, 0.005, 0.012},
                    oklch(0.18, 0.10, hues[1]),
                    oklch(0.42, 0.18, hues[0]),
                    oklch(0.72, 0.17, hues[2]),
                    oklch(0.95, 0.07, hues[3])};
    const double angle = s.random.between(0, kPi);
    const double narrow = s.random.between(1.2, 3.5);
    const Point centre{s.canvas.aspect() * s.random.between(0.25, 0.75),
                       s.random.between(0.3, 0.7)};
    const Field glow(s.canvas.frame(), 1, [&](Point p) {
        const Point d = turned(p - centre, angle);
        const double warp = fbm(p.x * 2.1, p.y * 2.1, 3, seed);
        const double gas =
            fbm(p.x * 2.6 + 1.3 * warp, p.y * 2.6 - 1.1 * warp, 5, seed + 5);
        const double band = exponential(-narrow * d.y * d.y * 4 - d.x * d.x * 0.8);
        const double dust =
            smoothstep(0.05, 0.5, fbm(p.x * 3.7 - warp, p.y * 3.7, 3, seed + 11));
        return clamp01((0.32 + 0.75 * gas) * (0.5 + 0.85 * band) - 0.28 * dust * band);
    });
    for (int y = 0; y < s.canvas.height(); ++y)
        for (int x = 0; x < s.canvas.width(); ++x)
            s.canvas.set(
                x, y, ramp.at(glow.at(x, y) * brightness) * (0.5 + brightness * 0.7));
}

void stars(Space& s, int count) {
    for (int i = 0; i < count; ++i) {
        const Point p{s.random.between(0, s.canvas.aspect()), s.random.unit()};
        const double b = power(s.random.unit(), 16);
        const Color tint = oklch(0.94, 0.06, s.random.pick({0.08, 0.2, 0.68, 0.74}));
        s.canvas.glow(p, 0.0024 + 0.009 * b, tint * (0.35 + 3 * b));
        if (b < 0.6) continue;
        s.canvas.glow(p, 0.05 * b, tint * 0.25);
        for (const Point d : {Point{0.03, 0}, Point{0, 0.03}})
            s.canvas.line(p - d * b, p + d * b, 0.0009, tint * 1.6, 0.7);
    }
}

// A surface: colour at longitude and latitude (radians).
struct Globe {
    Point centre;
    double radius;
    double tilt;
    double phase;  // how far the sun stands to the side: 0 behind us .. 1 beside
    Color air;
};

template <typename F>
void paint_globe(Space& s, const Globe& g, F&& surface) {
    const double lx = s.light.x * g.phase;
    const double ly = s.light.y * g.phase;
    const double lz = std::sqrt(std::max(0.0, 1 - lx * lx - ly * ly));
    // Air glows beyond the rim, on the day side.
    for (const double reach : {1.22, 1.08}) {
        const Mask halo = cover_disc(s.canvas.frame(), g.centre, g.radius * reach);
        s.canvas.each(halo, [&](int x, int y, double covered) {
            const Point q = (s.canvas.point(x, y) - g.centre) * (1 / g.radius);
            const double out = (reach - length(q)) / (reach - 0.9);
            const double day = clamp01(0.35 + q.x * lx + q.y * ly);
            s.canvas.set(
                x,
                y,
                s.canvas.at(x, y) + g.air * (covered * 0.4 * clamp01(out) * out * day));
        });
    }
    s.canvas.shade(cover_disc(s.canvas.frame(), g.centre, g.radius), 1, [&](Point p) {
        const Point q = (p - g.centre) * (1 / g.radius);
        const double z = std::sqrt(std::max(0.0, 1 - q.x * q.x - q.y * q.y));
        const Point level = turned(q, g.tilt);
        const double latitude =
            arc_tangent(level.y, std::sqrt(std::max(1e-9, 1 - level.y * level.y)));
        const double longitude = arc_tangent(level.x, z);
        const double light = q.x * lx + q.y * ly + z * lz;
        const double day = smoothstep(-0.12, 0.35, light) * clamp01(light + 0.25);
        const Color c = surface(longitude, latitude, Point{level.x, level.y}, z);
        const double rim = power(1 - z, 3);
        return c * (0.012 + 1.15 * day) +
               g.air * (rim * 1.1 * smoothstep(-0.2, 0.5, light));
    });
}

void gas_giant(Space& s, const Globe& g, double hue) {
    const std::uint32_t seed = s.random.noise_seed();
    const Ramp bands{oklch(0.42, 0.12, hue),
                     oklch(0.72, 0.13, hue + 0.06),
                     oklch(0.92, 0.06, hue + 0.09),
                     oklch(0.64, 0.16, hue - 0.04),
                     oklch(0.86, 0.10, hue + 0.13),
                     oklch(0.50, 0.15, hue - 0.09)};
    const double count = s.random.between(2.2, 4.5);
    const Point spot{s.random.between(-0.4, 0.4), s.random.between(0.15, 0.45)};
    paint_globe(s, g, [&](double lon, double lat, Point q, double) {
        const double turbulence = fbm(lon * 2.2, lat * 7, 4, seed);
        const double d =
            ((q.x - spot.x) * (q.x - spot.x) + 5 * (q.y - spot.y) * (q.y - spot.y)) * 22;
        const double eye = exponential(-d);
        const double t = 0.5 + 0.5 * sine(lat * count * 2 + 0.9 * turbulence +
                                          noise(lat * 5, 0.5, seed + 3) * 3);
        return mix(bands.at(t + 0.12 * noise(lon * 5, lat * 30, seed + 1)),
                   oklch(0.6, 0.2, hue - 0.1),
                   eye * 0.9);
    });
}

void living_world(Space& s, const Globe& g, double hue) {
    const std::uint32_t seed = s.random.noise_seed();
    const Color sea = oklch(0.36, 0.13, hue);
    const Color shelf = oklch(0.62, 0.13, hue - 0.06);
    const Ramp land{oklch(0.78, 0.10, 0.24),
                    oklch(0.52, 0.12, 0.4 + s.random.between(-0.2, 0.1)),
                    oklch(0.40, 0.08, 0.2),
                    oklch(0.75, 0.05, 0.16)};
    paint_globe(s, g, [&](double lon, double lat, Point q, double z) {
        const double h = fbm(q.x * 1.7 + 5, q.y * 1.7 + z * 1.9, 6, seed);
        Color c = h < 0.02 ? mix(sea, shelf, smoothstep(-0.18, 0.02, h))
                           : land.at((h - 0.02) * 2.6);
        const double ice = smoothstep(1.02, 1.16, std::fabs(lat) + 0.12 * h);
        c = mix(c, {0.9, 0.95, 1}, ice);
        const double cloud = fbm(lon * 2 + 0.8 * h, lat * 3.4, 5, seed + 9);
        return mix(c, {1, 1, 1}, 0.9 * smoothstep(0.08, 0.42, cloud));
    });
}

void rocky_moon(Space& s, const Globe& g, double hue, double chroma) {
    const std::uint32_t seed = s.random.noise_seed();
    const Ramp stone{oklch(0.35, chroma, hue),
                     oklch(0.62, chroma, hue + 0.03),
                     oklch(0.82, chroma * 0.6, hue + 0.06)};
    paint_globe(s, g, [&](double, double, Point q, double z) {
        double h = 0.5 + 0.6 * fbm(q.x * 2.6, q.y * 2.6 + z, 5, seed);
        for (const double scale : {3.0, 7.0}) {
            const Cell crater =
                cell(q.x * scale + 9, (q.y + z * 0.5) * scale + 9, seed + 5);
            const double r = 0.16 + 0.2 * ((crater.id >> 8) & 255) / 255.0;
            h += 0.22 * (smoothstep(r * 0.8, r, crater.nearest) - 1) +
                 0.25 * exponential(-power((crater.nearest - r) * 14, 2));
        }
        return stone.at(h);
    });
}

// Half of the rings is painted before the globe and half after it.
void rings(Space& s,
           const Globe& g,
           double hue,
           bool front,
           std::uint32_t seed,
           double flatness,
           double angle) {
    const double outer = g.radius * 2.25;
    const Mask area =
        cover_ellipse(s.canvas.frame(), g.centre, outer, outer * flatness, angle);
    const Color light = oklch(0.88, 0.07, hue);
    const Color dark = oklch(0.55, 0.10, hue + 0.06);
    s.canvas.each(area, [&](int x, int y, double covered) {
        const Point p = s.canvas.point(x, y) - g.centre;
        const Point level = turned(p, -angle);
        if ((level.y > 0) != front) return;
        const double r =
            std::sqrt(level.x * level.x + level.y * level.y / (flatness * flatness)) /
            g.radius;
        if (r < 1.28) return;
        const double groove =
            0.5 + 0.5 * noise(r * 14, 0.5, seed) + 0.35 * noise(r * 47, 0.5, seed + 1);
        const double gap = smoothstep(0.02, 0.045, std::fabs(r - 1.86));
        const double opacity =
            clamp01(groove) * gap * smoothstep(1.28, 1.36, r) * smoothstep(2.25, 2.15, r);
        // The globe's shadow falls on the far half.
        const double along = (p.x * s.light.x + p.y * s.light.y) / g.radius;
        const double across = std::fabs(p.x * s.light.y - p.y * s.light.x) / g.radius;
        const double shadow = !front && along < 0 ? smoothstep(0.85, 1.05, across) : 1;
        const Color c = mix(dark, light, clamp01(groove)) * (0.15 + 0.95 * shadow);
        s.canvas.set(x, y, mix(s.canvas.at(x, y), c, covered * 0.92 * opacity));
    });
}

// A braced list, since its parts are often random and must be drawn in order.
struct Station {
    Point centre;
    double radius;
    double phase;
};

Globe globe_at(Space& s, const Station& station, double air_hue) {
    return {station.centre,
            station.radius,
            s.random.between(-0.6, 0.6),
            station.phase,
            oklch(0.72, 0.15, air_hue)};
}

void moons(Space& s, int count) {
    for (int i = 0; i < count; ++i) {
        const Globe moon = globe_at(s,
                                    {{s.canvas.aspect() * s.random.between(0.08, 0.92),
                                      s.random.between(0.1, 0.9)},
                                     s.random.between(0.025, 0.08),
                                     s.random.between(0.6, 0.9)},
                                    s.hue);
        const double hue = s.random.unit();
        rocky_moon(s, moon, hue, s.random.between(0.02, 0.1));
    }
}

Label ringed(Space& s) {
    nebula(s, s.random.between(0.55, 0.9));
    stars(s, 260);
    const Globe g = globe_at(
        s,
        {{s.canvas.aspect() * s.random.between(0.4, 0.6), s.random.between(0.42, 0.58)},
         0.19 * std::min(1.25, s.canvas.aspect() + 0.1),
         s.random.between(0.4, 0.75)},
        s.hue + 0.1);
    const std::uint32_t seed = s.random.noise_seed();
    const double flatness = s.random.between(0.14, 0.4);
    const double angle = s.random.between(-0.6, 0.6);
    rings(s, g, s.hue + 0.15, false, seed, flatness, angle);
    gas_giant(s, g, s.hue);
    rings(s, g, s.hue + 0.15, true, seed, flatness, angle);
    return {"Ringed planet", {"planet", "rings", "space"}};
}

Label blue_world(Space& s) {
    nebula(s, s.random.between(0.35, 0.8));
    stars(s, 300);
    const double air = s.random.pick({kSkyBlue, kCyan, kViolet, kOrange});
    const Globe g = globe_at(
        s,
        {{s.canvas.aspect() * s.random.between(0.3, 0.7), s.random.between(0.45, 0.7)},
         s.random.between(0.3, 0.44) * std::min(1.1, s.canvas.aspect()),
         s.random.between(0.5, 0.85)},
        air);
    living_world(s, g, air == kOrange ? kTeal : air + 0.04);
    moons(s, 1);
    return {"Living world", {"planet", "ocean", "space"}};
}

Label close_giant(Space& s) {
    nebula(s, s.random.between(0.5, 0.9));
    stars(s, 220);
    const double side = s.random.chance(0.5) ? 0.02 : 0.98;
    const Globe g = globe_at(s,
                             {{s.canvas.aspect() * side, s.random.between(0.55, 1.0)},
                              s.random.between(0.6, 0.82),
                              s.random.between(0.4, 0.8)},
                             s.hue + 0.1);
    gas_giant(s, g, s.hue);
    moons(s, 3);
    return {"Giant and its moons", {"planet", "moons", "space"}};
}

Label horizon_world(Space& s) {
    nebula(s, s.random.between(0.6, 0.95));
    stars(s, 240);
    const Globe far = globe_at(
        s,
        {{s.canvas.aspect() * s.random.between(0.25, 0.75), s.random.between(0.25, 0.42)},
         s.random.between(0.12, 0.24),
         0.7},
        s.hue + 0.4);
    if (s.random.chance(0.5))
        gas_giant(s, far, s.hue + 0.5);
    else
        rocky_moon(s, far, s.hue + 0.3, 0.12);
    s.light = {s.light.x, -std::fabs(s.light.y)};
    const Globe ground = globe_at(s, {{s.canvas.aspect() / 2, 2.1}, 1.42, 0.8}, s.hue);
    rocky_moon(s, ground, s.hue + 0.05, 0.13);
    return {"Over the horizon", {"planet", "moon", "space"}};
}

Label spiral_galaxy(Space& s) {
    Canvas& canvas = s.canvas;
    const std::uint32_t seed = s.random.noise_seed();
    const Point centre{canvas.aspect() * s.random.between(0.42, 0.58),
                       s.random.between(0.42, 0.58)};
    const double angle = s.random.between(0, kTurn);
    const double flatness = s.random.between(0.35, 0.9);
    const int arms = 2 + s.random.below(3);
    const double sense = s.random.sign();
    const double winding = sense * s.random.between(2.6, 4.6);
    const double scale = s.random.between(0.34, 0.46) * std::min(1.2, canvas.aspect());
    const Color arm = oklch(0.62, 0.19, s.hue);
    const Color edge = oklch(0.36, 0.18, s.hue + 0.14);
    const Color core = oklch(0.95, 0.09, s.hue + s.random.pick({0.4, 0.25, -0.3}));
    canvas.cover([&](Point p) {
        const Point q = turned(p - centre, angle);
        const Point d{q.x / scale, q.y / (scale * flatness)};
        const double r = length(d) + 1e-6;
        const double theta = arc_tangent(d.y, d.x);
        const double clump = fbm(p.x * 8, p.y * 8, 4, seed);
        const double swirl =
            0.5 + 0.5 * cosine(arms * theta - winding * logarithm(r + 0.08) * 1.3 +
                               1.2 * clump);
        const double disc = exponential(-1.6 * r);
        const double light = disc * (0.3 + 2.6 * swirl * swirl) * (1 + 0.8 * clump);
        const double bulge = exponential(-r * r * 38);
        const double knots =
            smoothstep(0.3, 0.7, noise(p.x * 42, p.y * 42, seed + 3)) * swirl * disc;
        return Color{0.004, 0.005, 0.014} +
               mix(edge, arm, clamp01(1.4 - r)) * std::max(0.0, light) +
               core * (1.7 * bulge + 0.4 * disc * disc) +
               Color{1.2, 0.5, 0.7} * (0.9 * knots);
    });
    stars(s, 300);
    return {"Spiral galaxy", {"planet", "galaxy", "space"}};
}

Label eclipse(Space& s) {
    nebula(s, s.random.between(0.2, 0.6));
    stars(s, 200);
    const Point centre{s.canvas.aspect() * s.random.between(0.35, 0.65),
                       s.random.between(0.35, 0.65)};
    const double r = s.random.between(0.15, 0.26);
    const std::uint32_t seed = s.random.noise_seed();
    const Color corona = oklch(0.82, 0.15, s.hue);
    s.canvas.rework([&](Point p, const Color& below) {
        const Point d = p - centre;
        const double out = length(d) / r - 1;
        if (out < -0.1) return below;
        const double theta = arc_tangent(d.y, d.x);
        const double streamer =
            0.6 + 0.7 * noise(cosine(theta) * 3.2, sine(theta) * 3.2, seed) +
            0.35 * noise(cosine(theta) * 11, sine(theta) * 11, seed + 1);
        const double light = exponential(-std::max(0.0, out) * (2.4 - 0.9 * streamer)) *
                             std::max(0.15, streamer);
        return below +
               mix(corona, Color{1, 0.97, 0.92}, exponential(-out * 5)) * (1.1 * light);
    });
    s.canvas.disc(centre, r, {0.003, 0.003, 0.006});
    const Point bead = centre + turned({r, 0}, s.random.between(0, kTurn));
    s.canvas.glow(bead, 0.16, {1.2, 1.1, 0.9});
    s.canvas.glow(bead, 0.05, {6, 6, 5});
    return {"Eclipse", {"planet", "eclipse", "space"}};
}

}  // namespace

Label paint_planet(Canvas& canvas, Commission& commission) {
    Random& random = commission.random;
    const double angle = random.between(0, kTurn);
    Space space{canvas, random, commission.hue, {cosine(angle), sine(angle)}};
    static constexpr std::array kScenes = {
        ringed, spiral_galaxy, blue_world, close_giant, eclipse, horizon_world};
    return kScenes[static_cast<std::size_t>(commission.turn) % kScenes.size()](space);
}

}  // namespace haarmony::gallery
