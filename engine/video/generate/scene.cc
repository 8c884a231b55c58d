#include "engine/video/generate/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace haarmony::video {

void Scene::rectangle(double left, double top, double right, double bottom, Rgba color) {
    shapes_.push_back({Kind::kRectangle, left, top, right, bottom, 0, color});
}

void Scene::ellipse(double x, double y, double radius_x, double radius_y, Rgba color) {
    shapes_.push_back({Kind::kEllipse, x, y, radius_x, radius_y, 0, color});
}

void Scene::line(double x0, double y0, double x1, double y1, double width, Rgba color) {
    shapes_.push_back({Kind::kLine, x0, y0, x1, y1, width / 2, color});
}

double Scene::outside(const Shape& shape, double x, double y) {
    switch (shape.kind) {
        case Kind::kRectangle:
            return std::max({shape.a - x, x - shape.c, shape.b - y, y - shape.d});
        case Kind::kEllipse: {
            const double u = (x - shape.a) / shape.c, v = (y - shape.b) / shape.d;
            return (std::sqrt(u * u + v * v) - 1) * std::min(shape.c, shape.d);
        }
        case Kind::kLine: {
            const double dx = shape.c - shape.a, dy = shape.d - shape.b;
            const double squared = dx * dx + dy * dy;
            const double along =
                squared == 0
                    ? 0
                    : std::clamp(
                          ((x - shape.a) * dx + (y - shape.b) * dy) / squared, 0.0, 1.0);
            const double u = x - shape.a - along * dx, v = y - shape.b - along * dy;
            return std::sqrt(u * u + v * v) - shape.e;
        }
    }
    return 0;
}

Rgba Scene::color_at(double x, double y) const {
    for (auto shape = shapes_.rbegin(); shape != shapes_.rend(); ++shape) {
        if (outside(*shape, x, y) <= 0) return shape->color;
    }
    return background_;
}

class SceneField final : public Field {
  public:
    SceneField(const Scene& scene, double unit) : scene_(scene), unit_(unit) {}

    bool sample(const FieldSquare& square, Brick& brick) const override {
        const double half = 0.5 * kBrickSide * square.cell * unit_;
        const double x = square.left * unit_ + half, y = square.top * unit_ + half;
        const double reach = half * std::numbers::sqrt2;
        // From the top: the shapes that are seen in part, down to one that covers it all.
        Rgba below = scene_.background_;
        std::vector<const Scene::Shape*> crossing;
        for (auto shape = scene_.shapes_.rbegin(); shape != scene_.shapes_.rend();
             ++shape) {
            const double distance = Scene::outside(*shape, x, y);
            if (distance > reach) continue;
            if (distance < -reach) {
                below = shape->color;
                break;
            }
            crossing.push_back(&*shape);
        }
        for (int i = 0; i < kBrickPixels; ++i) {
            const double px = square.x(i) * unit_, py = square.y(i) * unit_;
            Rgba& pixel = brick[static_cast<std::size_t>(i)];
            pixel = below;
            for (const Scene::Shape* shape : crossing) {
                if (Scene::outside(*shape, px, py) > 0) continue;
                pixel = shape->color;
                break;
            }
        }
        return !crossing.empty();
    }

  private:
    const Scene& scene_;
    double unit_;
};

std::unique_ptr<Field> Scene::field(double unit) const {
    return std::make_unique<SceneField>(*this, unit);
}

}  // namespace haarmony::video
