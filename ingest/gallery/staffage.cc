#include "ingest/gallery/staffage.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace haarmony::gallery {
namespace {

Color lit_by(const Color& color, const Sky& sky) {
    return color * (sky.sunlight * 0.9 + sky.ambient);
}

}  // namespace

void paint_conifer(Canvas& canvas,
                   Point at,
                   double size,
                   const Color& lit,
                   const Color& shaded,
                   Random& random) {
    const double half = size * random.between(0.17, 0.25);
    constexpr int kTiers = 7;
    std::vector<Point> left;
    std::vector<Point> right;
    for (int tier = 0; tier < kTiers; ++tier) {
        const double t = (tier + 1.0) / kTiers;
        const double y = at.y - size * (1 - 0.92 * t);
        const double reach = half * t * random.between(0.8, 1.15);
        left.push_back({at.x - reach, y + size * 0.02});
        left.push_back({at.x - reach * 0.45, y - size * 0.025});
        right.push_back({at.x + reach * random.between(0.9, 1.1), y + size * 0.02});
        right.push_back({at.x + reach * 0.45, y - size * 0.025});
    }
    std::vector<Point> outline{{at.x, at.y - size}};
    outline.insert(outline.end(), right.begin(), right.end());
    outline.insert(outline.end(), left.rbegin(), left.rend());
    canvas.rectangle({at.x - size * 0.018, at.y - size * 0.12},
                     {at.x + size * 0.018, at.y},
                     shaded * 0.6);
    canvas.shade(cover_polygon(canvas.frame(), outline), 1, [&](Point p) {
        const double side = (p.x - at.x) / half;
        const double tier = fraction((p.y - at.y) / size * kTiers * 1.09 + 100);
        return mix(shaded, lit, clamp01(0.4 - 0.5 * side + 0.35 * (0.5 - tier)));
    });
}

void paint_round_tree(Canvas& canvas,
                      Point at,
                      double size,
                      const Color& leaf,
                      const Sky& sky,
                      Random& random) {
    const Point foot[] = {at, at + Point{random.bell() * 0.01, -size * 0.55}};
    canvas.taper(foot, size * 0.035, size * 0.018, lit_by({0.1, 0.06, 0.04}, sky));
    const Point middle{at.x, at.y - size * 0.62};
    const double side = sky.sun.x > at.x ? 1 : -1;
    const int dabs = size > 0.15 ? 420 : 130;
    const double dab = size > 0.15 ? 0.6 : 1;
    for (int i = 0; i < dabs; ++i) {
        // Dabs from the shaded inside to the lit rim, so that light ends on top.
        const double t = static_cast<double>(i) / dabs;
        const double angle = random.between(0, kTurn);
        const double r = std::sqrt(random.unit()) * size * mix(0.40, 0.30, t);
        const Point offset{r * cosine(angle) * 1.05, r * sine(angle) * 0.88};
        const Point p = middle + offset + Point{side * 0.07 * t * size, -0.10 * t * size};
        const double light =
            clamp01(0.30 + 0.55 * t + (side * offset.x - offset.y) / size * 0.5);
        const Color c =
            shade_of(leaf, mix(0.5, 1.16, light) * random.between(0.88, 1.12));
        canvas.disc(p, size * dab * random.between(0.03, 0.07), lit_by(c, sky), 0.9);
    }
}

void paint_palm(Canvas& canvas,
                Point at,
                double size,
                double lean,
                const Color& leaf,
                Random& random) {
    const Point top = at + Point{lean * size, -size};
    const Point trunk[] = {at, at + Point{lean * size * 0.25, -size * 0.5}, top};
    canvas.taper(
        smooth_path(trunk, 10), size * 0.03, size * 0.016, leaf * Color{1.4, 0.8, 0.7});
    const int fronds = 9 + random.below(4);
    for (int i = 0; i < fronds; ++i) {
        const double angle = kPi * (1.05 - 1.1 * (i + random.unit() * 0.5) / fronds) * -1;
        const double reach = size * random.between(0.38, 0.55);
        const Point tip =
            top + Point{reach * cosine(angle), reach * sine(angle) * 0.55 + reach * 0.28};
        const Point bend = top + Point{reach * 0.55 * cosine(angle),
                                       reach * 0.6 * sine(angle) - reach * 0.08};
        const Point rib[] = {top, bend, tip};
        const auto path = smooth_path(rib, 12);
        const Color c = shade_of(leaf, random.between(0.8, 1.25));
        canvas.taper(path, size * 0.012, size * 0.003, c);
        for (std::size_t k = 2; k + 1 < path.size(); ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(path.size());
            const double drop = reach * 0.24 * sine(kPi * (0.15 + 0.85 * t));
            canvas.line(path[k],
                        path[k] + Point{drop * 0.25 * cosine(angle), drop},
                        size * 0.008,
                        c,
                        0.95);
        }
    }
}

void paint_house(Canvas& canvas,
                 Point at,
                 double size,
                 const Color& wall,
                 const Color& roof,
                 const Sky& sky) {
    const double w = size * 0.62;
    const double eaves = at.y - size * 0.5;
    canvas.rectangle({at.x - w, eaves}, {at.x + w, at.y}, lit_by(wall, sky));
    canvas.rectangle(
        {at.x + w * 0.35, eaves}, {at.x + w, at.y}, lit_by(wall, sky) * 0.72);
    const Point shape[] = {{at.x - w * 1.15, eaves},
                           {at.x - w * 0.75, at.y - size},
                           {at.x + w * 0.75, at.y - size},
                           {at.x + w * 1.15, eaves}};
    canvas.polygon(shape, lit_by(roof, sky));
    const Color pane = sky.dark() ? Color{2.2, 1.4, 0.5} : lit_by({0.12, 0.15, 0.2}, sky);
    for (const double x : {-0.72, -0.2, 0.5})
        canvas.rectangle({at.x + w * x, eaves + size * 0.13},
                         {at.x + w * (x + 0.24), eaves + size * 0.34},
                         pane);
}

void paint_sail_boat(Canvas& canvas,
                     Point at,
                     double size,
                     const Color& sail,
                     const Color& hull,
                     const Sky& sky) {
    const double w = size * 0.42;
    const Point body[] = {{at.x - w, at.y - size * 0.13},
                          {at.x + w * 1.15, at.y - size * 0.15},
                          {at.x + w * 0.75, at.y},
                          {at.x - w * 0.75, at.y}};
    canvas.polygon(body, lit_by(hull, sky));
    const Point mast{at.x, at.y - size};
    canvas.line(
        {at.x, at.y - size * 0.1}, mast, size * 0.012, lit_by({0.2, 0.12, 0.07}, sky));
    const Point main_sail[] = {{at.x - size * 0.03, at.y - size * 0.96},
                               {at.x - size * 0.18, at.y - size * 0.55},
                               {at.x - w * 1.02, at.y - size * 0.2},
                               {at.x - size * 0.03, at.y - size * 0.2}};
    const Point jib[] = {{at.x + size * 0.03, at.y - size * 0.86},
                         {at.x + size * 0.2, at.y - size * 0.5},
                         {at.x + w * 1.05, at.y - size * 0.22},
                         {at.x + size * 0.03, at.y - size * 0.22}};
    canvas.polygon(main_sail, lit_by(sail, sky) * 1.05);
    canvas.polygon(jib, lit_by(shade_of(sail, 0.85), sky));
}

void paint_lighthouse(Canvas& canvas,
                      Point at,
                      double size,
                      const Color& stripe,
                      const Sky& sky) {
    const Point tower[] = {{at.x - size * 0.095, at.y},
                           {at.x - size * 0.062, at.y - size * 0.8},
                           {at.x + size * 0.062, at.y - size * 0.8},
                           {at.x + size * 0.095, at.y}};
    canvas.shade(cover_polygon(canvas.frame(), tower), 1, [&](Point p) {
        const double up = (at.y - p.y) / size;
        const double across = (p.x - at.x) / (size * mix(0.095, 0.062, up / 0.8));
        const bool striped = fraction(up / 0.8 * 2.5 + 0.02) < 0.5;
        const Color paint = striped ? stripe : Color{0.9, 0.89, 0.85};
        const double side = sky.sun.x > at.x ? 1 : -1;
        return lit_by(paint, sky) * (0.72 + 0.38 * across * side);
    });
    const double room = at.y - size * 0.8;
    canvas.rectangle({at.x - size * 0.085, room - size * 0.02},
                     {at.x + size * 0.085, room},
                     lit_by({0.1, 0.1, 0.12}, sky));
    const Color lamp = sky.dark() ? Color{4, 3.2, 1.6} : lit_by({0.8, 0.75, 0.5}, sky);
    canvas.rectangle({at.x - size * 0.045, room - size * 0.11},
                     {at.x + size * 0.045, room - size * 0.02},
                     lamp);
    const Point cap[] = {{at.x - size * 0.07, room - size * 0.11},
                         {at.x, room - size * 0.2},
                         {at.x + size * 0.07, room - size * 0.11}};
    canvas.polygon(cap, lit_by(stripe, sky) * 0.8);
    if (!sky.dark()) return;
    const Point source{at.x, room - size * 0.065};
    canvas.glow(source, size * 0.8, {0.5, 0.4, 0.2});
    for (const double reach : {-1.0, 1.0}) {
        const Point beam[] = {
            source, source + Point{reach * 3, -0.24}, source + Point{reach * 3, 0.12}};
        canvas.each(
            cover_polygon(canvas.frame(), beam), [&](int x, int y, double covered) {
                const double far = std::fabs(canvas.point(x, y).x - source.x);
                const Color c = canvas.at(x, y);
                canvas.set(
                    x,
                    y,
                    c + Color{0.5, 0.42, 0.22} * (covered * exponential(-2.2 * far)));
            });
    }
}

void paint_balloon(Canvas& canvas,
                   Point at,
                   double size,
                   double hue,
                   const Sky& sky,
                   Random& random) {
    const double r = size * 0.42;
    const Point middle{at.x, at.y - size * 0.62};
    std::vector<Point> outline;
    for (int i = 0; i < 64; ++i) {
        const double t = kTurn * i / 64;
        const double below = std::max(0.0, sine(t));
        // The envelope narrows to its mouth.
        outline.push_back(middle +
                          Point{r * cosine(t) * (1 - 0.42 * below * below * below),
                                r * sine(t) * (1 + 0.32 * below)});
    }
    const int gores = 8 + 2 * random.below(4);
    const bool banded = random.chance(0.4);
    const Color colors[] = {oklch(0.64, 0.21, hue),
                            oklch(0.90, 0.12, hue + random.between(0.08, 0.3)),
                            oklch(0.52, 0.18, hue + 0.45)};
    const double side = sky.sun.x > at.x ? 1 : -1;
    canvas.shade(cover_polygon(canvas.frame(), outline), 1, [&](Point p) {
        const Point q = (p - middle) * (1 / r);
        const double width = std::sqrt(std::max(0.02, 1 - q.y * q.y * 0.75));
        const double across = clamp(q.x / width, -0.98, 0.98);
        const double angle = arc_tangent(across, std::sqrt(1 - across * across));
        const int gore = floor_int((angle / kPi + 1) * gores);
        const int band = floor_int((q.y + 2) * 2.6);
        const Color c = banded && band % 3 == 1 ? colors[2] : colors[gore % 2];
        const double light = clamp01(0.62 + 0.42 * side * across - 0.28 * q.y);
        return c * (sky.ambient + sky.sunlight * light) * 1.1;
    });
    const double basket = size * 0.055;
    for (const double x : {-1.0, 1.0})
        canvas.line({at.x + x * r * 0.3, middle.y + r * 1.2},
                    {at.x + x * basket, at.y - basket * 1.6},
                    size * 0.005,
                    {0.08, 0.06, 0.05});
    canvas.rectangle({at.x - basket, at.y - basket * 1.6},
                     {at.x + basket, at.y},
                     lit_by({0.32, 0.17, 0.07}, sky));
}

}  // namespace haarmony::gallery
