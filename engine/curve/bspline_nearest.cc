// nearest() of bspline.h.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "engine/curve/bspline.h"

namespace haarmony::curve {
namespace {

// A segment's Bezier points as seen from the point that is asked for.
struct Segment {
    std::array<double, 4> x{};
    std::array<double, 4> y{};
};

Segment segment_of(const Points& bezier, std::size_t segment, double x, double y) {
    Segment seen;
    for (std::size_t i = 0; i < 4; ++i) {
        const auto point = bezier[3 * segment + i];
        seen.x[i] = point[0] - x;
        seen.y[i] = (point.size() > 1 ? point[1] : 0) - y;
    }
    return seen;
}

// No point of the segment is nearer: it lies within the box of its Bezier points.
double least_distance(const Segment& segment) {
    const auto outside = [](const std::array<double, 4>& at) {
        const auto [low, high] = std::minmax_element(at.begin(), at.end());
        return std::max({*low, -*high, 0.0});
    };
    return std::hypot(outside(segment.x), outside(segment.y));
}

double distance_at(const Segment& segment, double t) {
    const double s = 1 - t;
    const std::array<double, 4> basis = {
        s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    double x = 0;
    double y = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        x += basis[i] * segment.x[i];
        y += basis[i] * segment.y[i];
    }
    return std::hypot(x, y);
}

double size2(const Segment& segment) {
    double size = 0;
    for (std::size_t i = 0; i < 4; ++i)
        size = std::max({size, std::abs(segment.x[i]), std::abs(segment.y[i])});
    return size * size;
}

// f(t) . f'(t), whose zeros are where the distance is least, or greatest: degree 5, by its
// Bernstein coefficients.
using Quintic = std::array<double, 6>;

Quintic fall_of_distance(const Segment& segment) {
    constexpr std::array<double, 4> kCubic = {1, 3, 3, 1};
    constexpr std::array<double, 3> kQuadratic = {1, 2, 1};
    constexpr std::array<double, 6> kQuintic = {1, 5, 10, 10, 5, 1};
    Quintic product{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            product[i + k] += kCubic[i] * kQuadratic[k] / kQuintic[i + k] *
                              (segment.x[i] * (segment.x[k + 1] - segment.x[k]) +
                               segment.y[i] * (segment.y[k + 1] - segment.y[k]));
    return product;
}

// Appends the zeros in [low, high], in ascending order. By Descartes' rule there is none
// where the coefficients do not change their sign, so that halving finds all. Where they are
// all within `noise` they are as good as 0: of a zero of the fifth order that is a thousandth
// of the segment, which would be halved for ever.
void append_zeros(const Quintic& quintic,
                  double low,
                  double high,
                  double noise,
                  std::vector<double>& zeros) {
    const auto [least, most] = std::minmax_element(quintic.begin(), quintic.end());
    if (*least > 0 || *most < 0) return;
    const double middle = (low + high) / 2;
    if ((*least >= -noise && *most <= noise) || middle <= low || middle >= high) {
        zeros.push_back(middle);
        return;
    }
    Quintic left{};
    Quintic right = quintic;
    for (std::size_t i = 0; i < 6; ++i) {
        left[i] = right[0];
        for (std::size_t k = 0; k + i + 1 < 6; ++k)
            right[k] = (right[k] + right[k + 1]) / 2;
    }
    append_zeros(left, low, middle, noise, zeros);
    append_zeros(right, middle, high, noise, zeros);
}

// What rounding leaves of the coefficients, of the largest products that they are made of.
constexpr double kNoise = 1e-15;
// What is nearer by less than this part of the distance, or of the coordinates, is equal:
// so much may be rounding.
constexpr double kEqual = 1e-12;
constexpr double kRounding = 1e-14;

struct Candidate {
    double u = 0;
    double distance = 0;
};

}  // namespace

double nearest(const Points& control, Ends ends, double x, double y) {
    const Points bezier = bezier_points(control, ends);
    const std::size_t segments = (bezier.size() - 1) / 3;
    double best = std::numeric_limits<double>::infinity();
    double largest = std::max(std::abs(x), std::abs(y));
    for (std::size_t s = 0; s < segments; ++s) {
        const Segment segment = segment_of(bezier, s, x, y);
        best = std::min({best, distance_at(segment, 0), distance_at(segment, 1)});
        largest = std::max(largest, std::sqrt(size2(segment)));
    }
    const auto equal_to_best = [&](double distance) {
        return distance <= best * (1 + kEqual) + largest * kRounding;
    };
    std::vector<Candidate> candidates;
    std::vector<double> zeros;
    for (std::size_t s = 0; s < segments; ++s) {
        const Segment segment = segment_of(bezier, s, x, y);
        if (!equal_to_best(least_distance(segment))) continue;
        zeros.clear();
        if (s == 0) zeros.push_back(0);
        append_zeros(fall_of_distance(segment), 0, 1, kNoise * size2(segment), zeros);
        if (s + 1 == segments) zeros.push_back(1);
        for (const double t : zeros) {
            const double distance = distance_at(segment, t);
            candidates.push_back({(double(s) + t) / double(segments), distance});
            best = std::min(best, distance);
        }
    }
    const auto first = std::ranges::find_if(candidates, [&](const Candidate& candidate) {
        return equal_to_best(candidate.distance);
    });
    assert(first != candidates.end());
    return first->u;
}

}  // namespace haarmony::curve
