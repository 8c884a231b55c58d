#include "engine/curve/smooth.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "engine/curve/bspline_filters.h"

namespace haarmony::curve {
namespace {

// Only the outermost wavelet of each level is not 0 at an end.
std::vector<double> end_point(const MultiresCurve& curve, bool last) {
    assert(curve.ends == Ends::kOpen);
    const auto outermost = [&](const Points& points) {
        return points[last ? points.size() - 1 : 0];
    };
    const auto start = outermost(curve.coarse);
    std::vector<double> point(start.begin(), start.end());
    for (int level = 1; level <= curve.level(); ++level) {
        const Taps taps =
            wavelet_row(level, Ends::kOpen, 0);  // the last row is its mirror
        assert(taps.count == 1);
        const auto detail = outermost(curve.details[std::size_t(level - 1)]);
        for (std::size_t d = 0; d < point.size(); ++d)
            point[d] += taps.value[0] * detail[d];
    }
    return point;
}

}  // namespace

std::vector<double> first_point(const MultiresCurve& curve) {
    return end_point(curve, false);
}
std::vector<double> last_point(const MultiresCurve& curve) {
    return end_point(curve, true);
}

Points smooth(const MultiresCurve& curve, double level, SmoothedEnds ends) {
    assert(0 <= level && level <= curve.level());
    const int below = int(std::floor(level));
    const double t = level - below;
    Points control = reconstruct(curve, below);
    if (t > 0) {
        Points detail = curve.details[std::size_t(below)];
        for (double& number : detail.numbers()) number *= t;
        control = synthesize(control, detail, curve.ends);
    }
    if (ends == SmoothedEnds::kPinned && curve.ends == Ends::kOpen) {
        std::ranges::copy(first_point(curve), control[0].begin());
        std::ranges::copy(last_point(curve), control[control.size() - 1].begin());
    }
    return control;
}

}  // namespace haarmony::curve
