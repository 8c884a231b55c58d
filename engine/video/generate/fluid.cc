#include "engine/video/generate/fluid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/video/generate/lattice_noise.h"
#include "engine/video/generate/refine.h"

namespace haarmony::video {
namespace {

constexpr int kRolls = 6;
constexpr int kSteps = 12;  // of a path that is traced back
// What is coarse in time changes every so many frames.
constexpr std::int64_t kSlowFrames = 8;
// And what is coarse in space is so many squares across and down.
constexpr int kShades = 16;

struct Point {
    double x = 0;
    double y = 0;
};

// Rolls in the unit square, none of which crosses its walls: the stream function is the
// sum of strength sin(across pi x) sin(down pi y). Velocities are kept on a grid, and
// between its points they are what lies between: a path needs many of them.
class Flow {
  public:
    explicit Flow(std::uint32_t seed) {
        for (std::uint32_t i = 0; i < kRolls; ++i) {
            const std::uint32_t bits = scrambled(seed * kRolls + i);
            const auto across = static_cast<int>(1 + bits % 5);
            const auto down = static_cast<int>(1 + (bits >> 8 & 1));
            const double size = (0.3 + 0.7 * (bits >> 16 & 255) / 255.0) / (across + 1);
            add_roll(across, down, (bits >> 24 & 1) != 0 ? size : -size);
        }
    }

    // Where what is at a point now was, `time` ago.
    [[nodiscard]] Point traced_back(Point at, double time) const {
        const double step = time / kSteps;
        for (int i = 0; i < kSteps; ++i) {
            const Point first = velocity(at);
            const Point middle =
                velocity({at.x - 0.5 * step * first.x, at.y - 0.5 * step * first.y});
            at = {at.x - step * middle.x, at.y - step * middle.y};
        }
        return at;
    }

  private:
    static constexpr int kGrid = 128;  // its squares across and down

    void add_roll(int across, int down, double strength) {
        for (int i = 0; i < (kGrid + 1) * (kGrid + 1); ++i) {
            const double u = std::numbers::pi * across * (i % (kGrid + 1)) / kGrid;
            const double v = std::numbers::pi * down * (i / (kGrid + 1)) / kGrid;
            Point& sum = grid_[static_cast<std::size_t>(i)];
            sum.x += strength * down * std::sin(u) * std::cos(v);
            sum.y -= strength * across * std::cos(u) * std::sin(v);
        }
    }

    [[nodiscard]] Point velocity(const Point& at) const {
        const double x = kGrid * std::clamp(at.x, 0.0, 1.0);
        const double y = kGrid * std::clamp(at.y, 0.0, 1.0);
        const int column = std::min(static_cast<int>(x), kGrid - 1);
        const int row = std::min(static_cast<int>(y), kGrid - 1);
        const double right = x - column, down = y - row;
        const Point* const upper =
            grid_.data() + static_cast<std::size_t>(row * (kGrid + 1) + column);
        const Point* const lower = upper + kGrid + 1;
        const auto between = [=](double a, double b, double c, double d) {
            return (a * (1 - right) + b * right) * (1 - down) +
                   (c * (1 - right) + d * right) * down;
        };
        return {between(upper[0].x, upper[1].x, lower[0].x, lower[1].x),
                between(upper[0].y, upper[1].y, lower[0].y, lower[1].y)};
    }

    std::array<Point, (kGrid + 1) * (kGrid + 1)> grid_{};
};

class FluidField final : public Field {
  public:
    // The flow must outlive it.
    FluidField(const Recipe& recipe, const Flow& flow, std::int64_t frame)
        : flow_(flow),
          width_(recipe.format.width),
          height_(recipe.format.height),
          now_(time_at(recipe, frame)),
          // The fluids start from rest: at first every fourth frame tells all.
          stays_(4 * frame < recipe.frames
                     ? 4 - frame % 4
                     : (2 * frame < recipe.frames ? 2 - frame % 2 : 1)) {
        const double lately = time_at(recipe, frame - frame % kSlowFrames);
        for (std::size_t i = 0; i < depth_.size(); ++i) {
            const Point middle{(static_cast<double>(i % kShades) + 0.5) / kShades,
                               (static_cast<double>(i / kShades) + 0.5) / kShades};
            depth_[i] = std::clamp(flow_.traced_back(middle, lately).y, 0.0, 1.0);
        }
    }

    bool sample(const FieldSquare& square, Brick& brick) const override {
        std::array<double, kBrickPixels> above{};
        bool heavy = false, light = false;
        for (int i = 0; i < kBrickPixels; ++i) {
            const Point at{square.x(i) / width_, square.y(i) / height_};
            const Point origin = flow_.traced_back(at, now_);
            const double surface = 0.5 + 0.03 * std::cos(7 * std::numbers::pi * origin.x);
            const double height = surface - origin.y;
            above[static_cast<std::size_t>(i)] = height;
            (height > 0 ? heavy : light) = true;
            brick[static_cast<std::size_t>(i)] = color_of(at, height > 0);
        }
        return (heavy && light) || nearly_crossed(above);
    }
    std::int64_t stays() const override { return stays_; }

  private:
    static double time_at(const Recipe& recipe, std::int64_t frame) {
        const double part =
            static_cast<double>(frame) / static_cast<double>(recipe.frames);
        return 1.4 * part * part;
    }

    // Whether the surface may run between samples: some are less from it than neighbours
    // differ.
    static bool nearly_crossed(const std::array<double, kBrickPixels>& above) {
        double nearest = std::abs(above[0]), steepest = 0;
        for (std::size_t i = 0; i < kBrickPixels; ++i) {
            nearest = std::min(nearest, std::abs(above[i]));
            if (i % kBrickSide != 0) {
                steepest = std::max(steepest, std::abs(above[i] - above[i - 1]));
            }
            if (i >= kBrickSide) {
                steepest = std::max(steepest, std::abs(above[i] - above[i - kBrickSide]));
            }
        }
        return nearest < steepest;
    }

    // Darker the deeper it came from, in large squares and seen a little late.
    [[nodiscard]] Rgba color_of(const Point& at, bool heavy) const {
        const auto part = [](double along) {
            return std::clamp(static_cast<int>(kShades * along), 0, kShades - 1);
        };
        const double depth =
            depth_[static_cast<std::size_t>(part(at.y) * kShades + part(at.x))];
        const auto shade = [depth](int from, int to) {
            return static_cast<std::uint8_t>(from + (to - from) * depth);
        };
        return heavy ? Rgba{shade(44, 24), shade(74, 46), shade(160, 120), 255}
                     : Rgba{shade(248, 232), shade(200, 162), shade(110, 60), 255};
    }

    const Flow& flow_;
    double width_;
    double height_;
    double now_;
    std::int64_t stays_;
    std::array<double, kShades * kShades>
        depth_{};  // from which height what is here came
};

}  // namespace

Result<std::unique_ptr<FrameSource>> fluid_frames(const Recipe& recipe) {
    const auto flow = std::make_shared<const Flow>(recipe.seed);
    return refined_frames(
        recipe.format, recipe.frames, recipe.depth, [recipe, flow](std::int64_t frame) {
            return std::make_unique<FluidField>(recipe, *flow, frame);
        });
}

}  // namespace haarmony::video
