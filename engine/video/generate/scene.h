// Flat shapes on top of each other: what the generated clip-art is drawn with.
//   [scene.h] -> refine.h, room.h, panorama.h
//
// Shape    rectangles, ellipses and thick lines; the last one that covers a point is
//          seen.
// Units    the drawing's own; Scene::Field says how many of them a pixel is.
// Errors   none.
// Cost     of a square: one look at each shape, and for each pixel one at each shape
//          whose outline crosses the square.
#pragma once

#include <vector>

#include "engine/video/generate/refine.h"
#include "engine/video/pixel.h"

namespace haarmony::video {

class Scene {
  public:
    explicit Scene(Rgba background) : background_(background) {}

    void rectangle(double left, double top, double right, double bottom, Rgba color);
    void ellipse(double x, double y, double radius_x, double radius_y, Rgba color);
    void line(double x0, double y0, double x1, double y1, double width, Rgba color);

    [[nodiscard]] Rgba color_at(double x, double y) const;

    // The scene as a frame whose pixels are `unit` wide; (0, 0) of both is the same.
    // The scene must outlive it.
    [[nodiscard]] std::unique_ptr<Field> field(double unit) const;

  private:
    friend class SceneField;
    enum class Kind : std::uint8_t { kRectangle, kEllipse, kLine };
    struct Shape {
        Kind kind;
        double a, b, c, d, e;
        Rgba color;
    };
    // How far a point is from the outline at least, negative inside.
    [[nodiscard]] static double outside(const Shape& shape, double x, double y);

    Rgba background_;
    std::vector<Shape> shapes_;
};

}  // namespace haarmony::video
