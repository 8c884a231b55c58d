#include "server/api/curve_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/curve/bspline.h"
#include "engine/curve/path_samples.h"
#include "engine/curve/svg_path.h"

namespace haarmony::server {
namespace {

using curve::Ends;
using nlohmann::json;

constexpr std::array<std::string_view, 3> kFrames{"fixed", "normalized", "unnormalized"};
constexpr std::size_t kLeastPoints = 4;
constexpr std::size_t kLeastSamples = 2;
constexpr std::size_t kMostCorners = 1'000;
// Of the fit's tolerance: so far may a path be from the chords between its samples.
constexpr double kPathShare = 1.0 / 20;

struct Box {
    double width = 0;
    double height = 0;
};

Box box_of(const curve::Points& points) {
    std::array<double, 2> extent{};
    for (int k = 0; k < std::min(points.dimension(), 2); ++k) {
        double least = std::numeric_limits<double>::infinity();
        double most = -least;
        for (std::size_t i = 0; i < points.size(); ++i) {
            least = std::min(least, points[i][std::size_t(k)]);
            most = std::max(most, points[i][std::size_t(k)]);
        }
        extent[std::size_t(k)] = most - least;
    }
    return {extent[0], extent[1]};
}

Outcome<curve::Points> enough(Outcome<curve::Points> points,
                              std::string_view name,
                              std::size_t least) {
    if (!points || points->size() >= least) return points;
    return impossible("too_few_" + std::string(name),
                      std::string(name) + " has " + std::to_string(points->size()) +
                          (points->size() == 1 ? " entry" : " entries") +
                          ", fewer than " + std::to_string(least),
                      name);
}

std::optional<http::Problem> read_corners(Inputs& inputs, CurveSource& source) {
    const json* value = inputs.peek("corners");
    if (value == nullptr) return {};
    if (value->is_string() && *value == "detect") {
        source.detect_corners = true;
        return {};
    }
    auto corners = read_numbers(*value, "corners", kMostCorners);
    if (!corners) return corners.problem();
    for (std::size_t i = 0; i < corners->size(); ++i)
        if (const double u = (*corners)[i]; !(u >= 0 && u <= 1))
            return impossible("out_of_range",
                              "corners[" + std::to_string(i) + "] '" + number_text(u) +
                                  "' is not a parameter from 0 to 1",
                              "corners[" + std::to_string(i) + "]");
    source.corners = *std::move(corners);
    std::ranges::sort(source.corners);
    source.corners.erase(std::unique(source.corners.begin(), source.corners.end()),
                         source.corners.end());
    return {};
}

Outcome<Stroke> stroke_of_path(const CurveSource& source) {
    auto paths = curve::parse_svg_path(source.path);
    if (!paths) return impossible("bad_path", "d: " + paths.error().message, "d");
    if (source.subpath >= paths->size())
        return impossible("out_of_range",
                          "subpath '" + std::to_string(source.subpath) +
                              "' is not there: d has " + std::to_string(paths->size()),
                          "subpath");
    const curve::SvgSubpath& path = paths.value()[source.subpath];
    Stroke stroke;
    stroke.ends = source.closed.value_or(path.closed) ? Ends::kClosed : Ends::kOpen;
    const double tolerance =
        source.fit_tolerance.value_or(default_tolerance(path.bezier));
    // A path of one point is no longer one when it is drawn a little.
    stroke.deviation = tolerance > 0 ? tolerance * kPathShare : 1;
    auto samples = curve::sample_path(path, stroke.deviation);
    if (!samples)
        return impossible("too_many_samples", "d: " + samples.error().message, "d");
    stroke.samples = std::move(samples->points);
    if (path.closed && stroke.ends == Ends::kOpen) {
        // As an open stroke it ends where it began.
        curve::Points ended(stroke.samples.size() + 1, stroke.samples.dimension());
        std::ranges::copy(stroke.samples.numbers(), ended.numbers().begin());
        std::ranges::copy(stroke.samples[0], ended[stroke.samples.size()].begin());
        stroke.samples = std::move(ended);
    }
    return stroke;
}

}  // namespace

Outcome<Inputs> curve_inputs(const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) {
        http::Problem problem = inputs.problem();
        if (problem.code == kNotFinite) problem.status = 422;
        return problem;
    }
    if (inputs->picture())
        return Error{ErrorCode::kUnsupportedFormat, "a picture is no curve", "file"};
    return inputs;
}

std::optional<http::Problem> refused_so_far(const Inputs& inputs) {
    std::optional<http::Problem> problem = inputs.refused();
    if (problem && problem->code == "unknown_parameter") return {};
    return problem;
}

double default_tolerance(const curve::Points& points) {
    constexpr double kShare = 1e-3;
    const Box box = box_of(points);
    return kShare * std::hypot(box.width, box.height);
}

Outcome<CurveSource> read_curve_source(Inputs& inputs) {
    CurveSource source;
    source.closed = inputs.boolean("closed");
    source.fit_tolerance = inputs.number("fit_tolerance", 0, curve::kMostPathCoordinate);
    if (source.fit_tolerance && *source.fit_tolerance == 0)
        inputs.refuse("fit_tolerance", "is not above 0");
    if (auto problem = read_corners(inputs, source)) return *std::move(problem);
    const json* points = inputs.peek("points");
    const json* samples = inputs.peek("samples");
    const std::optional<std::string> path = inputs.text("d");
    const auto subpath = inputs.integer("subpath", 0, std::int64_t{1} << 30);
    if (subpath && !inputs.has("d")) inputs.refuse("subpath", "is one of the path d");
    if (auto problem = refused_so_far(inputs)) return *std::move(problem);

    const int given = (points ? 1 : 0) + (samples ? 1 : 0) + (path ? 1 : 0);
    if (given == 0)
        return malformed("a curve is missing: one of points, samples and d", "points");
    if (given > 1)
        return malformed("of points, samples and d only one can be given",
                         points ? "points" : "samples");
    if (path) {
        source.kind = CurveSource::Kind::kPath;
        source.path = *path;
        source.subpath = static_cast<std::size_t>(subpath.value_or(0));
        return source;
    }
    auto rows =
        points
            ? enough(read_points(*points, "points", kMostPoints), "points", kLeastPoints)
            : enough(read_points(*samples, "samples", kMostSamples),
                     "samples",
                     kLeastSamples);
    if (!rows) return rows.problem();
    source.points = *std::move(rows);
    const Ends ends = source.closed.value_or(false) ? Ends::kClosed : Ends::kOpen;
    source.kind = points && curve::level_of(source.points.size(), ends)
                      ? CurveSource::Kind::kControl
                      : CurveSource::Kind::kSamples;
    return source;
}

Outcome<Stroke> drawn_stroke_of(CurveSource source) {
    constexpr std::size_t kPerSegment = 4;
    if (source.kind != CurveSource::Kind::kControl) return stroke_of(std::move(source));
    Stroke stroke;
    stroke.ends = source.closed.value_or(false) ? Ends::kClosed : Ends::kOpen;
    const int level = *curve::level_of(source.points.size(), stroke.ends);
    const std::size_t steps = kPerSegment * curve::segment_count(level);
    const std::size_t count = steps + (stroke.ends == Ends::kOpen ? 1 : 0);
    if (count > kMostSamples)
        return impossible("too_many_samples",
                          "points of level " + std::to_string(level) +
                              " are too many for a stroke: at most 131075",
                          "points");
    stroke.samples = curve::Points(count, source.points.dimension());
    for (std::size_t i = 0; i < count; ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(steps);
        std::ranges::copy(curve::point_at(source.points, stroke.ends, u),
                          stroke.samples[i].begin());
    }
    return stroke;
}

Outcome<Stroke> stroke_of(CurveSource source) {
    if (source.kind == CurveSource::Kind::kPath) return stroke_of_path(source);
    return Stroke{std::move(source.points),
                  source.closed.value_or(false) ? Ends::kClosed : Ends::kOpen,
                  0};
}

Outcome<RequestedCurve> to_curve(CurveSource source) {
    RequestedCurve made;
    made.corners = source.corners;
    if (source.kind == CurveSource::Kind::kControl) {
        made.ends = source.closed.value_or(false) ? Ends::kClosed : Ends::kOpen;
        made.level = *curve::level_of(source.points.size(), made.ends);
        made.control = std::move(source.points);
        return made;
    }
    const std::optional<double> asked = source.fit_tolerance;
    auto stroke = stroke_of(std::move(source));
    if (!stroke) return stroke.problem();
    curve::FitOptions options;
    options.ends = stroke->ends;
    curve::CurveFit fit = curve::fit_within(
        stroke->samples, asked.value_or(default_tolerance(stroke->samples)), options);
    made.control = std::move(fit.control);
    made.ends = stroke->ends;
    made.level = fit.level;
    made.fit = FitErrors{fit.level, fit.max_error, fit.rms_error};
    return made;
}

std::optional<curve::Frame> read_frame(Inputs& inputs) {
    const auto word = inputs.one_of("frame", kFrames);
    if (!word) return {};
    if (*word == kFrames[1]) return curve::Frame::kNormalized;
    if (*word == kFrames[2]) return curve::Frame::kUnnormalized;
    return curve::Frame::kFixed;
}

std::optional<double> read_real(Inputs& inputs, std::string_view name) {
    constexpr double kMost = std::numeric_limits<double>::max();
    return inputs.number(name, -kMost, kMost);
}

std::optional<double> read_whole(Inputs& inputs, std::string_view name) {
    const std::optional<double> value = read_real(inputs, name);
    if (!value || std::trunc(*value) == *value) return value;
    inputs.refuse(name, "is not a whole number");
    return {};
}

std::optional<http::Problem> refuse_level(std::string_view name, double level, int most) {
    if (level >= 0 && level <= most) return {};
    return impossible("level_out_of_range",
                      std::string(name) + " '" + number_text(level) +
                          "' is not from 0 to " + std::to_string(most) +
                          ", the level of the curve",
                      name);
}

void add_fit(JsonObject& object, const std::optional<FitErrors>& fit) {
    if (!fit) return;
    std::string text;
    JsonObject errors(text);
    errors.integer("level", fit->level)
        .number("max_error", fit->max_error)
        .number("rms_error", fit->rms_error);
    errors.end();
    object.json("fit", text);
}

void add_curve(JsonObject& object,
               const curve::Points& control,
               int level,
               const RequestedCurve& asked) {
    object.json("points", points_text(control)).integer("level", level);
    if (asked.ends == Ends::kClosed) object.boolean("closed", true);
    add_fit(object, asked.fit);
}

}  // namespace haarmony::server
