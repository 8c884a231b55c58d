#include "engine/curve/error_bounds.h"

#include <algorithm>
#include <cstddef>

#include "engine/curve/bspline.h"
#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {
namespace {

// The longest row of E^j among those of each segment.
std::vector<double> longest_moves(const Points& moves, std::size_t segments) {
    std::vector<double> longest(segments);
    for (std::size_t i = 0; i < segments; ++i) {
        for (std::size_t k = 3 * i; k <= 3 * i + 3; ++k) {
            longest[i] = std::max(longest[i], squared(in_plane(moves[k])));
        }
        longest[i] = std::sqrt(longest[i]);
    }
    return longest;
}

}  // namespace

std::vector<SegmentLevel> error_bounds(const MultiresCurve& curve) {
    const auto levels = static_cast<std::size_t>(curve.level()) + 1;
    std::vector<SegmentLevel> result(levels);
    Points control = curve.coarse;
    result[0].bezier = bezier_points(control, curve.ends);
    result[0].delta.assign(1, 0);
    for (std::size_t j = 1; j < levels; ++j) {
        const Points& detail = curve.details[j - 1];
        // Q^j D^(j-1): the detail added to a coarse curve of zeros.
        const Points moves =
            synthesize(Points(control.size(), control.dimension()), detail, curve.ends);
        control = synthesize(control, detail, curve.ends);
        result[j].bezier = bezier_points(control, curve.ends);
        result[j].delta = longest_moves(bezier_points(moves, curve.ends),
                                        segment_count(static_cast<int>(j)));
    }
    result.back().bound.assign(segment_count(curve.level()), 0);
    for (std::size_t j = levels - 1; j-- > 0;) {
        const SegmentLevel& finer = result[j + 1];
        result[j].bound.resize(segment_count(static_cast<int>(j)));
        for (std::size_t i = 0; i < result[j].bound.size(); ++i) {
            result[j].bound[i] =
                std::max(finer.bound[2 * i] + finer.delta[2 * i],
                         finer.bound[2 * i + 1] + finer.delta[2 * i + 1]);
        }
    }
    return result;
}

}  // namespace haarmony::curve
