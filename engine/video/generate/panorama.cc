#include "engine/video/generate/panorama.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/video/generate/clip_art.h"
#include "engine/video/generate/lattice_noise.h"
#include "engine/video/generate/room.h"
#include "engine/video/generate/scene.h"

namespace haarmony::video {
namespace {

// The room is 2 wide and long, its eye in the middle, floor and ceiling so far from it.
constexpr double kHeight = 0.6;
constexpr double kTurn = 2 * std::numbers::pi;
// The picture on the second wall.
constexpr double kPictureSide = 0.5;

// One wall, from its left end -1 to its right end 1, from the ceiling down.
Scene wall(int number) {
    const std::array<Rgba, 4> paint = {{{214, 196, 160, 255},
                                        {196, 206, 178, 255},
                                        {214, 196, 160, 255},
                                        {188, 198, 206, 255}}};
    Scene scene(paint[static_cast<std::size_t>(number)]);
    const Rgba wood{112, 76, 48, 255}, dark{70, 46, 30, 255};
    scene.rectangle(-1, 0.5, 1, 0.6, wood);
    scene.line(-1, 0.5, 1, 0.5, 0.012, dark);
    const auto window = [&](double middle) {
        scene.rectangle(middle - 0.27, -0.4, middle + 0.27, 0.22, {240, 240, 236, 255});
        scene.rectangle(middle - 0.24, -0.37, middle + 0.24, 0.19, kClear);
        scene.line(middle, -0.37, middle, 0.19, 0.02, {240, 240, 236, 255});
        scene.line(
            middle - 0.24, -0.12, middle + 0.24, -0.12, 0.02, {240, 240, 236, 255});
        scene.rectangle(middle - 0.3, 0.22, middle + 0.3, 0.26, {226, 224, 216, 255});
    };
    const auto picture = [&](double middle, double half, Rgba color) {
        scene.rectangle(
            middle - half - 0.03, -half - 0.08, middle + half + 0.03, half - 0.02, dark);
        scene.rectangle(middle - half, -half - 0.05, middle + half, half - 0.05, color);
    };
    switch (number) {
        case 0:
            window(-0.45);
            window(0.45);
            break;
        case 1:
            picture(0, kPictureSide / 2, {20, 20, 20, 255});
            picture(-0.7, 0.12, {150, 60, 50, 255});
            scene.ellipse(-0.7, -0.05, 0.06, 0.08, {230, 190, 90, 255});
            break;
        case 2:
            window(0.5);
            scene.rectangle(-0.66, -0.42, -0.14, 0.6, dark);
            scene.rectangle(-0.62, -0.38, -0.18, 0.6, wood);
            scene.ellipse(-0.24, 0.12, 0.02, 0.02, {220, 190, 90, 255});
            break;
        default:
            for (int shelf = 0; shelf < 4; ++shelf) {
                const double y = -0.35 + 0.22 * shelf;
                for (int book = 0; book < 22; ++book) {
                    const std::uint32_t bits =
                        scrambled(static_cast<std::uint32_t>(31 * shelf + book));
                    const double x = -0.6 + 0.054 * book;
                    scene.rectangle(x,
                                    y - 0.1 - 0.06 * (bits >> 24) / 255.0,
                                    x + 0.048,
                                    y,
                                    {static_cast<std::uint8_t>(60 + bits % 140),
                                     static_cast<std::uint8_t>(40 + (bits >> 8) % 120),
                                     static_cast<std::uint8_t>(40 + (bits >> 16) % 100),
                                     255});
                }
                scene.rectangle(-0.64, y, 0.64, y + 0.025, wood);
            }
            break;
    }
    return scene;
}

// What a ray meets that leaves the eye at an angle and rises or falls with a slope.
class RoomAround {
  public:
    RoomAround() : walls_{wall(0), wall(1), wall(2), wall(3)} {}

    [[nodiscard]] Rgba color_at(double angle, double slope) const {
        const auto number = static_cast<int>(std::floor(angle / (kTurn / 4) + 0.5)) & 3;
        const double along = std::tan(angle - number * (kTurn / 4));
        // To the wall, in the plane.
        const double distance = std::sqrt(1 + along * along);
        const double y = slope * distance;
        if (std::abs(y) <= kHeight) {
            return walls_[static_cast<std::size_t>(number)].color_at(along, y);
        }
        const double reach = kHeight / std::abs(slope);
        const double u = reach * std::cos(angle), v = reach * std::sin(angle);
        if (slope < 0) {
            return u * u + v * v < 0.04 ? Rgba{255, 250, 220, 255}
                                        : Rgba{236, 234, 228, 255};
        }
        const auto plank = static_cast<int>(std::floor(8 * v));
        const auto shade = static_cast<std::uint8_t>(
            scrambled(static_cast<std::uint32_t>(plank + 64)) % 40);
        return {static_cast<std::uint8_t>(130 + shade),
                static_cast<std::uint8_t>(92 + shade),
                static_cast<std::uint8_t>(60 + shade / 2),
                255};
    }

  private:
    std::array<Scene, 4> walls_;
};

// Angles go around with x; slopes are 0 at the picture's middle.
class PanoramaField : public Field {
  public:
    // Nothing is hidden between samples that are as close as `closest`, a part of the
    // turn.
    PanoramaField(const FrameFormat& format, double closest)
        : turn_(kTurn / format.width),
          middle_(0.5 * format.height),
          closest_(closest * kTurn) {}

    bool sample(const FieldSquare& square, Brick& brick) const final {
        bool alike = true;
        for (int i = 0; i < kBrickPixels; ++i) {
            Rgba& pixel = brick[static_cast<std::size_t>(i)];
            pixel = color_at(square.x(i) * turn_, (square.y(i) - middle_) * turn_);
            alike = alike && pixel == brick[0];
        }
        return !alike || square.cell * turn_ > closest_;
    }

  private:
    [[nodiscard]] virtual Rgba color_at(double angle, double slope) const = 0;

    double turn_;
    double middle_;
    double closest_;
};

class WallsField final : public PanoramaField {
  public:
    explicit WallsField(const FrameFormat& format) : PanoramaField(format, 1.0 / 1000) {}

  private:
    [[nodiscard]] Rgba color_at(double angle, double slope) const override {
        return room_.color_at(angle, slope);
    }
    RoomAround room_;
};

class SkyField final : public PanoramaField {
  public:
    SkyField(const FrameFormat& format, std::int64_t frame, std::uint32_t seed)
        : PanoramaField(format, 1.0 / 200),
          noise_(seed),
          drift_(0.04 * static_cast<double>(frame)) {}

  private:
    // Noise on a cylinder: it comes around without a seam.
    [[nodiscard]] Rgba color_at(double angle, double slope) const override {
        if (slope > 0.02) return {96, 140, 72, 255};
        const double x = std::cos(angle), y = std::sin(angle);
        const double cloud = noise_(4 * x, 4 * y, 6 * slope + drift_) +
                             0.5 * noise_(11 * x + 3, 11 * y, 14 * slope + 2 * drift_);
        const double white = std::floor(6 * std::clamp(cloud + 0.3, 0.0, 0.99)) / 5;
        return {static_cast<std::uint8_t>(110 + 140 * white),
                static_cast<std::uint8_t>(170 + 80 * white),
                static_cast<std::uint8_t>(230 + 20 * white),
                255};
    }
    LatticeNoise noise_;
    double drift_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> panorama_frames(const Recipe& recipe) {
    const double width = static_cast<double>(recipe.format.width) / recipe.format.height;
    ClipArt art(recipe);
    const Recipe sky = art.piece(width, 1, 4);
    const auto clouds =
        refined_frames(sky.format, sky.frames, sky.depth, [sky](std::int64_t frame) {
            return std::make_unique<SkyField>(sky.format, frame, sky.seed);
        });
    if (Result<void> done = art.add(*clouds, 0, 0, 4); !done) return done.error();
    const Recipe around = art.piece(width, 1, 1);
    const auto walls =
        refined_frames(around.format, 1, around.depth, [around](std::int64_t) {
            return std::make_unique<WallsField>(around.format);
        });
    if (Result<void> done = art.add(*walls, 0, 0, 1); !done) return done.error();
    // The middle of the second wall is a quarter of the way around.
    const double unit = width / kTurn;
    const double side = 2 * unit * std::atan(kPictureSide / 2);
    const auto picture = room_frames(art.piece(side, side, 1));
    if (!picture) return picture.error();
    if (Result<void> done =
            art.add(**picture, width / 4 - side / 2, 0.5 - 0.05 * unit - side / 2, 1);
        !done) {
        return done.error();
    }
    return art.composed();
}

}  // namespace haarmony::video
