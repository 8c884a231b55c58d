// Between a curve and its levels: decompose, reconstruct, smooth.
#include <cmath>
#include <string>
#include <utility>

#include "engine/curve/smooth.h"
#include "server/api/cornered_json.h"
#include "server/api/curve_json.h"
#include "server/api/curves.h"
#include "server/api/details_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using curve::Ends;

int ceiling(double level) { return static_cast<int>(std::ceil(level)); }

// The pieces keep their ends in any case.
Reply smooth_pieces(CurveSource source, double level) {
    auto asked = to_cornered(std::move(source));
    if (!asked) return asked.problem();
    if (auto problem = refuse_level("level", level, asked->level))
        return *std::move(problem);
    std::string text;
    JsonObject reply(text);
    add_cornered(reply, curve::smooth(asked->curve, level), *asked);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

// The whole, its corners rounded off, and each piece.
Reply decompose_pieces(CurveSource source, curve::Frame frame) {
    auto asked = to_cornered(std::move(source));
    if (!asked) return asked.problem();
    const curve::CorneredCurve& curve = asked->curve;
    const curve::CurveFit rounded = curve::without_corners(curve, asked->tolerance);
    std::string text;
    JsonObject reply(text);
    add_details(reply,
                curve::to_local(curve::decompose(rounded.control, curve.ends), frame));
    if (curve.ends == Ends::kClosed) reply.boolean("closed", true);
    add_fit(reply, asked->fit);
    std::string pieces = "[";
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        if (i > 0) pieces += ',';
        const curve::PieceRange range = curve::range_of(curve, i);
        JsonObject piece(pieces);
        add_details(piece,
                    curve::to_local(curve::decompose(curve.pieces[i], curve.piece_ends()),
                                    frame));
        piece.number("from", range.from).number("to", range.to);
        piece.end();
    }
    reply.json("corners", numbers_text(curve.corners))
        .json("pieces", pieces + ']')
        .number("rounding_error", rounded.max_error);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace

http::Cost cost_of_curve(const http::Request& request) {
    constexpr std::size_t kShort = 131'072;  // a curve of 3,000 points
    return request.body.size() > kShort ? http::Cost::kCostly : http::Cost::kCheap;
}

Reply post_decompose(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const auto frame = read_frame(*inputs).value_or(curve::Frame::kFixed);
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    if (has_corners(*source)) return decompose_pieces(*std::move(source), frame);
    auto asked = to_curve(*std::move(source));
    if (!asked) return asked.problem();

    std::string text;
    JsonObject reply(text);
    add_details(reply,
                curve::to_local(curve::decompose(asked->control, asked->ends), frame));
    if (asked->ends == Ends::kClosed) reply.boolean("closed", true);
    add_fit(reply, asked->fit);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

Reply post_reconstruct(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const auto frame = read_frame(*inputs).value_or(curve::Frame::kFixed);
    const bool closed = inputs->boolean("closed").value_or(false);
    const auto level = read_real(*inputs, "level");
    auto details = read_details(*inputs, frame, closed ? Ends::kClosed : Ends::kOpen);
    if (!details) return details.problem();
    if (const auto problem = inputs->refused()) return *problem;
    const double wanted = level.value_or(details->level());
    if (auto problem = refuse_level("level", wanted, details->level()))
        return *std::move(problem);

    std::string text;
    JsonObject reply(text);
    const curve::Points control =
        curve::smooth(curve::to_world(*details), wanted, curve::SmoothedEnds::kFree);
    reply.json("points", points_text(control)).integer("level", ceiling(wanted));
    if (closed) reply.boolean("closed", true);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

Reply post_smooth(const Context& /*context*/, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const auto level = read_real(*inputs, "level");
    const bool pin = inputs->boolean("pin_ends").value_or(false);
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    if (!level) return malformed("level is missing", "level");
    if (has_corners(*source)) return smooth_pieces(*std::move(source), *level);
    auto asked = to_curve(*std::move(source));
    if (!asked) return asked.problem();
    if (auto problem = refuse_level("level", *level, asked->level))
        return *std::move(problem);

    const auto ends = pin ? curve::SmoothedEnds::kPinned : curve::SmoothedEnds::kFree;
    std::string text;
    JsonObject reply(text);
    add_curve(reply,
              curve::smooth(curve::decompose(asked->control, asked->ends), *level, ends),
              ceiling(*level),
              *asked);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace haarmony::server
