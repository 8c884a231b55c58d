// How much of each pixel a shape covers: antialiased polygons, discs and strokes.
//   [coverage.h] -> canvas.h (paints through a mask) -> varnish.h -> gallery.h
//
// Shape   a Mask is a rectangle of the picture, row-major; nothing is covered outside it.
// Units   Points in picture heights: y in [0, 1], x in [0, aspect]. Coverage in [0, 1].
// Scale   polygons are exact to rounding; discs and strokes take the edge for straight
//         within a pixel (error below 0.05 for radii above two pixels).
// Threads const-safe.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace haarmony::gallery {

struct Point {
    double x = 0;
    double y = 0;
};

[[nodiscard]] inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Point operator*(Point a, double s) { return {a.x * s, a.y * s}; }
[[nodiscard]] double length(Point a);
// Turned about the origin, from x towards y (clockwise on the picture).
[[nodiscard]] Point turned(Point a, double angle);

// The pixels of a picture.
struct Frame {
    int width = 0;
    int height = 0;
    [[nodiscard]] double aspect() const { return static_cast<double>(width) / height; }
};

struct Mask {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<float> coverage;

    [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
    // 0 outside of the rectangle.
    [[nodiscard]] float at(int x, int y) const;
};

// Requires: the outline does not cross itself (where it does, windings of opposite sense
// cancel). It is closed by the edge from the last point to the first.
[[nodiscard]] Mask cover_polygon(const Frame& frame, std::span<const Point> outline);

[[nodiscard]] Mask cover_disc(const Frame& frame, Point centre, double radius);

// Turned by `angle`, from x towards y.
[[nodiscard]] Mask cover_ellipse(const Frame& frame,
                                 Point centre,
                                 double radius_x,
                                 double radius_y,
                                 double angle);

// A brush along the points, as wide as `radii` says at each of them.
// Requires: as many radii as points, at least one.
[[nodiscard]] Mask cover_stroke(const Frame& frame,
                                std::span<const Point> points,
                                std::span<const double> radii);

// Everything that is covered becomes soft; `radius` is the deviation of the blur. The
// result may reach farther than the picture.
[[nodiscard]] Mask soften(const Frame& frame, const Mask& mask, double radius);

// The part of `mask` that `other` does not cover.
[[nodiscard]] Mask without(const Mask& mask, const Mask& other);

// A smooth closed outline through the points (Catmull-Rom), `steps` points for each.
[[nodiscard]] std::vector<Point> smooth_outline(std::span<const Point> points, int steps);

// A smooth way from the first point to the last.
[[nodiscard]] std::vector<Point> smooth_path(std::span<const Point> points, int steps);

}  // namespace haarmony::gallery
