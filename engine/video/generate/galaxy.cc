#include "engine/video/generate/galaxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/video/create_frame.h"
#include "engine/video/generate/lattice_noise.h"
#include "engine/video/ops/composite.h"
#include "engine/video/tree_writer.h"

namespace haarmony::video {
namespace {

constexpr int kStars = 2400;
constexpr int kStepsPerFrame = 4;
constexpr double kStep =
    0.004;  // of time, in which a star at radius 1 turns 1 radian in 1
constexpr double kSoftening = 2e-3;  // squared; keeps close encounters finite

struct Point {
    double x = 0;
    double y = 0;
};

// The first body is the galaxy's own; the others are those that it meets.
struct Body {
    double mass = 0;
    Point at;
    Point velocity;
};

struct Star {
    Point at;
    Point velocity;
    Rgba color;
};

// Few colours, most of them of old, reddish stars.
constexpr std::array<Rgba, 6> kPalette = {{{255, 214, 170, 255},
                                           {255, 189, 111, 255},
                                           {248, 247, 255, 255},
                                           {202, 215, 255, 255},
                                           {155, 176, 255, 255},
                                           {255, 120, 80, 255}}};

class GalaxyFrames final : public FrameSource {
  public:
    explicit GalaxyFrames(const Recipe& recipe)
        : recipe_(recipe),
          scale_(0.5 * std::min(recipe.format.width, recipe.format.height)),
          levels_(ClipShape::make(recipe.format, 1).value().space_levels()) {
        bodies_ = {{1.0, {-0.55, 0.35}, {1.1, -0.75}},
                   {0.7, {0.35, 0.1}, {0, 0}},
                   {0.5, {0.1, -0.45}, {0, 0}},
                   {0.3, {0.6, -0.3}, {0, 0}}};
        for (std::uint32_t i = 0; i < kStars; ++i) stars_.push_back(star(i));
        TreePart night;
        night.pixels.fill({0, 0, 0, 255});
        TreeWriter(night_).finish(night);
    }

    const FrameFormat& format() const override { return recipe_.format; }

    Result<bool> next(SourceFrame& frame) override {
        if (next_ == recipe_.frames) return false;
        if (next_ > 0) {
            for (int i = 0; i < kStepsPerFrame; ++i) step();
        }
        if (Result<void> painted = create_frame(lights(), recipe_.format, lights_);
            !painted) {
            return painted.error();
        }
        composite(lights_, night_, Operator::kAOverB, frame.tree);
        frame.repeats = 1;
        ++next_;
        return true;
    }

  private:
    // On a circle around the galaxy's body, more of them further in.
    Star star(std::uint32_t number) const {
        const auto random = [&](std::uint32_t what) {
            return scrambled(scrambled(recipe_.seed + 977 * what) + number) /
                   4294967296.0;
        };
        const double radius = 0.03 + 0.27 * random(0) * random(1);
        const double angle = 2 * std::numbers::pi * random(2);
        const double speed = std::sqrt(bodies_[0].mass / radius);
        const Body& center = bodies_[0];
        const auto kind = static_cast<std::size_t>(random(3) * random(3) * 6);
        return {{center.at.x + radius * std::cos(angle),
                 center.at.y + radius * std::sin(angle)},
                {center.velocity.x - speed * std::sin(angle),
                 center.velocity.y + speed * std::cos(angle)},
                kPalette[std::min(kind, kPalette.size() - 1)]};
    }

    [[nodiscard]] Point pull(const Point& at, std::size_t without) const {
        Point sum;
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            if (i == without) continue;
            const double dx = bodies_[i].at.x - at.x, dy = bodies_[i].at.y - at.y;
            const double squared = dx * dx + dy * dy + kSoftening;
            const double strength = bodies_[i].mass / (squared * std::sqrt(squared));
            sum.x += strength * dx;
            sum.y += strength * dy;
        }
        return sum;
    }

    // Kick, drift: positions and velocities are half a step apart.
    void step() {
        const auto kick = [](Point& velocity, const Point& force) {
            velocity.x += kStep * force.x;
            velocity.y += kStep * force.y;
        };
        const auto drift = [](Point& at, const Point& velocity) {
            at.x += kStep * velocity.x;
            at.y += kStep * velocity.y;
        };
        for (Star& star : stars_) kick(star.velocity, pull(star.at, bodies_.size()));
        // The cluster is heavy and stays where it is; only the galaxy is swept about.
        kick(bodies_[0].velocity, pull(bodies_[0].at, 0));
        for (Star& star : stars_) drift(star.at, star.velocity);
        drift(bodies_[0].at, bodies_[0].velocity);
    }

    // What shines, as squares that do not overlap: bodies larger than stars.
    [[nodiscard]] std::vector<LeafSquare> lights() const {
        std::vector<LeafSquare> squares;
        std::set<std::tuple<int, std::int32_t, std::int32_t>> lit;
        const int body_level = std::max(kBrickLevel, recipe_.depth - 3);
        const auto add = [&](const Point& at, int level, Rgba color) {
            const double x = 0.5 * recipe_.format.width + scale_ * at.x;
            const double y = 0.5 * recipe_.format.height + scale_ * at.y;
            if (!(x >= 0 && x < recipe_.format.width && y >= 0 &&
                  y < recipe_.format.height)) {
                return;
            }
            const int above = levels_ - level;
            const auto column = static_cast<std::int32_t>(x) >> above;
            const auto row = static_cast<std::int32_t>(y) >> above;
            const int up = level - body_level;
            if (lit.contains({body_level, column >> up, row >> up})) return;
            if (!lit.insert({level, column, row}).second) return;
            squares.push_back({level, column, row, color});
        };
        for (const Body& body : bodies_) add(body.at, body_level, {255, 255, 230, 255});
        for (const Star& star : stars_) add(star.at, recipe_.depth, star.color);
        return squares;
    }

    Recipe recipe_;
    double scale_;
    int levels_;
    std::vector<Body> bodies_;
    std::vector<Star> stars_;
    ImageTree night_;
    ImageTree lights_;
    std::int64_t next_ = 0;
};

}  // namespace

Result<std::unique_ptr<FrameSource>> galaxy_frames(const Recipe& recipe) {
    return std::unique_ptr<FrameSource>(std::make_unique<GalaxyFrames>(recipe));
}

}  // namespace haarmony::video
