#include "engine/curve/approximate.h"

#include <algorithm>
#include <array>
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

// Joints for corners: a segment that has a corner within stays as it is, between two.
std::vector<std::size_t> knots_at(std::span<const double> places) {
    std::vector<std::size_t> knots;
    for (const double place : places) {
        const auto knot = static_cast<std::size_t>(place);
        if (knots.empty() || knots.back() != knot) knots.push_back(knot);
        if (place > std::floor(place)) knots.push_back(knot + 1);
    }
    return knots;
}

// With the segments of the finest level cut at the corners within them.
Points cut_at_corners(const DrawnSegments& segments,
                      int finest,
                      std::span<const double> places) {
    std::vector<double> rows;
    for (std::size_t i = 0; i < segments.names.size(); ++i) {
        const SegmentName s = segments.names[i];
        Points segment(4, segments.bezier.dimension());
        for (std::size_t k = 0; k < 4; ++k)
            std::ranges::copy(segments.bezier[4 * i + k], segment[k].begin());
        std::vector<double> within;
        const auto start = static_cast<double>(s.index);
        auto place = std::ranges::upper_bound(places, start);
        if (s.level < finest) place = places.end();
        for (; place != places.end() && *place < start + 1; ++place)
            within.push_back(*place - start);
        const Points parts = split_at_corners(segment, within).chain;
        for (std::size_t first = 0; first + 3 < parts.size(); first += 3) {
            const auto numbers =
                parts.numbers().subspan(first * parts[0].size(), 4 * parts[0].size());
            rows.insert(rows.end(), numbers.begin(), numbers.end());
        }
    }
    Points bezier(rows.size() / segments.bezier[0].size(), segments.bezier.dimension());
    std::ranges::copy(rows, bezier.numbers().begin());
    return bezier;
}

Approximation drawn(const Points& control,
                    Ends ends,
                    double tolerance,
                    Joining joining,
                    std::span<const double> corners) {
    const MultiresCurve curve = decompose(control, ends);
    std::vector<SegmentLevel> levels = error_bounds(curve);
    levels.back().bezier = bezier_points(control, ends);  // without rounding
    const std::vector<double> places =
        corner_places(corners, segment_count(curve.level()));
    const std::vector<std::size_t> turns = knots_at(places);
    DrawnSegments segments = joining == Joining::kC0
                                 ? draw_joined_segments(levels, ends, tolerance, turns)
                                 : draw_segments(levels, tolerance, turns);
    const double error = parametric_error(levels.back().bezier, curve.level(), segments);
    return {places.empty() ? std::move(segments.bezier)
                           : cut_at_corners(segments, curve.level(), places),
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
    if (joining != Joining::kG1) return drawn(control, ends, tolerance, joining, corners);
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

Result<Approximation> approximate_pieces(const CorneredCurve& curve,
                                         double tolerance,
                                         Joining joining) {
    if (joining == Joining::kG1) {
        return approximate_chain(concatenate(curve).points, curve.ends, tolerance, {});
    }
    constexpr std::array kBoth = {0.0, 1.0};
    const std::span<const double> corners =
        curve.corners.empty() ? std::span<const double>() : kBoth;
    Approximation whole;
    std::vector<double> rows;
    for (const Points& piece : curve.pieces) {
        const auto part =
            approximate(piece, curve.piece_ends(), tolerance, joining, corners);
        if (!part) return part.error();
        const auto numbers = part->bezier.numbers();
        rows.insert(rows.end(), numbers.begin(), numbers.end());
        whole.possible += part->possible;
        whole.bound = std::max(whole.bound, part->bound);
        whole.max_error = std::max(whole.max_error, part->max_error);
    }
    const int dimension = curve.pieces.front().dimension();
    whole.bezier = Points(rows.size() / static_cast<std::size_t>(dimension), dimension);
    std::ranges::copy(rows, whole.bezier.numbers().begin());
    whole.closed = curve.ends == Ends::kClosed;
    whole.tolerance = tolerance;
    return whole;
}

}  // namespace haarmony::curve
