// The details of one curve on the sweep of another.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "engine/curve/character.h"
#include "server/api/cornered_json.h"
#include "server/api/curve_json.h"
#include "server/api/curves.h"
#include "server/api/details_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using curve::Ends;
using nlohmann::json;

http::Problem inside_character(http::Problem problem) {
    problem.param =
        "character" + std::string(problem.param.empty() ? "" : ".") + problem.param;
    return problem;
}

// From an object: a curve, whose corners are details of its fine levels, or {"coarse", "details"} in the frames of the request.
Outcome<curve::LocalDetails> read_object(const json& value, curve::Frame frame) {
    auto members = Inputs::of_object(value);
    if (!members) return inside_character(members.problem());
    if (members->has("coarse") || members->has("details")) {
        const bool closed = members->boolean("closed").value_or(false);
        auto details =
            read_details(*members, frame, closed ? Ends::kClosed : Ends::kOpen);
        if (!details) return inside_character(details.problem());
        if (const auto problem = members->refused()) return inside_character(*problem);
        return details;
    }
    auto source = read_curve_source(*members);
    if (!source) return inside_character(source.problem());
    if (const auto problem = members->refused()) return inside_character(*problem);
    auto given = to_rounded(*std::move(source));
    if (!given) return inside_character(given.problem());
    return curve::character_of(given->curve.control, given->curve.ends, frame);
}

Outcome<curve::LocalDetails> read_character(const Context& context,
                                            const json& value,
                                            curve::Frame frame) {
    if (value.is_object()) return read_object(value, frame);
    if (!value.is_string())
        return malformed(
            "character '" + shown_json(value) + "' is neither a name nor an object",
            "character");
    const auto& name = value.get_ref<const std::string&>();
    const auto stored = context.curves.character(name);
    if (!stored) {
        http::Problem problem = http::problem_of(stored.error());
        if (problem.param == "name") problem.param = "character";
        return problem;
    }
    return curve::character_of(stored->points, stored->ends, frame);
}

// Each piece gets all of the character, and the next one begins where it ends.
Reply give_to_pieces(CurveSource source,
                     const curve::LocalDetails& character,
                     double level,
                     double strength) {
    auto asked = to_cornered(std::move(source));
    if (!asked) return asked.problem();
    if (auto problem = refuse_level("from_level", level, asked->level))
        return *std::move(problem);
    curve::CorneredCurve& curve = asked->curve;
    for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
        const int from = std::min(static_cast<int>(level), level_of_piece(curve, i));
        auto control =
            curve::give_character(curve::decompose(curve.pieces[i], curve.piece_ends()),
                                  character,
                                  from,
                                  strength);
        if (!control) return impossible(control.error());
        curve::replace_piece(curve, i, std::move(control).value(), from);
    }
    std::string text;
    JsonObject reply(text);
    add_cornered(reply, curve, *asked);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace

Reply post_character(const Context& context, const http::Request& request) {
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const auto frame = read_frame(*inputs).value_or(curve::Frame::kFixed);
    const auto from_level = read_whole(*inputs, "from_level");
    const double strength = read_real(*inputs, "strength").value_or(1);
    const json* given = inputs->peek("character");
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    if (given == nullptr) return malformed("character is missing", "character");
    auto character = read_character(context, *given, frame);
    if (!character) return character.problem();
    const double level = from_level.value_or(0);
    if (has_corners(*source))
        return give_to_pieces(*std::move(source), *character, level, strength);
    auto asked = to_curve(*std::move(source));
    if (!asked) return asked.problem();
    if (auto problem = refuse_level("from_level", level, asked->level))
        return *std::move(problem);
    auto control = curve::give_character(curve::decompose(asked->control, asked->ends),
                                         *character,
                                         static_cast<int>(level),
                                         strength);
    if (!control) return impossible(control.error());

    std::string text;
    JsonObject reply(text);
    add_curve(
        reply, control.value(), *curve::level_of(control->size(), asked->ends), *asked);
    reply.end();
    return http::json_text_response(200, std::move(text));
}

}  // namespace haarmony::server
