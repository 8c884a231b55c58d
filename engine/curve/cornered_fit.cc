#include "engine/curve/cornered_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/number_text.h"

namespace haarmony::curve {
namespace {

// Samples of a segment, when a curve is fitted anew: as many as a segment has numbers to
// tell, twice over.
constexpr std::size_t kSamplesPerSegment = 8;

Error corner_error(double u, const char* what) {
    return Error{
        ErrorCode::kInvalidArgument, "corner " + number_text(u) + " " + what, "corners"};
}

Result<void> check_corners(std::span<const double> corners, Ends ends) {
    double before = ends == Ends::kOpen ? 0 : -1;
    for (const double u : corners) {
        const bool inside = ends == Ends::kOpen ? u > 0 && u < 1 : u >= 0 && u < 1;
        if (!inside) {
            return corner_error(
                u, ends == Ends::kOpen ? "is not between 0 and 1" : "is not in [0, 1)");
        }
        if (!(u > before)) return corner_error(u, "is not greater than the one before");
        before = u;
    }
    return {};
}

// The rows first .. last of a closed or open list; of a closed one `last` may pass the end.
Points rows_of(const Points& samples, std::size_t first, std::size_t last) {
    Points part(last - first + 1, samples.dimension());
    for (std::size_t i = 0; i < part.size(); ++i)
        std::ranges::copy(samples[(first + i) % samples.size()], part[i].begin());
    return part;
}

// Errors of pieces, added up to those of the whole.
class Errors {
  public:
    void add(const CurveFit& piece, std::size_t samples) {
        most_ = std::max(most_, piece.max_error);
        // Scaled by the largest, so that no square overflows.
        roots_.push_back({piece.rms_error, double(samples)});
    }
    void report(CorneredFit& fit) const {
        double sum = 0;
        double count = 0;
        for (const auto& [rms, samples] : roots_) {
            const double part = most_ > 0 ? rms / most_ : 0;
            sum += part * part * samples;
            count += samples;
        }
        fit.max_error = most_;
        fit.rms_error = most_ * std::sqrt(sum / count);
    }

  private:
    double most_ = 0;
    std::vector<std::pair<double, double>> roots_;
};

CurveFit fit_piece(const Points& samples,
                   const PieceGoal& goal,
                   const FitOptions& options) {
    return goal.level ? fit(samples, *goal.level, options)
                      : fit_within(samples, goal.tolerance, options);
}

// The part of a curve that `range` covers, at its own parameters, from so many steps.
CurveFit follow(const Points& control,
                Ends ends,
                PieceRange range,
                std::size_t steps,
                double tolerance) {
    Points samples(steps + 1, control.dimension());
    std::vector<double> parameters(steps + 1);
    for (std::size_t k = 0; k <= steps; ++k) {
        parameters[k] = double(k) / double(steps);
        double u =
            k == steps ? range.to : range.from + parameters[k] * (range.to - range.from);
        if (u > 1) u -= 1;
        std::ranges::copy(point_at(control, ends, std::min(u, 1.0)), samples[k].begin());
    }
    FitOptions options;
    options.pin_ends = true;
    options.rounds = 0;
    options.parameters = parameters;
    return fit_within(samples, tolerance, options);
}

}  // namespace

Result<std::vector<std::size_t>> samples_at_corners(std::span<const double> parameters,
                                                    Ends ends,
                                                    std::span<const double> corners) {
    if (const Result<void> valid = check_corners(corners, ends); !valid)
        return valid.error();
    std::vector<std::size_t> samples;
    for (const double u : corners) {
        const auto behind = std::ranges::lower_bound(parameters, u);
        std::size_t nearest = std::size_t(behind - parameters.begin());
        if (nearest == parameters.size() ||
            (nearest > 0 && u - parameters[nearest - 1] <= parameters[nearest] - u))
            --nearest;
        // Past the last sample of a closed stroke comes the first one, if it is not repeated.
        if (ends == Ends::kClosed &&
            (parameters[nearest] == 1 || 1 - u < std::fabs(parameters[nearest] - u))) {
            if (!samples.empty() && samples.front() == 0)
                return corner_error(u, "has no sample between it and the first one");
            samples.insert(samples.begin(), 0);
            continue;
        }
        const bool end =
            ends == Ends::kOpen && (nearest == 0 || nearest + 1 == parameters.size());
        if (end) return corner_error(u, "has no sample between it and an end");
        if (!samples.empty() && nearest <= samples.back())
            return corner_error(u, "has no sample between it and the one before");
        samples.push_back(nearest);
    }
    return samples;
}

CorneredFit fit_cornered(const Points& samples,
                         std::span<const std::size_t> corners,
                         const PieceGoal& goal,
                         const FitOptions& options) {
    if (options.ends == Ends::kClosed && samples.size() > 2 &&
        std::ranges::equal(samples[0], samples[samples.size() - 1])) {
        // The start repeated: a corner there must not be two, with nothing between them.
        std::vector<std::size_t> kept;
        for (const std::size_t i : corners) kept.push_back(i % (samples.size() - 1));
        std::ranges::sort(kept);
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        return fit_cornered(rows_of(samples, 0, samples.size() - 2), kept, goal, options);
    }
    FitOptions of_piece = options;
    of_piece.parameters = {};
    CorneredFit result;
    result.curve.ends = options.ends;
    Errors errors;
    if (corners.empty()) {
        of_piece.pin_ends = false;
        CurveFit whole = fit_piece(samples, goal, of_piece);
        errors.add(whole, samples.size());
        result.curve.pieces.push_back(std::move(whole.control));
        errors.report(result);
        return result;
    }
    const std::vector<double> parameters =
        stroke_parameters(samples, options.ends, options.spacing);
    std::vector<std::size_t> bounds(corners.begin(), corners.end());
    for (const std::size_t i : corners) result.curve.corners.push_back(parameters[i]);
    if (options.ends == Ends::kOpen) {
        bounds.insert(bounds.begin(), 0);
        bounds.push_back(samples.size() - 1);
    } else {
        bounds.push_back(bounds.front() + samples.size());
    }
    of_piece.ends = Ends::kOpen;
    of_piece.pin_ends = true;
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        assert(bounds[i] < bounds[i + 1]);
        const Points part = rows_of(samples, bounds[i], bounds[i + 1]);
        CurveFit piece = fit_piece(part, goal, of_piece);
        errors.add(piece, part.size());
        result.curve.pieces.push_back(std::move(piece.control));
    }
    errors.report(result);
    return result;
}

Result<CorneredFit> split_at_corners(const Points& control,
                                     Ends ends,
                                     std::span<const double> corners,
                                     double tolerance) {
    if (const Result<void> valid = check_corners(corners, ends); !valid)
        return valid.error();
    CorneredFit result;
    result.curve.ends = ends;
    result.curve.corners.assign(corners.begin(), corners.end());
    if (corners.empty()) {
        result.curve.pieces.push_back(control);
        return result;
    }
    result.curve.pieces.resize(corners.size() + (ends == Ends::kOpen ? 1 : 0));
    const double segments = double(segment_count(*level_of(control.size(), ends)));
    Errors errors;
    for (std::size_t i = 0; i < result.curve.pieces.size(); ++i) {
        const PieceRange range = range_of(result.curve, i);
        std::size_t steps =
            kSamplesPerSegment * static_cast<std::size_t>(std::max(
                                     1.0, std::ceil((range.to - range.from) * segments)));
        CurveFit piece = follow(control, ends, range, steps, tolerance);
        // Other knots may take more control points than the samples can tell apart.
        while (piece.max_error <= tolerance && 4 * piece.control.size() > steps) {
            steps *= 2;
            piece = follow(control, ends, range, steps, tolerance);
        }
        errors.add(piece, piece.parameters.size());
        result.curve.pieces[i] = std::move(piece.control);
    }
    // u - 1 and u may differ by rounding, and so the points there.
    if (ends == Ends::kClosed) {
        Points& last = result.curve.pieces.back();
        std::ranges::copy(result.curve.pieces.front()[0], last[last.size() - 1].begin());
    }
    errors.report(result);
    return result;
}

}  // namespace haarmony::curve
