// A curve as few Bezier segments, as JSON or as a document of another format.
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/curve/approximate.h"
#include "engine/curve/bezier_text.h"
#include "engine/curve/corners.h"
#include "engine/curve/geojson.h"
#include "server/api/cornered_json.h"
#include "server/api/curve_json.h"
#include "server/api/curves.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

constexpr std::array<std::string_view, 3> kModes{"dyadic", "c0", "g1"};
constexpr std::array<std::string_view, 4> kFormats{"json",
                                                   "svg",
                                                   "postscript",
                                                   "geojson"};

struct ApproximateRequest {
    std::optional<double> tolerance;
    std::string mode = "g1";
    std::string format = "json";
};

Outcome<ApproximateRequest> read_approximate(Inputs& inputs) {
    ApproximateRequest read;
    read.tolerance = inputs.number("tolerance", 0, curve::kLargestCoordinate);
    if (read.tolerance && *read.tolerance == 0)
        inputs.refuse("tolerance", "is not above 0");
    read.mode = inputs.one_of("mode", kModes).value_or(read.mode);
    read.format = inputs.one_of("format", kFormats).value_or(read.format);
    if (auto problem = refused_so_far(inputs)) return *std::move(problem);
    if (!read.tolerance) return malformed("tolerance is missing", "tolerance");
    return read;
}

curve::Joining joining_of(std::string_view mode) {
    if (mode == kModes[0]) return curve::Joining::kDyadic;
    return mode == kModes[1] ? curve::Joining::kC0 : curve::Joining::kG1;
}

http::Response document(std::string text, std::string type) {
    http::Response response;
    response.headers["Content-Type"] = std::move(type);
    response.body = std::move(text);
    return response;
}

std::string segments_text(const curve::Points& bezier) {
    std::string text = "[";
    for (std::size_t row = 0; row < bezier.size(); ++row) {
        if (row % 4 == 0) text += row == 0 ? "[" : ",[";
        append_numbers(text, bezier[row]);
        text += row % 4 == 3 ? ']' : ',';
    }
    return text += ']';
}

struct Approximated {
    curve::Approximation curve;
    std::optional<FitErrors> fit;
    std::optional<std::vector<double>> corners;  // where asked for
};

// Pieces meet at corners, where the result may turn as they do.
Outcome<Approximated> approximated_pieces(CurveSource source,
                                          double tolerance,
                                          curve::Joining joining) {
    auto asked = to_cornered(std::move(source));
    if (!asked) return asked.problem();
    auto found = curve::approximate_pieces(asked->curve, tolerance, joining);
    if (!found) return impossible(found.error());
    return Approximated{
        std::move(found).value(), asked->fit, std::move(asked->curve.corners)};
}

Outcome<Approximated> approximated(CurveSource source,
                                   double tolerance,
                                   curve::Joining joining) {
    const bool cornered = has_corners(source);
    const bool is_curve = source.kind == CurveSource::Kind::kControl;
    if (cornered && !is_curve)
        return approximated_pieces(std::move(source), tolerance, joining);
    // Control points need not be taken apart, and a fit of pieces would not be exact.
    const bool detect = source.detect_corners;
    auto asked = to_curve(std::move(source));
    if (!asked) return asked.problem();
    if (detect)
        asked->corners = curve::detect_curve_corners(asked->control, asked->ends, {});
    auto found = curve::approximate(
        asked->control, asked->ends, tolerance, joining, asked->corners);
    if (!found) return impossible(found.error());
    Approximated made{std::move(found).value(), asked->fit, {}};
    if (cornered) made.corners = std::move(asked->corners);
    return made;
}

http::Response json_reply(const Approximated& approximated,
                          const ApproximateRequest& wanted) {
    const curve::Approximation& found = approximated.curve;
    std::string text;
    JsonObject reply(text);
    reply.json("segments", segments_text(found.bezier))
        .integer("count", static_cast<std::int64_t>(found.count()))
        .integer("possible", static_cast<std::int64_t>(found.possible))
        .text("mode", wanted.mode)
        .number("tolerance", found.tolerance)
        .number("bound", found.bound)
        .number("max_error", found.max_error);
    if (found.closed) reply.boolean("closed", true);
    add_fit(reply, approximated.fit);
    if (approximated.corners) reply.json("corners", numbers_text(*approximated.corners));
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace

Reply post_approximate(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto wanted = read_approximate(*inputs);
    if (!wanted) return wanted.problem();
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    const bool lines = wanted->format == kFormats[3];
    const double flatness = lines ? *wanted->tolerance * curve::kFlatnessShare : 0;
    auto found = approximated(
        *std::move(source), *wanted->tolerance - flatness, joining_of(wanted->mode));
    if (!found) return found.problem();
    if (wanted->format == kFormats[0]) return json_reply(*found, *wanted);
    if (wanted->format == kFormats[1])
        return document(curve::svg_document(found->curve), "image/svg+xml");
    if (wanted->format == kFormats[2])
        return document(curve::postscript(found->curve), "application/postscript");
    auto text = curve::geojson(found->curve, flatness);
    if (!text) return impossible(text.error());
    return document(std::move(text).value(), "application/geo+json");
}

}  // namespace haarmony::server
