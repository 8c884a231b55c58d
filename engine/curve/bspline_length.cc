// length() of bspline.h.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

// The derivative of a cubic Bezier segment in x and y, as a quadratic one.
struct Speed {
    std::array<double, 3> x;
    std::array<double, 3> y;

    [[nodiscard]] double at(double t) const {
        const std::array<double, 3> basis = {(1 - t) * (1 - t), 2 * t * (1 - t), t * t};
        double sum_x = 0;
        double sum_y = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            sum_x += basis[i] * x[i];
            sum_y += basis[i] * y[i];
        }
        return std::hypot(sum_x, sum_y);
    }
};

Speed speed_of(const Points& bezier, std::size_t segment) {
    Speed speed{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto from = bezier[3 * segment + i];
        const auto to = bezier[3 * segment + i + 1];
        speed.x[i] = 3 * (to[0] - from[0]);
        if (from.size() > 1) speed.y[i] = 3 * (to[1] - from[1]);
    }
    return speed;
}

// Gauss-Legendre quadrature, exact up to degree 15.
double gauss(const Speed& speed, double low, double high) {
    constexpr std::array<double, 4> kPlace = {
        0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr std::array<double, 4> kWeight = {
        0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const double middle = (low + high) / 2;
    const double half = (high - low) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < kPlace.size(); ++i)
        sum += kWeight[i] * (speed.at(middle - half * kPlace[i]) +
                             speed.at(middle + half * kPlace[i]));
    return sum * half;
}

// Halves what is not yet good enough: at a cusp the error of an interval falls with the
// square of its width, elsewhere with its 17th power.
double refined(const Speed& speed,
               double low,
               double high,
               double whole,
               double tolerance,
               int halvings) {
    const double middle = (low + high) / 2;
    const double left = gauss(speed, low, middle);
    const double right = gauss(speed, middle, high);
    if (halvings == 0 || std::abs(left + right - whole) <= tolerance) return left + right;
    return refined(speed, low, middle, left, tolerance, halvings - 1) +
           refined(speed, middle, high, right, tolerance, halvings - 1);
}

constexpr double kTolerance = 1e-8;  // of a segment; a cusp halves it a dozen times
constexpr int kMostHalvings = 30;

}  // namespace

double length(const Points& control, Ends ends, double from, double to) {
    assert(0 <= from && from <= to && to <= 1);
    const Points bezier = bezier_points(control, ends);
    const std::size_t segments = (bezier.size() - 1) / 3;
    const double start = from * double(segments);
    const double stop = to * double(segments);
    double sum = 0;
    for (auto s = std::size_t(start); s < segments && double(s) < stop; ++s) {
        const double low = std::max(start - double(s), 0.0);
        const double high = std::min(stop - double(s), 1.0);
        const Speed speed = speed_of(bezier, s);
        const double whole = gauss(speed, low, high);
        sum += refined(speed, low, high, whole, kTolerance * whole, kMostHalvings);
    }
    return sum;
}

}  // namespace haarmony::curve
