#include "tests/eval/curve_distance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "engine/curve/bspline.h"
#include "engine/curve/level.h"
#include "engine/curve/multires_curve.h"

namespace haarmony::eval {
namespace {

using curve::Ends;
using curve::Points;

int level_of_open(const Points& control) {
    const std::optional<int> level = curve::level_of(control.size(), Ends::kOpen);
    assert(level);
    return *level;
}

}  // namespace

Points refined_to(const Points& control, int level) {
    Points fine = control;
    for (int at = level_of_open(control); at < level; ++at)
        fine = curve::synthesize(fine, Points(), Ends::kOpen);
    return fine;
}

std::vector<double> distances(const Points& a, const Points& b) {
    const int level = std::max(level_of_open(a), level_of_open(b));
    const std::size_t samples = kSamplesEach * curve::segment_count(level);
    std::vector<double> result;
    result.reserve(samples + 1);
    for (std::size_t i = 0; i <= samples; ++i) {
        const double u = double(i) / double(samples);
        const std::vector<double> p = curve::point_at(a, Ends::kOpen, u);
        const std::vector<double> q = curve::point_at(b, Ends::kOpen, u);
        result.push_back(std::hypot(p[0] - q[0], p[1] - q[1]));
    }
    return result;
}

CurveDistance distance_between(const Points& a, const Points& b) {
    const std::vector<double> all = distances(a, b);
    double squares = 0;
    for (const double distance : all) squares += distance * distance;
    return {std::ranges::max(all), std::sqrt(squares / double(all.size()))};
}

double largest_difference(const Points& a, const Points& b) {
    assert(a.size() == b.size() && a.dimension() == b.dimension());
    double largest = 0;
    for (std::size_t i = 0; i < a.numbers().size(); ++i)
        largest = std::max(largest, std::abs(a.numbers()[i] - b.numbers()[i]));
    return largest;
}

}  // namespace haarmony::eval
