// Points, derivatives, normals and curvature of a curve at any of its levels.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/curve/bspline.h"
#include "engine/curve/smooth.h"
#include "server/api/cornered_json.h"
#include "server/api/curve_json.h"
#include "server/api/curves.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using curve::Ends;
using nlohmann::json;

constexpr std::size_t kMostParameters = 1'000'000;

// Evenly over an open curve with both ends, over a closed one without the end, which is the
// start.
std::vector<double> even_parameters(std::size_t count, Ends ends) {
    std::vector<double> u(count);
    const std::size_t steps = ends == Ends::kOpen ? count - 1 : count;
    for (std::size_t i = 0; i < count; ++i)
        u[i] = steps == 0 ? 0 : static_cast<double>(i) / static_cast<double>(steps);
    return u;
}

Outcome<std::vector<double>> read_parameters(const json& value) {
    auto u = read_numbers(value, "u", kMostParameters);
    if (!u) return u;
    for (std::size_t i = 0; i < u->size(); ++i)
        if (!((*u)[i] >= 0 && (*u)[i] <= 1)) {
            const std::string place = "u[" + std::to_string(i) + "]";
            return impossible(
                "out_of_range",
                place + " '" + number_text((*u)[i]) + "' is not a parameter from 0 to 1",
                place);
        }
    return u;
}

struct Evaluation {
    curve::Points points;
    curve::Points tangents;
    curve::Points normals;          // two numbers each
    std::vector<double> curvature;  // not finite where the curve stands still
};

// Rows of sums of control points, weighted.
void weigh(const curve::Points& control,
           const curve::BasisAt& basis,
           const std::array<double, 4>& weights,
           std::span<double> out) {
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const auto point = control[(basis.first + k) % control.size()];
        for (std::size_t d = 0; d < out.size(); ++d) out[d] += weights[k] * point[d];
    }
}

struct Plane {
    double x = 0;
    double y = 0;
};
Plane plane_of(std::span<const double> row) {
    return {row[0], row.size() > 1 ? row[1] : 0};
}

// Where the tangent vanishes the curve leaves along its second derivative; where that does,
// too, it has no direction, and that of the x axis is as good as any.
Plane direction(Plane slope, Plane bend) {
    for (const Plane& way : {slope, bend}) {
        const double length = std::hypot(way.x, way.y);
        if (length > 0) return {way.x / length, way.y / length};
    }
    return {1, 0};
}

double curvature(Plane slope, Plane bend) {
    const double speed = std::hypot(slope.x, slope.y);
    if (speed == 0) return std::numeric_limits<double>::quiet_NaN();
    const Plane way{slope.x / speed, slope.y / speed};
    return (way.x * bend.y - way.y * bend.x) / speed / speed;
}

// Room for so many points of a dimension.
Evaluation room_for(std::size_t count, int dimension) {
    Evaluation result;
    result.points = curve::Points(count, dimension);
    result.tangents = curve::Points(count, dimension);
    result.normals = curve::Points(count, 2);
    result.curvature.resize(count);
    return result;
}

// Row `i` from a curve at its own u, of which `size` of the whole's is 1.
void evaluate_at(const curve::Points& control,
                 int level,
                 Ends ends,
                 double u,
                 double size,
                 std::size_t i,
                 Evaluation& result) {
    const curve::BasisAt basis = curve::basis_at(level, ends, u);
    std::array<double, curve::kMostDimensions> second{};
    const auto tangent = result.tangents[i];
    weigh(control, basis, basis.value, result.points[i]);
    weigh(control, basis, basis.slope, tangent);
    weigh(control, basis, basis.bend, std::span(second).first(tangent.size()));
    const Plane slope = plane_of(tangent);
    const Plane bend = plane_of(std::span(second).first(tangent.size()));
    const Plane way = direction(slope, bend);
    result.normals[i][0] = -way.y;
    result.normals[i][1] = way.x;
    result.curvature[i] = curvature(slope, bend);
    for (double& number : tangent) number /= size;
}

// f^level of a curve, or of the pieces of one with corners.
struct Evaluated {
    Ends ends = Ends::kOpen;
    int level = 0;  // of the whole
    std::optional<FitErrors> fit;
    curve::CorneredCurve curve;
};

Outcome<Evaluated> curve_of(CurveSource source) {
    Evaluated made;
    if (has_corners(source)) {
        auto asked = to_cornered(std::move(source));
        if (!asked) return asked.problem();
        made.ends = asked->curve.ends;
        made.level = asked->level;
        made.fit = asked->fit;
        made.curve = std::move(asked->curve);
        return made;
    }
    auto asked = to_curve(std::move(source));
    if (!asked) return asked.problem();
    made.ends = asked->ends;
    made.level = asked->level;
    made.fit = asked->fit;
    made.curve.ends = asked->ends;
    made.curve.pieces.push_back(std::move(asked->control));
    return made;
}

curve::CorneredCurve at_level(const Evaluated& whole, double level) {
    if (level == whole.level) return whole.curve;
    if (!whole.curve.corners.empty()) return curve::smooth(whole.curve, level);
    curve::CorneredCurve smoothed = whole.curve;
    smoothed.pieces[0] = curve::smooth(curve::decompose(smoothed.pieces[0], whole.ends),
                                       level,
                                       curve::SmoothedEnds::kFree);
    return smoothed;
}

Evaluation evaluate(const curve::CorneredCurve& curve,
                    const std::vector<double>& parameters) {
    Evaluation result = room_for(parameters.size(), curve.pieces[0].dimension());
    std::vector<int> levels;
    for (std::size_t i = 0; i < curve.pieces.size(); ++i)
        levels.push_back(level_of_piece(curve, i));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const curve::PieceParameter at = curve::piece_at(curve, parameters[i]);
        const curve::PieceRange range = curve::range_of(curve, at.piece);
        evaluate_at(curve.pieces[at.piece],
                    levels[at.piece],
                    curve.piece_ends(),
                    at.u,
                    range.to - range.from,
                    i,
                    result);
    }
    return result;
}

double length_of(const curve::CorneredCurve& curve) {
    double length = 0;
    for (const curve::Points& piece : curve.pieces)
        length += curve::length(piece, curve.piece_ends(), 0, 1);
    return length;
}

}  // namespace

Reply post_evaluate(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const auto level = read_real(*inputs, "level");
    const auto count =
        inputs->integer("count", 1, static_cast<std::int64_t>(kMostParameters));
    const json* given = inputs->peek("u");
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    if ((given != nullptr) == count.has_value())
        return malformed("exactly one of u and count is to be given", "u");
    auto parameters = given ? read_parameters(*given)
                            : Outcome<std::vector<double>>(std::vector<double>());
    if (!parameters) return parameters.problem();
    auto asked = curve_of(*std::move(source));
    if (!asked) return asked.problem();
    const double wanted = level.value_or(asked->level);
    if (auto problem = refuse_level("level", wanted, asked->level))
        return *std::move(problem);
    if (count)
        *parameters = even_parameters(static_cast<std::size_t>(*count), asked->ends);
    const curve::CorneredCurve curve = at_level(*asked, wanted);
    const Evaluation found = evaluate(curve, *parameters);

    std::string text;
    JsonObject reply(text);
    reply.json("points", points_text(found.points))
        .json("tangents", points_text(found.tangents))
        .json("normals", points_text(found.normals))
        .json("curvature", numbers_text(found.curvature))
        .number("length", length_of(curve))
        .number("level", wanted)
        .json("u", numbers_text(*parameters));
    if (asked->ends == Ends::kClosed) reply.boolean("closed", true);
    add_fit(reply, asked->fit);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace haarmony::server
