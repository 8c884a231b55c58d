#include "ingest/gallery/crockery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace haarmony::gallery {

void paint_cast_shadow(Canvas& canvas,
                       const Lamp& lamp,
                       Point at,
                       double half,
                       double height) {
    const Point away{at.x - lamp.side * (half * 0.55 + height * 0.22),
                     at.y - half * 0.04};
    const Mask far =
        cover_ellipse(canvas.frame(), away, half * 1.15 + height * 0.22, half * 0.3, 0);
    canvas.glaze(soften(canvas.frame(), far, 0.02), {0.18, 0.17, 0.24}, 0.72);
    const Mask near = cover_ellipse(canvas.frame(), at, half * 0.85, half * 0.2, 0);
    canvas.glaze(soften(canvas.frame(), near, 0.007), {0.1, 0.09, 0.12}, 0.8);
}

void paint_vessel(Canvas& canvas,
                  const Lamp& lamp,
                  Point at,
                  const Profile& profile,
                  Glaze glaze,
                  const Color& body,
                  const Color& decor) {
    std::vector<Point> side;
    const auto count = static_cast<int>(profile.half_widths.size());
    for (int i = 0; i < count; ++i)
        side.push_back({profile.half_widths[static_cast<std::size_t>(i)],
                        -profile.height * i / (count - 1)});
    side = smooth_path(side, 10);
    std::vector<Point> outline;
    const double foot = side.front().x;
    const double lip = side.back().x;
    constexpr double kFlat = 0.2;  // how much a level circle is foreshortened
    for (int i = 0; i <= 16; ++i)
        outline.push_back(
            at + Point{-foot * cosine(kPi * i / 16), foot * kFlat * sine(kPi * i / 16)});
    for (const Point& p : side) outline.push_back(at + p);
    for (int i = 0; i <= 16; ++i)
        outline.push_back(at + Point{lip * cosine(kPi * i / 16),
                                     -profile.height - lip * kFlat * sine(kPi * i / 16)});
    for (auto p = side.rbegin(); p != side.rend(); ++p)
        outline.push_back(at + Point{-p->x, p->y});
    const bool glass = glaze == Glaze::kGlass;
    const Mask mask = cover_polygon(canvas.frame(), outline);
    canvas.each(mask, [&](int x, int y, double covered) {
        const Point p = canvas.point(x, y);
        const Color below = canvas.at(x, y);
        const double up = clamp01((at.y - p.y) / profile.height);
        const double place = up * static_cast<double>(side.size() - 1);
        const auto k = std::min(static_cast<std::size_t>(place), side.size() - 2);
        const double width =
            mix(side[k].x, side[k + 1].x, place - static_cast<double>(k));
        const double u = clamp((p.x - at.x) / width, -1, 1);
        const double nz = std::sqrt(std::max(0.0, 1 - u * u));
        const double slope =
            (side[k + 1].x - side[k].x) / (side[k].y - side[k + 1].y + 1e-9);
        const double ny = clamp(slope * -0.7, -0.8, 0.8) * -1;
        const double angle = arc_tangent(u, nz + 1e-6);
        // Level lines bend with the turned form.
        const double level = up + 0.07 * nz * (width / profile.height);
        double drawn = 0;
        if (glaze == Glaze::kBands)
            drawn = std::fabs(fraction(level * 5) - 0.5) < 0.17 ? 1 : 0;
        if (glaze == Glaze::kZigzag)
            drawn =
                std::fabs(level - 0.55 -
                          0.1 * (std::fabs(fraction(angle * 2.2 + 8) - 0.5) * 4 - 1)) <
                            0.05 ||
                        std::fabs(level - 0.82) < 0.03 || std::fabs(level - 0.28) < 0.03
                    ? 1
                    : 0;
        if (glaze == Glaze::kDots) {
            const double a = fraction(angle * 2.4 + 8) - 0.5;
            const double b = fraction(level * 5) - 0.5;
            drawn = a * a + b * b < 0.075 ? 1 : 0;
        }
        Color c = lit(mix(body, decor, drawn), lamp, u, ny, nz);
        c = c + lamp.light * (0.55 * highlight(lamp, u, ny * 0.4 - 0.2, nz, 40) +
                              0.1 * highlight(lamp, u, ny * 0.4, nz, 6));
        if (glass) {
            const double rim = power(1 - nz, 2);
            const bool filled = up < 0.6;
            c = mix(below * mix(Color{1, 1, 1}, body * 1.6, filled ? 0.85 : 0.4),
                    c,
                    0.18 + 0.6 * rim);
            c = c + lamp.light * (0.6 * highlight(lamp, u, -0.25, nz, 90));
        }
        canvas.set(x, y, mix(below, c, covered));
    });
    // The mouth, dark inside.
    const Point mouth = at - Point{0, profile.height};
    canvas.fill(cover_ellipse(canvas.frame(), mouth, lip, lip * kFlat, 0),
                lit(body, lamp, 0, -0.7, 0.5),
                glass ? 0.35 : 1);
    canvas.fill(cover_ellipse(canvas.frame(),
                              mouth + Point{0, lip * 0.02},
                              lip * 0.88,
                              lip * kFlat * 0.8,
                              0),
                body * lamp.shade * 0.25,
                glass ? 0.3 : 0.95);
}

void paint_candle(Canvas& canvas,
                  const Lamp& lamp,
                  Point at,
                  double height,
                  const Color& wax) {
    const double half = height * 0.075;
    const std::array<double, 2> sides = {half, half};
    paint_vessel(canvas, lamp, at, {sides, height}, Glaze::kPlain, wax, wax);
    const Point wick{at.x, at.y - height};
    canvas.line(wick, wick - Point{0, half}, half * 0.12, {0.02, 0.02, 0.02});
    const Point flame[] = {wick - Point{0, half * 0.6},
                           wick + Point{-half * 0.6, -half * 1.6},
                           wick - Point{0, half * 4.2},
                           wick + Point{half * 0.6, -half * 1.6}};
    canvas.glow(wick - Point{0, half * 2}, 0.75, Color{0.2, 0.11, 0.035});
    canvas.glow(wick - Point{0, half * 2}, half * 7, Color{0.5, 0.28, 0.08});
    canvas.shade(
        cover_polygon(canvas.frame(), smooth_outline(flame, 8)), 1, [&](Point p) {
            return mix(Color{3.4, 2.7, 1.4},
                       Color{2.6, 1.1, 0.2},
                       clamp01((wick.y - p.y) / (half * 4.2)));
        });
}

}  // namespace haarmony::gallery
