#include "ingest/gallery/canvas.h"

#include <algorithm>

namespace haarmony::gallery {

Canvas::Canvas(int width, int height)
    : frame_{width, height}, light_(static_cast<std::size_t>(width) * height * 3) {
    assert(width >= 1 && height >= 1);
}

Color Canvas::sample(Point p) const {
    const double x = clamp(p.x * height() - 0.5, 0, width() - 1);
    const double y = clamp(p.y * height() - 0.5, 0, height() - 1);
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, width() - 1);
    const int y1 = std::min(y0 + 1, height() - 1);
    return mix(
        mix(at(x0, y0), at(x1, y0), x - x0), mix(at(x0, y1), at(x1, y1), x - x0), y - y0);
}

void Canvas::fill(const Mask& mask, const Color& color, double opacity) {
    shade(mask, opacity, [&](Point) { return color; });
}

void Canvas::glaze(const Mask& mask, const Color& tint, double opacity) {
    each(mask, [&](int x, int y, double covered) {
        const Color below = at(x, y);
        set(x, y, mix(below, below * tint, covered * opacity));
    });
}

void Canvas::glow(Point centre, double radius, const Color& light) {
    const double unit = height();
    const int x0 = std::max(0, floor_int((centre.x - radius) * unit));
    const int x1 = std::min(width() - 1, floor_int((centre.x + radius) * unit));
    const int y0 = std::max(0, floor_int((centre.y - radius) * unit));
    const int y1 = std::min(height() - 1, floor_int((centre.y + radius) * unit));
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const Point d = point(x, y) - centre;
            const double fade = 1 - (d.x * d.x + d.y * d.y) / (radius * radius);
            if (fade > 0) set(x, y, at(x, y) + light * (fade * fade * fade));
        }
    }
}

void Canvas::polygon(std::span<const Point> outline, const Color& color, double opacity) {
    fill(cover_polygon(frame_, outline), color, opacity);
}

void Canvas::disc(Point centre, double radius, const Color& color, double opacity) {
    fill(cover_disc(frame_, centre, radius), color, opacity);
}

void Canvas::rectangle(Point low, Point high, const Color& color, double opacity) {
    const Point corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
    polygon(corners, color, opacity);
}

void Canvas::line(Point from,
                  Point to,
                  double radius,
                  const Color& color,
                  double opacity) {
    const Point points[] = {from, to};
    taper(points, radius, radius, color, opacity);
}

void Canvas::taper(std::span<const Point> points,
                   double radius_from,
                   double radius_to,
                   const Color& color,
                   double opacity) {
    std::vector<double> radii;
    radii.reserve(points.size());
    const auto last = static_cast<double>(std::max<std::size_t>(points.size() - 1, 1));
    for (std::size_t i = 0; i < points.size(); ++i)
        radii.push_back(mix(radius_from, radius_to, static_cast<double>(i) / last));
    fill(cover_stroke(frame_, points, radii), color, opacity);
}

}  // namespace haarmony::gallery
