#include "engine/video/generate/wind.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/video/generate/lattice_noise.h"
#include "engine/video/generate/refine.h"

namespace haarmony::video {
namespace {

struct Wind {
    double east = 0;
    double south = 0;
};

// Hue is the direction, in six steps from red to red; value the magnitude, at most 1.
Rgba color_of(const Wind& wind) {
    const double value =
        std::min(1.0, std::sqrt(wind.east * wind.east + wind.south * wind.south));
    const double hue =
        3 + 3 / std::numbers::pi * std::atan2(wind.south, wind.east);  // 0 .. 6
    const auto channel = [&](double from) {
        const double away = std::abs(std::fmod(hue + 6 - from, 6.0) - 3);
        return static_cast<std::uint8_t>(255 * value * std::clamp(away - 1, 0.0, 1.0));
    };
    return {channel(3), channel(5), channel(1), 255};
}

class WindField final : public Field {
  public:
    WindField(const FrameFormat& format, std::int64_t frame, std::uint32_t seed)
        : unit_(1.0 / std::max(format.width, format.height)),
          height_(format.height * unit_),
          day_(static_cast<double>(frame)),
          land_(seed),
          east_(seed + 1),
          south_(seed + 2) {}

    bool sample(const FieldSquare& square, Brick& brick) const override {
        for (int i = 0; i < kBrickPixels; ++i) {
            brick[static_cast<std::size_t>(i)] =
                color_of(wind_at(square.x(i) * unit_, square.y(i) * unit_));
        }
        return true;
    }

  private:
    [[nodiscard]] Wind wind_at(double x, double y) const {
        // Trade winds blow to the west near the equator, to the east beyond them.
        const double latitude = 2 * y / height_ - 1;
        Wind wind{-0.7 * std::cos(1.5 * std::numbers::pi * latitude), 0.15 * latitude};
        // Weather: large and slow, and small and new every day.
        wind.east += 0.5 * east_(5 * x - 0.05 * day_, 5 * y, 0.2 * day_) +
                     0.25 * east_(32 * x, 32 * y, day_ + 0.5);
        wind.south += 0.5 * south_(5 * x - 0.05 * day_, 5 * y, 0.2 * day_) +
                      0.25 * south_(32 * x, 32 * y, day_ + 0.5);
        const double land = land_(3 * x, 3 * y, 0.5) + 0.4 * land_(11 * x, 11 * y, 7.5);
        const double drag = 0.2 + 0.8 * std::clamp(0.5 - 12 * (land - 0.15), 0.0, 1.0);
        return {wind.east * drag, wind.south * drag};
    }

    double unit_;
    double height_;
    double day_;
    LatticeNoise land_;
    LatticeNoise east_;
    LatticeNoise south_;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> wind_frames(const Recipe& recipe) {
    return refined_frames(
        recipe.format, recipe.frames, recipe.depth, [recipe](std::int64_t frame) {
            return std::make_unique<WindField>(recipe.format, frame, recipe.seed);
        });
}

}  // namespace haarmony::video
