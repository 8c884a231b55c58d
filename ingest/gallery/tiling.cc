#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "ingest/gallery/noise.h"
#include "ingest/gallery/studio.h"

namespace haarmony::gallery {
namespace {

void divide(Studio& s,
            Point low,
            Point high,
            int depth,
            std::vector<std::array<Point, 2>>& cells) {
    const Point size = high - low;
    if (depth == 0 || std::min(size.x, size.y) < 0.14 ||
        (depth < 3 && s.random.chance(0.25))) {
        cells.push_back({low, high});
        return;
    }
    const double t = s.random.pick({0.28, 0.38, 0.5, 0.62, 0.74});
    if (size.x > size.y * s.random.between(0.7, 1.4)) {
        const double x = mix(low.x, high.x, t);
        divide(s, low, {x, high.y}, depth - 1, cells);
        divide(s, {x, low.y}, high, depth - 1, cells);
    } else {
        const double y = mix(low.y, high.y, t);
        divide(s, low, {high.x, y}, depth - 1, cells);
        divide(s, {low.x, y}, high, depth - 1, cells);
    }
}

}  // namespace

void weave(Studio& s) {
    const std::uint32_t seed = s.random.noise_seed();
    s.canvas.rework([&](Point p, const Color& c) {
        return c * (1 + 0.05 * noise(p.x * 12, p.y * 160, seed) +
                    0.035 * noise(p.x * 160, p.y * 12, seed + 1));
    });
}

Label paint_rectangles(Studio& s) {
    std::vector<std::array<Point, 2>> cells;
    divide(s, {0, 0}, {s.w(), 1}, 5, cells);
    const bool classic = s.random.chance(0.5);
    const Color primaries[] = {
        oklch(0.55, 0.22, 0.075), oklch(0.42, 0.19, kBlue), oklch(0.87, 0.18, 0.27)};
    const double line = s.random.between(0.007, 0.014);
    int colored = 0;
    for (const auto& cell : cells) {
        const bool color = s.random.chance(0.45) || colored == 0;
        Color c = oklch(s.random.between(0.93, 0.97), 0.01, 0.25);
        if (color) c = classic ? primaries[colored % 3] : s.vivid();
        colored += color ? 1 : 0;
        s.canvas.rectangle(cell[0], cell[1], c);
    }
    for (const auto& [low, high] : cells) {
        const Color ink{0.012, 0.012, 0.014};
        s.canvas.rectangle(
            {low.x - line, low.y - line}, {high.x + line, low.y + line}, ink);
        s.canvas.rectangle(
            {low.x - line, low.y - line}, {low.x + line, high.y + line}, ink);
    }
    weave(s);
    return {"Composition of rectangles", {"abstract", "rectangles"}};
}

Label paint_circles(Studio& s) {
    const int rows = 2 + s.random.below(3);
    const int columns = std::max(2, static_cast<int>(rows * s.w() + 0.5));
    const double width = s.w() / columns;
    const double height = 1.0 / rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const Point low{i * width, j * height};
            s.canvas.rectangle(low,
                               {low.x + width, low.y + height},
                               s.tone(s.random.between(0.3, 0.9), 0.15));
            const Point centre = low + Point{width / 2, height / 2};
            const int rings = 4 + s.random.below(3);
            for (int k = 0; k < rings; ++k) {
                const double r = 0.49 * std::min(width, height) *
                                 (1 - static_cast<double>(k) / rings) *
                                 s.random.between(0.94, 1.05);
                std::vector<Point> wobble;
                for (int q = 0; q < 14; ++q)
                    wobble.push_back(
                        centre +
                        turned({r * s.random.between(0.94, 1.04), 0}, kTurn * q / 14));
                s.canvas.polygon(smooth_outline(wobble, 6),
                                 s.tone(s.random.between(0.3, 0.92), 0.19));
            }
        }
    }
    weave(s);
    return {"Squares with circles", {"abstract", "circles"}};
}

Label paint_tiles(Studio& s) {
    const int rows = 3 + s.random.below(3);
    const int columns = std::max(2, static_cast<int>(rows * s.w() + 0.5));
    const double width = s.w() / columns;
    const double height = 1.0 / rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const Point low{i * width, j * height};
            const auto at = [&](double x, double y) {
                return low + Point{x * width, y * height};
            };
            s.canvas.rectangle(
                low, at(1, 1), s.random.chance(0.35) ? s.paper() : s.vivid());
            const Color c = s.random.chance(0.2) ? Color{0.02, 0.02, 0.03} : s.vivid();
            switch (s.random.below(5)) {
                case 0: {  // a quarter disc
                    const int corner = s.random.below(4);
                    const double cx = corner % 2;
                    const double cy = corner / 2;
                    std::vector<Point> fan{at(cx, cy)};
                    for (int k = 0; k <= 16; ++k) {
                        const double a = kPi / 2 * k / 16;
                        fan.push_back(at(cx + (1 - 2 * cx) * cosine(a),
                                         cy + (1 - 2 * cy) * sine(a)));
                    }
                    s.canvas.polygon(fan, c);
                    break;
                }
                case 1:
                    s.canvas.fill(cover_ellipse(s.canvas.frame(),
                                                at(0.5, 0.5),
                                                width * 0.42,
                                                height * 0.42,
                                                0),
                                  c);
                    s.canvas.fill(
                        cover_ellipse(
                            s.canvas.frame(), at(0.5, 0.5), width * 0.2, height * 0.2, 0),
                        s.vivid());
                    break;
                case 2: {
                    const Point triangle[] = {
                        at(0, 0), at(1, s.random.below(2)), at(0, 1)};
                    s.canvas.polygon(triangle, c);
                    break;
                }
                case 3:
                    for (int k = 0; k < 4; ++k)
                        s.canvas.rectangle(at(0, k / 4.0), at(1, k / 4.0 + 0.125), c);
                    break;
                default: {  // two half discs
                    for (const double x : {0.0, 0.5}) {
                        std::vector<Point> half;
                        for (int k = 0; k <= 20; ++k) {
                            const double a = kPi * k / 20 - kPi / 2;
                            half.push_back(at(x + 0.5 * cosine(a), 0.5 + 0.5 * sine(a)));
                        }
                        s.canvas.polygon(half, x == 0 ? c : s.vivid());
                    }
                    break;
                }
            }
        }
    }
    return {"Tiles", {"abstract", "tiles"}};
}

Label paint_stained_glass(Studio& s) {
    const std::uint32_t seed = s.random.noise_seed();
    const double scale = s.random.between(3.5, 7);
    const Point light{s.w() * s.random.between(0.3, 0.7), s.random.between(0.25, 0.75)};
    std::vector<Color> glass;
    for (int i = 0; i < 24; ++i)
        glass.push_back(s.tone(s.random.between(0.42, 0.88), 0.22));
    const double ring = s.random.between(0.18, 0.3);
    s.canvas.cover([&](Point p) {
        const Point d = p - light;
        const double r = length(d);
        // Within the rose the cells turn around its middle.
        const bool rose = r < ring;
        const double theta = arc_tangent(d.y, d.x) / kPi + 1;
        const Cell c = rose ? cell(theta * 6, r / ring * 2.4, seed + 3)
                            : cell(p.x * scale, p.y * scale, seed);
        const double lead = smoothstep(0.03, 0.075, c.second - c.nearest) *
                            smoothstep(0.006, 0.012, std::fabs(r - ring));
        const Color pane = glass[(c.id >> 5) % glass.size()] *
                           (0.65 + 1.1 * exponential(-2.2 * r * r) +
                            0.14 * noise(p.x * 30, p.y * 30, seed + 9));
        return mix(Color{0.008, 0.008, 0.01}, pane, lead);
    });
    return {"Stained glass", {"abstract", "glass"}};
}

Label paint_cutouts(Studio& s) {
    const int columns = 3 + s.random.below(2);
    const int rows = std::max(2, static_cast<int>(columns / s.w() + 0.5));
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double width = s.w() / columns;
            const double height = 1.0 / rows;
            const Point low{i * width, j * height};
            s.canvas.rectangle(low,
                               low + Point{width, height},
                               s.random.chance(0.3) ? s.paper() : s.vivid());
            // A frond as if cut with scissors: lobes along a bent stem.
            const Color c = s.random.chance(0.25) ? s.paper() : s.vivid();
            const Point centre = low + Point{width / 2, height / 2};
            const double size = 0.42 * std::min(width, height);
            const double angle = s.random.between(-0.6, 0.6);
            const int lobes = 3 + s.random.below(3);
            for (int k = 0; k < lobes; ++k) {
                const double t = (k + 0.5) / lobes;
                for (const double side : {-1.0, 1.0}) {
                    const Point root = centre + turned({0, size * (1 - 1.9 * t)}, angle);
                    const double reach =
                        size * mix(1.0, 0.45, t) * s.random.between(0.85, 1.1);
                    const Point tip =
                        root + turned({side * reach * 0.85, -reach * 0.55}, angle);
                    const Point way[] = {
                        root, (root + tip) * 0.5 + turned({0, size * 0.12}, angle), tip};
                    const auto path = smooth_path(way, 8);
                    s.canvas.taper(path, size * 0.13, size * 0.075, c);
                }
            }
            const Point stem[] = {centre + turned({0, size * 1.05}, angle),
                                  centre + turned({0, -size * 1.0}, angle)};
            s.canvas.taper(stem, size * 0.1, size * 0.08, c);
        }
    }
    weave(s);
    return {"Paper cut-outs", {"abstract", "cut-out"}};
}

}  // namespace haarmony::gallery
