#include "tests/eval/curve_strokes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include "engine/curve/fit.h"
#include "engine/curve/level.h"

namespace haarmony::eval {
namespace {

using curve::Points;

struct Place {
    double x = 0;
    double y = 0;
};

// Seeded numbers in [-1, 1) that are the same with every standard library.
class Tremor {
  public:
    explicit Tremor(std::uint32_t seed) : engine_(seed) {}
    double operator()() { return 2 * double(engine_()) / 4294967296.0 - 1; }

  private:
    std::mt19937 engine_;
};

// One number of the Catmull-Rom segment from b to c.
double between(double a, double b, double c, double d, double t) {
    return b + t * ((c - a) / 2 + t * (a - 2.5 * b + 2 * c - d / 2 +
                                       t * (1.5 * (b - c) + (d - a) / 2)));
}

// A curve through the places in order, fitted to samples of a Catmull-Rom spline.
Points through(const std::vector<Place>& places) {
    constexpr std::size_t kEach = 96;
    const std::size_t pieces = places.size() - 1;
    Points samples(pieces * kEach + 1, 2);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t piece = std::min(i / kEach, pieces - 1);
        const double t = double(i - piece * kEach) / kEach;
        const Place a = places[piece == 0 ? 0 : piece - 1];
        const Place b = places[piece];
        const Place c = places[piece + 1];
        const Place d = places[std::min(piece + 2, pieces)];
        samples[i][0] = between(a.x, b.x, c.x, d.x, t);
        samples[i][1] = between(a.y, b.y, c.y, d.y, t);
    }
    curve::FitOptions options;
    options.pin_ends = true;
    options.rounds = 0;
    return curve::fit(samples, kStrokeLevel, options).control;
}

void tremble(Points& control, double size, std::uint32_t seed) {
    Tremor tremor(seed);
    for (std::size_t i = 0; i < control.size(); ++i) {
        control[i][0] += size * tremor();
        control[i][1] += size * tremor();
    }
}

// Once round, from the bottom and back to it.
std::vector<Place> around(Place middle, double width, double height) {
    std::vector<Place> places;
    for (int i = 0; i <= 16; ++i) {
        const double angle = std::numbers::pi * (0.5 + double(i) / 8);
        places.push_back({middle.x + width / 2 * std::cos(angle),
                          middle.y + height / 2 * std::sin(angle)});
    }
    return places;
}

}  // namespace

Points profile_stroke() {
    Points control =
        through({{575, 420}, {622, 372}, {590, 320}, {640, 268}, {596, 212}, {610, 150},
                 {540, 120}, {498, 62},  {432, 70},  {372, 34},  {320, 78},  {270, 122},
                 {246, 190}, {243, 248}, {230, 272}, {246, 300}, {224, 352}, {180, 408},
                 {192, 428}, {236, 436}, {230, 456}, {206, 474}, {232, 490}, {210, 508},
                 {236, 532}, {222, 556}, {218, 588}, {250, 622}, {330, 612}, {410, 572},
                 {428, 640}, {446, 728}});
    tremble(control, 3, 31);
    return control;
}

Points arch_stroke() {
    return through(
        {{60, 420}, {180, 300}, {340, 200}, {520, 180}, {700, 260}, {940, 430}});
}

Points trembling_line() {
    Points control = through({{40, 300},
                              {190, 292},
                              {345, 306},
                              {500, 300},
                              {655, 294},
                              {810, 308},
                              {960, 300}});
    tremble(control, 5, 33);
    return control;
}

Points uneven_stroke() {
    Points control(curve::control_count(kStrokeLevel, curve::Ends::kOpen), 2);
    for (std::size_t i = 0; i < control.size(); ++i) {
        const double part = double(i) / double(control.size() - 1);
        const double along = 0.25 * part + 0.75 * std::pow(part, 4);
        control[i][0] = 40 + 920 * along;
        control[i][1] = 300 + 130 * std::sin(3.5 * 2 * std::numbers::pi * along);
    }
    tremble(control, 1, 34);
    return control;
}

Points pen_stroke() {
    const Points path = through({{60, 330},
                                 {180, 180},
                                 {300, 250},
                                 {280, 400},
                                 {200, 340},
                                 {380, 160},
                                 {560, 300},
                                 {700, 360},
                                 {820, 220},
                                 {940, 270}});
    Points control(path.size(), 3);
    for (std::size_t i = 0; i < control.size(); ++i) {
        const double part = double(i) / double(control.size() - 1);
        control[i][0] = path[i][0];
        control[i][1] = path[i][1];
        control[i][2] = 5 + 22 * std::pow(std::sin(std::numbers::pi * part), 2) +
                        3 * std::sin(9 * 2 * std::numbers::pi * part);
    }
    return control;
}

std::vector<DrawingPart> landscape() {
    return {
        {"sun", "spiky", 4, through(around({150, 150}, 150, 150))},
        {"cloud", "scalloped", 4, through(around({500, 120}, 330, 110))},
        {"mountains",
         "rough",
         4,
         through({{20, 420},
                  {150, 330},
                  {260, 390},
                  {400, 270},
                  {520, 360},
                  {640, 320},
                  {980, 400}})},
        {"crown", "loose", 4, through(around({780, 310}, 250, 220))},
        {"left of trunk", "rough", 4, through({{752, 418}, {758, 490}, {728, 572}})},
        {"right of trunk", "rough", 4, through({{806, 418}, {800, 490}, {832, 572}})},
        {"ground",
         "hatched",
         3,
         through({{20, 570}, {260, 545}, {520, 566}, {980, 572}})},
        {"far water", "wiggly", 4, through({{60, 640}, {250, 632}, {480, 640}})},
        {"near water", "wiggly", 4, through({{380, 690}, {640, 680}, {940, 690}})},
    };
}

}  // namespace haarmony::eval
