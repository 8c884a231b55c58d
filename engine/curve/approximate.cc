#include "engine/curve/approximate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/curve/bspline.h"
#include "engine/curve/corner_joints.h"
#include "engine/curve/draw_segment.h"
#include "engine/curve/error_bounds.h"
#include "engine/curve/hausdorff.h"
#include "engine/curve/merge.h"
#include "engine/curve/multires_curve.h"
#include "engine/curve/number_text.h"
#include "engine/curve/parametric_error.h"
#include "engine/curve/plane_cubic.h"

namespace haarmony::curve {
namespace {

Error out_of_range(std::string message, std::string param) {
    return {ErrorCode::kInvalidArgument, std::move(message), std::move(param)};
}

// What is wrong with the request, if anything.
std::optional<Error> wrong(const Points& points,
                           double tolerance,
                           std::span<const double> corners) {
    if (!(tolerance > 0 && std::isfinite(tolerance))) {
        return out_of_range("tolerance " + number_text(tolerance) + " is not above 0",
                            "tolerance");
    }
    for (const double u : corners) {
        if (!(u >= 0 && u <= 1)) {
            return out_of_range("corner " + number_text(u) + " is not within 0 and 1",
                                "corners");
        }
    }
    for (const double value : points.numbers()) {
        if (!(std::abs(value) <= kLargestCoordinate)) {
            return out_of_range("number " + number_text(value) + " is beyond " +
                                    number_text(kLargestCoordinate),
                                "points");
        }
    }
    return std::nullopt;
}

Approximation drawn(const Points& control, Ends ends, double tolerance, Joining joining) {
    const MultiresCurve curve = decompose(control, ends);
    const std::vector<SegmentLevel> levels = error_bounds(curve);
    DrawnSegments segments = joining == Joining::kC0
                                 ? draw_joined_segments(levels, ends, tolerance)
                                 : draw_segments(levels, tolerance);
    const double error = parametric_error(levels.back().bezier, curve.level(), segments);
    return {std::move(segments.bezier),
            ends == Ends::kClosed,
            segment_count(curve.level()),
            tolerance,
            segments.bound,
            error};
}

Approximation merged(const Points& chain,
                     Ends ends,
                     double tolerance,
                     std::span<const double> corners) {
    const CorneredChain cornered = split_at_corners(chain, corners);
    MergedSegments segments = merge(cornered.chain, tolerance, cornered.joints);
    std::vector<PlaneCubic> original;
    for (std::size_t row = 0; row + 3 < chain.size(); row += 3) {
        original.push_back(cubic_at(chain, row));
    }
    // Where all pieces stay, the bound is 0 and rounding alone is above it.
    const double usual = std::max(segments.bound, 1e-6 * tolerance);
    const double error = hausdorff(original, cubics_of(segments.bezier), usual);
    return {std::move(segments.bezier),
            ends == Ends::kClosed,
            original.size(),
            tolerance,
            segments.bound,
            error};
}

}  // namespace

Result<Approximation> approximate(const Points& control,
                                  Ends ends,
                                  double tolerance,
                                  Joining joining,
                                  std::span<const double> corners) {
    assert(level_of(control.size(), ends));
    if (const auto error = wrong(control, tolerance, corners)) return *error;
    if (joining != Joining::kG1) return drawn(control, ends, tolerance, joining);
    return merged(bezier_points(control, ends), ends, tolerance, corners);
}

Result<Approximation> approximate_chain(const Points& chain,
                                        Ends ends,
                                        double tolerance,
                                        std::span<const double> corners) {
    assert(chain.size() >= 4 && chain.size() % 3 == 1);
    if (const auto error = wrong(chain, tolerance, corners)) return *error;
    return merged(chain, ends, tolerance, corners);
}

}  // namespace haarmony::curve
