#include "ingest/gallery/coverage.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "ingest/gallery/elementary.h"

namespace haarmony::gallery {
namespace {

// The pixels of the frame that a box of picture coordinates touches, one to spare.
Mask box(const Frame& frame, double left, double top, double right, double bottom) {
    const double unit = frame.height;
    const auto pixel = [unit](double v, int limit) {
        return floor_int(clamp(v * unit, -1, limit + 1));
    };
    Mask mask;
    if (right * unit < -1 || bottom * unit < -1 || left * unit > frame.width + 1 ||
        top * unit > frame.height + 1)
        return mask;
    mask.left = std::max(0, pixel(left, frame.width) - 1);
    mask.top = std::max(0, pixel(top, frame.height) - 1);
    mask.width = std::min(frame.width, pixel(right, frame.width) + 2) - mask.left;
    mask.height = std::min(frame.height, pixel(bottom, frame.height) + 2) - mask.top;
    if (mask.empty()) return {};
    mask.coverage.assign(static_cast<std::size_t>(mask.width) * mask.height, 0.0F);
    return mask;
}

// Sums signed areas to the right of edges; the running sum along a row is the coverage.
class AreaSum {
  public:
    AreaSum(int width, int height)
        : width_(width),
          height_(height),
          stride_(static_cast<std::size_t>(width) + 2),
          area_(stride_ * static_cast<std::size_t>(height)) {}

    // In pixels of the mask.
    void edge(Point from, Point to) {
        if (from.y == to.y) return;
        double sense = 1;
        if (from.y > to.y) {
            std::swap(from, to);
            sense = -1;
        }
        if (to.y <= 0 || from.y >= height_) return;
        const double dxdy = (to.x - from.x) / (to.y - from.y);
        const int first = std::max(0, floor_int(from.y));
        const int last = std::min(height_ - 1, floor_int(to.y));
        for (int y = first; y <= last; ++y) {
            const double y0 = std::max(from.y, static_cast<double>(y));
            const double y1 = std::min(to.y, static_cast<double>(y) + 1);
            if (y1 <= y0) continue;
            clip(y,
                 from.x + (y0 - from.y) * dxdy,
                 from.x + (y1 - from.y) * dxdy,
                 sense * (y1 - y0));
        }
    }

    void write(Mask& mask) const {
        for (int y = 0; y < height_; ++y) {
            double sum = 0;
            for (int x = 0; x < width_; ++x) {
                sum += area_[static_cast<std::size_t>(y) * stride_ + x];
                mask.coverage[static_cast<std::size_t>(y) * width_ + x] =
                    static_cast<float>(std::min(1.0, std::fabs(sum)));
            }
        }
    }

  private:
    // An edge within one row, cut at the borders: what lies left of the mask acts as if
    // it stood on its border, what lies right of it does nothing.
    void clip(int y, double x0, double x1, double dy) {
        if (x0 > x1) std::swap(x0, x1);
        const double limit = width_;
        if (x0 >= limit) return;
        if (x1 <= 0) return row(y, 0, 0, dy);
        const double span = x1 - x0;
        if (x0 < 0) {
            row(y, 0, 0, dy * (-x0 / span));
            dy *= x1 / span;
            x0 = 0;
        }
        if (x1 > limit) {
            dy *= (limit - x0) / (x1 - x0);
            x1 = limit;
        }
        row(y, x0, x1, dy);
    }

    // Requires: 0 <= x0 <= x1 <= width.
    void row(int y, double x0, double x1, double dy) {
        double* line = &area_[static_cast<std::size_t>(y) * stride_];
        const int first = floor_int(x0);
        if (x1 <= first + 1) {
            const double right = dy * (first + 1 - (x0 + x1) / 2);
            line[first] += right;
            line[first + 1] += dy - right;
            return;
        }
        const double steepness = dy / (x1 - x0);
        double given = 0;
        for (int x = first; x < x1; ++x) {
            const double a = std::max(x0, static_cast<double>(x));
            const double b = std::min(x1, static_cast<double>(x) + 1);
            // Area right of the edge inside this pixel, less what earlier pixels gave on.
            const double piece = (b - a) * steepness;
            const double right = piece * (x + 1 - (a + b) / 2);
            line[x] += right + given;
            given = piece - right;
        }
        line[floor_int(x1) == x1 ? static_cast<int>(x1) : floor_int(x1) + 1] += given;
    }

    int width_;
    int height_;
    std::size_t stride_;
    std::vector<double> area_;
};

// One slanted brush mark: the distance to a segment whose radius changes along it.
void stroke_segment(const Frame& frame,
                    Mask& mask,
                    Point a,
                    Point b,
                    double ra,
                    double rb) {
    const double unit = frame.height;
    const double reach = std::max(ra, rb) * unit + 1;
    const Point p{a.x * unit, a.y * unit};
    const Point d{(b.x - a.x) * unit, (b.y - a.y) * unit};
    const double square = d.x * d.x + d.y * d.y;
    const auto from = [](double v, double low, double high) {
        return floor_int(clamp(v, low, high));
    };
    const int left = mask.left;
    const int right = mask.left + mask.width;
    const int top = mask.top;
    const int bottom = mask.top + mask.height;
    const int x0 = from(std::min(p.x, p.x + d.x) - reach, left, right);
    const int x1 = from(std::max(p.x, p.x + d.x) + reach + 1, left, right);
    const int y0 = from(std::min(p.y, p.y + d.y) - reach, top, bottom);
    const int y1 = from(std::max(p.y, p.y + d.y) + reach + 1, top, bottom);
    for (int y = y0; y < y1; ++y) {
        float* row = &mask.coverage[static_cast<std::size_t>(y - top) * mask.width];
        for (int x = x0; x < x1; ++x) {
            const Point q{x + 0.5 - p.x, y + 0.5 - p.y};
            const double t = square > 0 ? clamp01((q.x * d.x + q.y * d.y) / square) : 0.0;
            const double width = mix(ra, rb, t) * unit;
            // A hair thinner than a pixel covers as much of it as it is wide.
            const double radius = std::max(width, 0.5);
            const double ex = q.x - d.x * t;
            const double ey = q.y - d.y * t;
            const double distance = std::sqrt(ex * ex + ey * ey);
            const double covered =
                clamp01(radius - distance + 0.5) * std::min(1.0, 2 * width);
            float& value = row[x - left];
            value = std::max(value, static_cast<float>(covered));
        }
    }
}

}  // namespace

double length(Point a) { return std::sqrt(a.x * a.x + a.y * a.y); }

Point turned(Point a, double angle) {
    const double c = cosine(angle);
    const double s = sine(angle);
    return {a.x * c - a.y * s, a.x * s + a.y * c};
}

float Mask::at(int x, int y) const {
    if (x < left || y < top || x >= left + width || y >= top + height) return 0;
    return coverage[static_cast<std::size_t>(y - top) * width + (x - left)];
}

Mask cover_polygon(const Frame& frame, std::span<const Point> outline) {
    if (outline.size() < 3) return {};
    Point low = outline[0];
    Point high = outline[0];
    for (const Point p : outline) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    Mask mask = box(frame, low.x, low.y, high.x, high.y);
    if (mask.empty()) return mask;
    AreaSum area(mask.width, mask.height);
    const double unit = frame.height;
    const auto local = [&](Point p) {
        return Point{p.x * unit - mask.left, p.y * unit - mask.top};
    };
    for (std::size_t i = 0; i < outline.size(); ++i)
        area.edge(local(outline[i]), local(outline[(i + 1) % outline.size()]));
    area.write(mask);
    return mask;
}

Mask cover_disc(const Frame& frame, Point centre, double radius) {
    const double radii[] = {radius};
    return cover_stroke(frame, {&centre, 1}, radii);
}

Mask cover_ellipse(const Frame& frame,
                   Point centre,
                   double radius_x,
                   double radius_y,
                   double angle) {
    constexpr int kCorners = 96;
    std::vector<Point> outline;
    outline.reserve(kCorners);
    for (int i = 0; i < kCorners; ++i) {
        const double t = kTurn * i / kCorners;
        const Point p{radius_x * cosine(t), radius_y * sine(t)};
        outline.push_back(centre + turned(p, angle));
    }
    return cover_polygon(frame, outline);
}

Mask cover_stroke(const Frame& frame,
                  std::span<const Point> points,
                  std::span<const double> radii) {
    assert(!points.empty() && points.size() == radii.size());
    Point low = points[0];
    Point high = points[0];
    double widest = radii[0];
    for (std::size_t i = 1; i < points.size(); ++i) {
        low = {std::min(low.x, points[i].x), std::min(low.y, points[i].y)};
        high = {std::max(high.x, points[i].x), std::max(high.y, points[i].y)};
        widest = std::max(widest, radii[i]);
    }
    Mask mask =
        box(frame, low.x - widest, low.y - widest, high.x + widest, high.y + widest);
    if (mask.empty()) return mask;
    for (std::size_t i = 0; i + 1 < std::max<std::size_t>(points.size(), 2); ++i) {
        const std::size_t next = std::min(i + 1, points.size() - 1);
        stroke_segment(frame, mask, points[i], points[next], radii[i], radii[next]);
    }
    return mask;
}

Mask soften(const Frame& frame, const Mask& mask, double radius) {
    if (mask.empty()) return {};
    // Three box blurs of this half width have the deviation of the wanted Gaussian.
    const double deviation = radius * frame.height;
    const int half =
        std::max(1, floor_int((std::sqrt(4 * deviation * deviation + 1) - 1) / 2 + 0.5));
    const int pad = 3 * half;
    Mask soft;
    soft.left = mask.left - pad;
    soft.top = mask.top - pad;
    soft.width = mask.width + 2 * pad;
    soft.height = mask.height + 2 * pad;
    const auto width = static_cast<std::size_t>(soft.width);
    const auto height = static_cast<std::size_t>(soft.height);
    soft.coverage.assign(width * height, 0.0F);
    for (int y = 0; y < mask.height; ++y)
        std::copy_n(&mask.coverage[static_cast<std::size_t>(y) * mask.width],
                    mask.width,
                    &soft.coverage[static_cast<std::size_t>(y + pad) * width + pad]);
    std::vector<double> line(std::max(width, height));
    const auto blur = [&](std::size_t start, std::size_t step, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) line[i] = soft.coverage[start + i * step];
        const auto reach = static_cast<std::size_t>(half);
        double sum = 0;
        for (std::size_t i = 0; i < std::min(reach, count); ++i) sum += line[i];
        for (std::size_t i = 0; i < count; ++i) {
            if (i + reach < count) sum += line[i + reach];
            if (i > reach) sum -= line[i - reach - 1];
            soft.coverage[start + i * step] =
                static_cast<float>(clamp01(sum / (2 * half + 1)));
        }
    };
    for (int pass = 0; pass < 3; ++pass) {
        for (std::size_t y = 0; y < height; ++y) blur(y * width, 1, width);
        for (std::size_t x = 0; x < width; ++x) blur(x, width, height);
    }
    return soft;
}

Mask without(const Mask& mask, const Mask& other) {
    Mask rest = mask;
    for (int y = 0; y < mask.height; ++y) {
        for (int x = 0; x < mask.width; ++x)
            rest.coverage[static_cast<std::size_t>(y) * mask.width + x] *=
                1 - other.at(mask.left + x, mask.top + y);
    }
    return rest;
}

namespace {

Point catmull_rom(Point a, Point b, Point c, Point d, double t) {
    const Point linear = (c - a) * (0.5 * t);
    const Point square = (a * 2 - b * 5 + c * 4 - d) * (0.5 * t * t);
    const Point cube = (b * 3 - a - c * 3 + d) * (0.5 * t * t * t);
    return b + linear + square + cube;
}

}  // namespace

std::vector<Point> smooth_outline(std::span<const Point> points, int steps) {
    std::vector<Point> outline;
    const std::size_t n = points.size();
    outline.reserve(n * static_cast<std::size_t>(steps));
    for (std::size_t i = 0; i < n; ++i) {
        for (int step = 0; step < steps; ++step)
            outline.push_back(catmull_rom(points[(i + n - 1) % n],
                                          points[i],
                                          points[(i + 1) % n],
                                          points[(i + 2) % n],
                                          static_cast<double>(step) / steps));
    }
    return outline;
}

std::vector<Point> smooth_path(std::span<const Point> points, int steps) {
    std::vector<Point> path;
    if (points.empty()) return path;
    const std::size_t last = points.size() - 1;
    for (std::size_t i = 0; i < last; ++i) {
        for (int step = 0; step < steps; ++step)
            path.push_back(catmull_rom(points[i == 0 ? 0 : i - 1],
                                       points[i],
                                       points[i + 1],
                                       points[std::min(i + 2, last)],
                                       static_cast<double>(step) / steps));
    }
    path.push_back(points[last]);
    return path;
}

}  // namespace haarmony::gallery
