#include "engine/video/generate/julia.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "engine/video/generate/refine.h"

namespace haarmony::video {
namespace {

constexpr int kMostSteps = 192;
constexpr double kFar = 1e4;      // squared; where the distance estimate is good
constexpr double kRadius = 1.65;  // of what is shown, along the shorter side

struct Escape {
    int steps = kMostSteps;
    double distance = 0;  // to the set, in its own units; 0 inside
};

Escape escape_of(double x, double y, std::complex<double> c) {
    double dx = 1, dy = 0;
    for (int step = 0; step < kMostSteps; ++step) {
        const double xx = x * x, yy = y * y;
        if (xx + yy > kFar) {
            const double radius = std::sqrt(xx + yy);
            return {step, radius * std::log(radius) / std::sqrt(dx * dx + dy * dy)};
        }
        const double next_dx = 2 * (x * dx - y * dy);
        dy = 2 * (x * dy + y * dx);
        dx = next_dx;
        y = 2 * x * y + c.imag();
        x = xx - yy + c.real();
    }
    return {};
}

Rgba color_of(int steps) {
    if (steps == kMostSteps) return {0, 0, 0, 255};
    const auto wave = [steps](double period, double phase) {
        return static_cast<std::uint8_t>(127.5 +
                                         127.5 * std::sin(steps / period + phase));
    };
    return {wave(5, 3.6), wave(6, 4.4), wave(9, 5.4), 255};
}

class JuliaField final : public Field {
  public:
    JuliaField(const FrameFormat& format, std::complex<double> c)
        : c_(c),
          unit_(2 * kRadius / std::min(format.width, format.height)),
          middle_x_(0.5 * format.width),
          middle_y_(0.5 * format.height) {}

    bool sample(const FieldSquare& square, Brick& brick) const override {
        int inside = 0;
        bool near = false;
        for (int i = 0; i < kBrickPixels; ++i) {
            const Escape escape = escape_of(
                (square.x(i) - middle_x_) * unit_, (square.y(i) - middle_y_) * unit_, c_);
            brick[static_cast<std::size_t>(i)] = color_of(escape.steps);
            inside += escape.steps == kMostSteps ? 1 : 0;
            near = near || escape.distance < 2 * square.cell * unit_;
        }
        return near && inside < kBrickPixels;
    }

  private:
    std::complex<double> c_;
    double unit_;  // of a pixel, in the plane
    double middle_x_;
    double middle_y_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> julia_frames(const Recipe& recipe) {
    return refined_frames(
        recipe.format, recipe.frames, recipe.depth, [recipe](std::int64_t frame) {
            // Around the Mandelbrot set, where the sets are richest.
            const double angle =
                2.8 + 0.37 * (recipe.seed - 1.0) + 0.01 * static_cast<double>(frame);
            return std::make_unique<JuliaField>(recipe.format, std::polar(0.7885, angle));
        });
}

}  // namespace haarmony::video
