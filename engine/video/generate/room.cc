#include "engine/video/generate/room.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/video/generate/clip_art.h"
#include "engine/video/generate/julia.h"
#include "engine/video/generate/lattice_noise.h"
#include "engine/video/generate/scene.h"

namespace haarmony::video {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kFloor = 0.62;  // where it begins
// The television's screen.
constexpr double kScreenLeft = 0.66, kScreenTop = 0.47;
constexpr double kScreenWidth = 0.24, kScreenHeight = 0.18;
// The clock's square.
constexpr double kClockLeft = 0.16, kClockTop = 0.08, kClockSide = 0.2;

std::uint8_t shaded(int value, double by) {
    return static_cast<std::uint8_t>(std::clamp(value + by, 0.0, 255.0));
}

// Short strokes of about one colour, as a painter fills a wall.
void strokes(Scene& scene,
             double left,
             double top,
             double right,
             double bottom,
             double slope,
             Rgba color,
             std::uint32_t seed) {
    for (std::uint32_t i = 0; i < 160; ++i) {
        const auto random = [&](std::uint32_t what) {
            return scrambled(scrambled(seed + 31 * what) + i) / 4294967296.0;
        };
        const double length = 0.04 + 0.05 * random(0);
        const double x = left + (right - left - length) * random(1);
        const double y = top + (bottom - top - length * std::abs(slope)) * random(2);
        const double light = 28 * (random(3) - 0.5);
        scene.line(x,
                   y + (slope < 0 ? -slope * length : 0),
                   x + length,
                   y + (slope > 0 ? slope * length : 0),
                   0.012,
                   {shaded(color.r, light),
                    shaded(color.g, light),
                    shaded(color.b, light),
                    255});
    }
}

Scene background(double width, std::uint32_t seed) {
    Scene scene({120, 160, 205, 255});
    strokes(scene, 0, 0, width, kFloor, 0.5, {120, 160, 205, 255}, seed);
    scene.rectangle(0, kFloor, width, 1, {168, 112, 74, 255});
    strokes(scene, 0, kFloor, width, 1, 0.1, {168, 112, 74, 255}, seed + 1);
    for (int i = 1; i < 6; ++i) {
        const double y = kFloor + 0.012 * i * i + 0.02 * i;
        scene.line(0, y, width, y, 0.006, {104, 66, 44, 255});
    }
    // A window with its shutters open.
    scene.rectangle(0.42, 0.1, 0.58, 0.4, {70, 110, 60, 255});
    scene.rectangle(0.435, 0.115, 0.565, 0.385, {236, 232, 170, 255});
    scene.line(0.5, 0.115, 0.5, 0.385, 0.012, {70, 110, 60, 255});
    scene.line(0.435, 0.25, 0.565, 0.25, 0.012, {70, 110, 60, 255});
    // A bed.
    scene.rectangle(0.02, 0.5, 0.06, 0.92, {206, 140, 40, 255});
    scene.rectangle(0.05, 0.68, 0.5, 0.86, {190, 48, 44, 255});
    scene.rectangle(0.05, 0.64, 0.2, 0.74, {242, 236, 214, 255});
    scene.rectangle(0.48, 0.62, 0.52, 0.94, {206, 140, 40, 255});
    // A television on its table.
    scene.line(0.68, 0.74, 0.64, 0.94, 0.02, {92, 60, 40, 255});
    scene.line(0.88, 0.74, 0.92, 0.94, 0.02, {92, 60, 40, 255});
    scene.rectangle(0.6, 0.71, 0.96, 0.75, {120, 78, 48, 255});
    scene.line(0.78, 0.44, 0.7, 0.36, 0.008, {60, 60, 64, 255});
    scene.line(0.78, 0.44, 0.86, 0.36, 0.008, {60, 60, 64, 255});
    scene.rectangle(kScreenLeft - 0.03,
                    kScreenTop - 0.03,
                    kScreenLeft + kScreenWidth + 0.03,
                    kScreenTop + kScreenHeight + 0.06,
                    {52, 46, 44, 255});
    scene.ellipse(
        0.68, kScreenTop + kScreenHeight + 0.03, 0.012, 0.012, {200, 60, 50, 255});
    return scene;
}

Scene clock(std::int64_t frame) {
    constexpr double middle = kClockSide / 2;
    Scene scene(kClear);
    scene.ellipse(middle, middle, 0.096, 0.096, {90, 52, 30, 255});
    scene.ellipse(middle, middle, 0.084, 0.084, {250, 246, 232, 255});
    const auto hand =
        [&](double turns, double from, double to, double width, Rgba color) {
            const double x = std::sin(kTurn * turns), y = -std::cos(kTurn * turns);
            scene.line(middle + from * x,
                       middle + from * y,
                       middle + to * x,
                       middle + to * y,
                       width,
                       color);
        };
    for (int hour = 0; hour < 12; ++hour) {
        hand(hour / 12.0, 0.068, 0.076, 0.006, {40, 40, 40, 255});
    }
    const auto seconds = static_cast<double>(frame);
    hand(0.84 + seconds / 43'200, 0, 0.045, 0.012, {20, 20, 20, 255});
    hand(0.13 + seconds / 3'600, 0, 0.066, 0.008, {20, 20, 20, 255});
    hand(seconds / 60, -0.016, 0.072, 0.004, {200, 30, 30, 255});
    return scene;
}

// On its way through the room; its wings are up in one frame and down in the next.
Scene bee(double width, std::int64_t frame) {
    const auto now = static_cast<double>(frame);
    const double x = width * (0.5 + 0.36 * std::sin(0.05 * now + 1));
    const double y = 0.4 + 0.22 * std::sin(0.113 * now) + 0.01 * std::sin(1.9 * now);
    const double heading = std::cos(0.05 * now + 1) > 0 ? 1 : -1;
    const Rgba black{24, 20, 16, 255}, yellow{250, 200, 30, 255};
    const Rgba wing{235, 240, 255, 150};
    Scene scene(kClear);
    scene.ellipse(
        x - heading * 0.004, y - (frame % 2 == 0 ? 0.022 : 0.012), 0.01, 0.016, wing);
    scene.ellipse(
        x + heading * 0.01, y - (frame % 2 == 0 ? 0.02 : 0.011), 0.009, 0.014, wing);
    scene.ellipse(x, y, 0.026, 0.015, yellow);
    for (const double stripe : {-0.012, 0.0, 0.012}) {
        const double half = 0.0145 * std::sqrt(1 - stripe * stripe / (0.026 * 0.026));
        scene.line(
            x + stripe, y - half + 0.003, x + stripe, y + half - 0.003, 0.006, black);
    }
    scene.ellipse(x + heading * 0.026, y - 0.002, 0.009, 0.009, black);
    scene.ellipse(x + heading * 0.029, y - 0.004, 0.0022, 0.0022, {255, 255, 255, 255});
    scene.line(
        x + heading * 0.03, y - 0.009, x + heading * 0.038, y - 0.018, 0.0016, black);
    return scene;
}

// A scene that its field holds on to.
class OwnScene final : public Field {
  public:
    OwnScene(Scene scene, double unit)
        : scene_(std::move(scene)), field_(scene_.field(unit)) {}
    bool sample(const FieldSquare& square, Brick& brick) const override {
        return field_->sample(square, brick);
    }

  private:
    Scene scene_;
    std::unique_ptr<Field> field_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> room_frames(const Recipe& recipe) {
    const double width = static_cast<double>(recipe.format.width) / recipe.format.height;
    ClipArt art(recipe);
    const auto add = [&art](const Recipe& piece,
                            double left,
                            double top,
                            int cell,
                            auto scene) {
        const double unit = art.unit(cell);
        const auto source = refined_frames(
            piece.format, piece.frames, piece.depth, [unit, scene](std::int64_t frame) {
                return std::make_unique<OwnScene>(scene(frame), unit);
            });
        return art.add(*source, left, top, cell);
    };
    Recipe still = art.piece(width, 1, 4);
    still.frames = 1;
    const std::uint32_t seed = recipe.seed;
    if (Result<void> done =
            add(still, 0, 0, 4, [=](auto) { return background(width, seed); });
        !done) {
        return done.error();
    }
    const auto julia = julia_frames(art.piece(kScreenWidth, kScreenHeight, 2));
    if (!julia) return julia.error();
    if (Result<void> done = art.add(**julia, kScreenLeft, kScreenTop, 2); !done) {
        return done.error();
    }
    if (Result<void> done = add(art.piece(kClockSide, kClockSide, 1),
                                kClockLeft,
                                kClockTop,
                                1,
                                [](std::int64_t frame) { return clock(frame); });
        !done) {
        return done.error();
    }
    if (Result<void> done = add(art.piece(width, 1, 1),
                                0,
                                0,
                                1,
                                [=](std::int64_t frame) { return bee(width, frame); });
        !done) {
        return done.error();
    }
    return art.composed();
}

}  // namespace haarmony::video
