#include "engine/curve/parametric_error.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {
namespace {

using Sextic = std::array<double, 7>;  // in Bernstein form

Sextic squared_length(const PlaneCubic& d) {
    return {dot(d[0], d[0]),
            dot(d[0], d[1]),
            (3 * dot(d[1], d[1]) + 2 * dot(d[0], d[2])) / 5,
            (9 * dot(d[1], d[2]) + dot(d[0], d[3])) / 10,
            (3 * dot(d[2], d[2]) + 2 * dot(d[1], d[3])) / 5,
            dot(d[2], d[3]),
            dot(d[3], d[3])};
}

constexpr double kPrecision = 1e-12;
// Halving as often leaves intervals of 2^-40: what the coefficients then have above the
// values is beyond the precision of a double.
constexpr int kMostHalvings = 40;

void raise(const Sextic& p, int halvings, double& largest) {
    largest = std::max({largest, p.front(), p.back()});
    if (*std::ranges::max_element(p) <= largest * (1 + kPrecision)) return;
    if (halvings == kMostHalvings) return;
    Sextic left{};
    Sextic right = p;
    for (std::size_t i = 0; i < p.size(); ++i) {
        left[i] = right[0];
        for (std::size_t k = 0; k + 1 < p.size() - i; ++k) {
            right[k] = (right[k] + right[k + 1]) / 2;
        }
    }
    raise(left, halvings + 1, largest);
    raise(right, halvings + 1, largest);
}

// Compares `segment` with `count` pieces from the row `first` on.
void compare(const PlaneCubic& segment,
             const Points& curve,
             std::size_t first,
             std::size_t count,
             double& largest) {
    if (count > 1) {
        const auto [left, right] = split(segment, 0.5);
        compare(left, curve, first, count / 2, largest);
        compare(right, curve, first + 3 * (count / 2), count / 2, largest);
        return;
    }
    PlaneCubic difference = cubic_at(curve, first);
    for (std::size_t i = 0; i < 4; ++i) difference[i] = difference[i] - segment[i];
    raise(squared_length(difference), 0, largest);
}

}  // namespace

double parametric_error(const Points& curve, int level, const DrawnSegments& segments) {
    double largest = 0;
    for (std::size_t i = 0; i < segments.names.size(); ++i) {
        const SegmentName s = segments.names[i];
        assert(s.level <= level);
        const std::size_t count = std::size_t{1} << (level - s.level);
        assert(3 * (s.index + 1) * count < curve.size());
        compare(
            cubic_at(segments.bezier, 4 * i), curve, 3 * s.index * count, count, largest);
    }
    return std::sqrt(largest);
}

}  // namespace haarmony::curve
