#include "engine/curve/bspline.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace haarmony::curve {
namespace {

// Knot `index` of an open curve in segments: 0, 0, 0, 0, 1, 2, ..., n, n, n, n; of a closed
// one, whose basis function 0 is largest at 0: -2, -1, 0, ...
double knot(std::size_t index, std::size_t segments, Ends ends) {
    if (ends == Ends::kClosed) return double(index) - 3;
    return std::clamp(double(index) - 3, 0.0, double(segments));
}

struct Place {
    std::size_t segment = 0;
    double t = 0;  // u in segments
};
Place place_of(double u, std::size_t segments) {
    assert(0 <= u && u <= 1);
    const double t = u * double(segments);
    return {std::min(std::size_t(t), segments - 1), t};
}

// The sum of factors times control points.
std::vector<double> combine(const Points& control,
                            std::size_t first,
                            const std::array<double, 4>& factors) {
    std::vector<double> sum(std::size_t(control.dimension()));
    for (std::size_t i = 0; i < 4; ++i) {
        const auto row = control[(first + i) % control.size()];
        for (std::size_t d = 0; d < sum.size(); ++d) sum[d] += factors[i] * row[d];
    }
    return sum;
}

int known_level(const Points& control, Ends ends) {
    const std::optional<int> level = level_of(control.size(), ends);
    assert(level);
    return *level;
}

// Where a falling continuous function crosses 0 between `low` and `high`.
template <typename Function>
double zero_of_falling(Function function, double low, double high) {
    for (int i = 0; i < 64; ++i) {
        const double middle = (low + high) / 2;
        (function(middle) > 0 ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace

BasisAt basis_at(int level, Ends ends, double u) {
    const std::size_t segments = segment_count(level);
    const auto [segment, t] = place_of(u, segments);
    // The functions of degree 1, 2, 3 that are not 0 here, by de Boor's recursion; those of
    // degree g begin with index segment + 3 - g.
    const auto at = [&, s = segment](std::size_t index) {
        return knot(s + index, segments, ends);
    };
    std::array<std::array<double, 4>, 4> value{};
    value[0][0] = 1;
    // What the function at `i` of degree g - 1 passes on, by g and i, over its support.
    std::array<std::array<double, 4>, 4> share{};
    for (std::size_t g = 1; g <= 3; ++g) {
        for (std::size_t i = 0; i < g; ++i) {
            const double low = at(4 - g + i);
            const double high = at(4 + i);
            share[g][i] = 1 / (high - low);
            value[g][i + 1] += (t - low) * share[g][i] * value[g - 1][i];
            value[g][i] += (high - t) * share[g][i] * value[g - 1][i];
        }
    }
    BasisAt basis;
    basis.first = ends == Ends::kOpen ? segment : (segment + segments - 1) % segments;
    basis.value = value[3];
    // The derivative of degree g is g times the difference of the neighbours of degree g - 1.
    const double per_u = double(segments);
    std::array<double, 3> slope_of_squares{};
    for (std::size_t i = 0; i < 2; ++i) {
        const double change = 2 * share[2][i] * value[1][i];
        slope_of_squares[i + 1] += change;
        slope_of_squares[i] -= change;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double change = 3 * share[3][i] * value[2][i] * per_u;
        basis.slope[i + 1] += change;
        basis.slope[i] -= change;
        const double bend = 3 * share[3][i] * slope_of_squares[i] * per_u * per_u;
        basis.bend[i + 1] += bend;
        basis.bend[i] -= bend;
    }
    return basis;
}

std::vector<double> point_at(const Points& control, Ends ends, double u) {
    const BasisAt basis = basis_at(known_level(control, ends), ends, u);
    return combine(control, basis.first, basis.value);
}

std::vector<double> slope_at(const Points& control, Ends ends, double u) {
    const BasisAt basis = basis_at(known_level(control, ends), ends, u);
    return combine(control, basis.first, basis.slope);
}

std::vector<double> bend_at(const Points& control, Ends ends, double u) {
    const BasisAt basis = basis_at(known_level(control, ends), ends, u);
    return combine(control, basis.first, basis.bend);
}

double peak_of_basis(int level, Ends ends, std::size_t index) {
    const std::size_t segments = segment_count(level);
    assert(index < control_count(level, ends));
    if (ends == Ends::kClosed) return double(index) / double(segments);
    const std::size_t last = segments + 2;
    if (index > last - index) return 1 - peak_of_basis(level, ends, last - index);
    if (2 * index == last) return 0.5;
    if (index == 0) return 0;
    if (index >= 3) return double(index - 1) / double(segments);
    // The second and the third function lean towards the end; their slope changes sign once
    // within their first `index` segments.
    const auto slope = [&](double u) {
        const BasisAt basis = basis_at(level, ends, u);
        return basis.slope[index - basis.first];
    };
    const double high = std::min(double(index) / double(segments), 1.0);
    return zero_of_falling(slope, 0, high);
}

Points bezier_points(const Points& control, Ends ends) {
    const std::size_t segments = segment_count(known_level(control, ends));
    const int dimension = control.dimension();
    Points bezier(3 * segments + 1, dimension);
    for (std::size_t s = 0; s < segments; ++s) {
        // The two inner points divide the leg of control points s + 1 and s + 2 (closed: s
        // and s + 1) as the segment divides the knots that the leg stands for.
        const double low = knot(s + 2, segments, ends);
        const double high = knot(s + 5, segments, ends);
        const double t = double(s);
        const std::size_t leg = ends == Ends::kOpen ? s + 1 : s;
        const auto from = control[leg];
        const auto to = control[(leg + 1) % control.size()];
        for (std::size_t d = 0; d < std::size_t(dimension); ++d) {
            const auto divide = [&](double at) {
                const double part = (at - low) / (high - low);
                return (1 - part) * from[d] + part * to[d];
            };
            bezier[3 * s + 1][d] = divide(t);
            bezier[3 * s + 2][d] = divide(t + 1);
        }
    }
    // A joint is the middle of its neighbours; the ends of an open curve are control points.
    const std::size_t last = 3 * segments;
    for (std::size_t s = 1; s < segments; ++s)
        for (std::size_t d = 0; d < std::size_t(dimension); ++d)
            bezier[3 * s][d] = (bezier[3 * s - 1][d] + bezier[3 * s + 1][d]) / 2;
    for (std::size_t d = 0; d < std::size_t(dimension); ++d) {
        const double seam = (bezier[last - 1][d] + bezier[1][d]) / 2;
        bezier[0][d] = ends == Ends::kOpen ? control[0][d] : seam;
        bezier[last][d] = ends == Ends::kOpen ? control[control.size() - 1][d] : seam;
    }
    return bezier;
}

}  // namespace haarmony::curve
