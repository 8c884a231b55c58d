// A picture in linear light that is painted on, shape by shape:
//   coverage.h (where) and palette.h (which colour) -> [canvas.h] -> varnish.h (to bytes)
//
// Shape   row-major pixels of three floats.
// Units   linear light, 1 = display white, may exceed it. Points in picture heights.
// Errors  none at run time; a pixel outside is a caller's bug and asserts.
// Threads one thread a canvas.
#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "ingest/gallery/coverage.h"
#include "ingest/gallery/palette.h"

namespace haarmony::gallery {

class Canvas {
  public:
    // Black. Requires: width, height >= 1.
    Canvas(int width, int height);

    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] int width() const { return frame_.width; }
    [[nodiscard]] int height() const { return frame_.height; }
    [[nodiscard]] double aspect() const { return frame_.aspect(); }
    // The side of one pixel.
    [[nodiscard]] double pixel() const { return 1.0 / frame_.height; }
    // The middle of a pixel.
    [[nodiscard]] Point point(int x, int y) const {
        return {(x + 0.5) / frame_.height, (y + 0.5) / frame_.height};
    }

    [[nodiscard]] Color at(int x, int y) const {
        const float* p = pixel_at(x, y);
        return {p[0], p[1], p[2]};
    }
    void set(int x, int y, const Color& color) {
        float* p = pixel_at(x, y);
        p[0] = static_cast<float>(color.r);
        p[1] = static_cast<float>(color.g);
        p[2] = static_cast<float>(color.b);
    }
    // Between the middles of four pixels; clamped at the border.
    [[nodiscard]] Color sample(Point at) const;

    // color(point) for every pixel.
    template <typename F>
    void cover(F&& color) {
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x) set(x, y, color(point(x, y)));
    }
    // color(point, below) for every pixel, `below` being what is there.
    template <typename F>
    void rework(F&& color) {
        for (int y = 0; y < height(); ++y)
            for (int x = 0; x < width(); ++x) set(x, y, color(point(x, y), at(x, y)));
    }

    // Lays color(point) over what is there, as opaque as the mask says.
    template <typename F>
    void shade(const Mask& mask, double opacity, F&& color) {
        each(mask, [&](int x, int y, double covered) {
            set(x, y, mix(at(x, y), color(point(x, y)), covered * opacity));
        });
    }
    void fill(const Mask& mask, const Color& color, double opacity = 1);
    // Multiplies by `tint` where the mask covers: shadows and glazes.
    void glaze(const Mask& mask, const Color& tint, double opacity = 1);
    // Adds light that fades to nothing at `radius`.
    void glow(Point centre, double radius, const Color& light);

    // Short forms for the shapes that are used most.
    void polygon(std::span<const Point> outline, const Color& color, double opacity = 1);
    void disc(Point centre, double radius, const Color& color, double opacity = 1);
    void rectangle(Point low, Point high, const Color& color, double opacity = 1);
    void line(Point from,
              Point to,
              double radius,
              const Color& color,
              double opacity = 1);
    // A line that thins out.
    void taper(std::span<const Point> points,
               double radius_from,
               double radius_to,
               const Color& color,
               double opacity = 1);

    // work(x, y, coverage) for each pixel of the picture that the mask touches.
    template <typename F>
    void each(const Mask& mask, F&& work) const {
        for (int row = 0; row < mask.height; ++row) {
            const int y = mask.top + row;
            if (y < 0 || y >= height()) continue;
            const float* line =
                &mask.coverage[static_cast<std::size_t>(row) * mask.width];
            for (int column = 0; column < mask.width; ++column) {
                const int x = mask.left + column;
                if (line[column] > 0 && x >= 0 && x < width()) work(x, y, line[column]);
            }
        }
    }

  private:
    [[nodiscard]] const float* pixel_at(int x, int y) const {
        assert(x >= 0 && y >= 0 && x < width() && y < height());
        return &light_[(static_cast<std::size_t>(y) * width() + x) * 3];
    }
    [[nodiscard]] float* pixel_at(int x, int y) {
        assert(x >= 0 && y >= 0 && x < width() && y < height());
        return &light_[(static_cast<std::size_t>(y) * width() + x) * 3];
    }

    Frame frame_;
    std::vector<float> light_;
};

}  // namespace haarmony::gallery
