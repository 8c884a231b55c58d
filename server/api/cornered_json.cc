#include "server/api/cornered_json.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/curve/corners.h"

namespace haarmony::server {
namespace {

using curve::Ends;

// The ends of an open curve are corners without being named; of a closed one u = 1 is u = 0.
std::vector<double> inner_corners(std::vector<double> corners, Ends ends) {
    if (ends == Ends::kClosed)
        std::ranges::replace(corners, 1.0, 0.0);
    else
        std::erase_if(corners, [](double u) { return u == 0 || u == 1; });
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
}

int finest(const curve::CorneredCurve& curve) {
    int level = 0;
    for (std::size_t i = 0; i < curve.pieces.size(); ++i)
        level = std::max(level, level_of_piece(curve, i));
    return level;
}

Outcome<CorneredRequest> split(CurveSource source, Ends ends) {
    CorneredRequest made;
    made.level = *curve::level_of(source.points.size(), ends);
    made.tolerance = source.fit_tolerance.value_or(default_tolerance(source.points));
    const std::vector<double> corners =
        source.detect_corners ? curve::detect_curve_corners(source.points, ends, {})
                              : inner_corners(std::move(source.corners), ends);
    auto pieces = curve::split_at_corners(source.points, ends, corners, made.tolerance);
    if (!pieces) return impossible(pieces.error());
    // Pieces from knot to knot are the curve itself.
    constexpr double kExact = 1e-9;
    if (pieces->max_error > kExact * made.tolerance)
        made.fit = FitErrors{finest(pieces->curve), pieces->max_error, pieces->rms_error};
    made.curve = std::move(pieces->curve);
    return made;
}

}  // namespace

bool has_corners(const CurveSource& source) {
    return source.detect_corners || !source.corners.empty();
}

int level_of_piece(const curve::CorneredCurve& curve, std::size_t piece) {
    return *curve::level_of(curve.pieces[piece].size(), curve.piece_ends());
}

Outcome<CorneredRequest> fit_pieces(const CurveSource& source,
                                    const Stroke& stroke,
                                    const curve::PieceGoal& goal,
                                    const curve::FitOptions& options) {
    std::vector<std::size_t> corners;
    if (source.detect_corners) {
        corners = curve::detect_corners(stroke.samples, stroke.ends, {});
    } else {
        auto found = curve::samples_at_corners(
            curve::stroke_parameters(stroke.samples, stroke.ends, options.spacing),
            stroke.ends,
            inner_corners(source.corners, stroke.ends));
        if (!found) return impossible(found.error());
        corners = std::move(found).value();
    }
    curve::CorneredFit fit = curve::fit_cornered(stroke.samples, corners, goal, options);
    CorneredRequest made;
    made.level = finest(fit.curve);
    made.tolerance = goal.tolerance;
    made.fit = FitErrors{made.level, fit.max_error, fit.rms_error};
    made.curve = std::move(fit.curve);
    return made;
}

Outcome<CorneredRequest> to_cornered(CurveSource source) {
    const Ends ends = source.closed.value_or(false) ? Ends::kClosed : Ends::kOpen;
    if (source.kind == CurveSource::Kind::kControl) return split(std::move(source), ends);
    auto stroke = stroke_of(source);
    if (!stroke) return stroke.problem();
    curve::FitOptions options;
    options.ends = stroke->ends;
    curve::PieceGoal goal;
    goal.tolerance = source.fit_tolerance.value_or(default_tolerance(stroke->samples));
    return fit_pieces(source, *stroke, goal, options);
}

Outcome<RoundedRequest> to_rounded(CurveSource source) {
    RoundedRequest made;
    if (!has_corners(source) || source.kind == CurveSource::Kind::kControl) {
        // Control points are one curve, whatever corners it has.
        const bool detect = source.detect_corners;
        auto asked = to_curve(std::move(source));
        if (!asked) return asked.problem();
        made.curve = *std::move(asked);
        made.curve.corners =
            detect ? curve::detect_curve_corners(made.curve.control, made.curve.ends, {})
                   : inner_corners(std::move(made.curve.corners), made.curve.ends);
        return made;
    }
    auto asked = to_cornered(std::move(source));
    if (!asked) return asked.problem();
    curve::CurveFit rounded = curve::without_corners(asked->curve, asked->tolerance);
    made.curve.control = std::move(rounded.control);
    made.curve.ends = asked->curve.ends;
    made.curve.level = rounded.level;
    made.curve.fit = asked->fit;
    made.curve.corners = std::move(asked->curve.corners);
    made.rounding_error = rounded.max_error;
    return made;
}

void add_cornered(JsonObject& object,
                  const curve::CorneredCurve& curve,
                  const CorneredRequest& asked) {
    const curve::CurveFit rounded = curve::without_corners(curve, asked.tolerance);
    object.json("points", points_text(rounded.control)).integer("level", rounded.level);
    if (curve.ends == Ends::kClosed) object.boolean("closed", true);
    add_fit(object, asked.fit);
    std::string pieces = "[";
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        const curve::PieceRange range = curve::range_of(curve, i);
        if (i > 0) pieces += ',';
        JsonObject piece(pieces);
        piece.json("points", points_text(curve.pieces[i]))
            .integer("level", level_of_piece(curve, i))
            .number("from", range.from)
            .number("to", range.to);
        piece.end();
    }
    object.json("corners", numbers_text(curve.corners))
        .json("pieces", pieces + ']')
        .number("rounding_error", rounded.max_error);
}

}  // namespace haarmony::server
