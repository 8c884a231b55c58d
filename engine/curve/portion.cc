#include "engine/curve/portion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

constexpr double kNotZero = 1e-12;       // a basis function that is smaller moves nothing
constexpr double kLeastFraction = 1e-9;  // tells a level from the one below
// Of h^0: what is that close to it is all of the portion that level 0 moves.
constexpr double kSameLength = 1e-12;

// Gauss-Legendre quadrature on [0, 1], exact up to degree 31.
struct Gauss {
    static constexpr int kPoints = 16;
    std::array<double, kPoints> place{};
    std::array<double, kPoints> weight{};

    Gauss() {
        for (int i = 0; i < kPoints; ++i) {
            // Newton's steps from a guess that is good to three digits.
            double x = std::cos(std::numbers::pi * (i + 0.75) / (kPoints + 0.5));
            double slope = 0;
            for (int step = 0; step < 8; ++step) {
                double before = 1;
                double legendre = x;
                for (int n = 2; n <= kPoints; ++n) {
                    const double next =
                        ((2 * n - 1) * x * legendre - (n - 1) * before) / n;
                    before = legendre;
                    legendre = next;
                }
                slope = kPoints * (x * legendre - before) / (x * x - 1);
                x -= legendre / slope;
            }
            place[i] = (1 + x) / 2;
            weight[i] = 1 / ((1 - x * x) * slope * slope);
        }
    }
};

// Of one Bezier segment, in x and y.
double segment_length(const Points& hull, std::size_t segment, const Gauss& gauss) {
    std::array<std::array<double, 3>, 2> leg{};  // of the derivative, in x and in y
    const int planar = std::min(hull.dimension(), 2);
    for (int d = 0; d < planar; ++d) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t row = 3 * segment + i;
            leg[d][i] = 3 * (hull[row + 1][d] - hull[row][d]);
        }
    }
    double sum = 0;
    for (int k = 0; k < Gauss::kPoints; ++k) {
        const double s = gauss.place[k];
        const double r = 1 - s;
        std::array<double, 2> speed{};
        for (std::size_t d = 0; d < 2; ++d) {
            speed[d] = r * r * leg[d][0] + 2 * r * s * leg[d][1] + s * s * leg[d][2];
        }
        sum += gauss.weight[k] * std::sqrt(speed[0] * speed[0] + speed[1] * speed[1]);
    }
    return sum;
}

}  // namespace

PortionLengths::PortionLengths(const Points& control, Ends ends) : ends_(ends) {
    const auto level = level_of(control.size(), ends);
    assert(level);
    level_ = *level;
    const std::size_t segments = segment_count(level_);
    until_.reserve(segments + 1);
    until_.push_back(0);
    const Points hull = bezier_points(control, ends);
    static const Gauss gauss;
    for (std::size_t segment = 0; segment < segments; ++segment) {
        until_.push_back(until_.back() + segment_length(hull, segment, gauss));
    }
}

double PortionLengths::affected(int level, double u) const {
    assert(level >= 0 && level <= level_);
    const BasisAt basis = basis_at(level, ends_, u);
    std::size_t first = 0;
    while (basis.value[first] <= kNotZero) ++first;
    std::size_t last = basis.value.size() - 1;
    while (basis.value[last] <= kNotZero) --last;

    // In segments of `level`. Basis function i of an open curve has [i - 3, i + 1], clipped;
    // of a closed one [i - 2, i + 2].
    const std::size_t segments = segment_count(level);
    const std::size_t each = segment_count(level_ - level);
    if (ends_ == Ends::kOpen) {
        const std::size_t from = basis.first + first > 3 ? basis.first + first - 3 : 0;
        const std::size_t to = std::min(basis.first + last + 1, segments);
        return until_[to * each] - until_[from * each];
    }
    const std::size_t wide = last - first + 4;
    if (wide >= segments) return total();
    const std::size_t from = (basis.first + first + 2 * segments - 2) % segments;
    const std::size_t to = from + wide;
    if (to <= segments) return until_[to * each] - until_[from * each];
    return total() - until_[from * each] + until_[(to - segments) * each];
}

double PortionLengths::level_for(double u, double length) const {
    assert(length > 0);
    // The lengths fall: `above` becomes that of the last level that is long enough.
    double above = affected(0, u);
    if (length >= above * (1 - kSameLength)) return 0;
    for (int level = 1; level <= level_; ++level) {
        const double below = affected(level, u);
        if (length > below) return level - 1 + (above - length) / (above - below);
        above = below;
    }
    return level_;
}

std::optional<double> PortionLengths::level_for_control(std::size_t index,
                                                        double length) const {
    std::optional<double> best;
    double least_miss = 0;
    for (int level = 0; level <= level_; ++level) {
        if (index >= control_count(level, ends_)) continue;
        const double found = level_for(peak_of_basis(level, ends_, index), length);
        const double miss = std::abs(std::ceil(found) - level);
        if (best && miss >= least_miss) continue;
        const double lowest = level == 0 ? 0 : level - 1 + kLeastFraction;
        best = std::clamp(found, lowest, double(level));
        least_miss = miss;
    }
    return best;
}

}  // namespace haarmony::curve
