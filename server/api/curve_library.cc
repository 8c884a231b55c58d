#include "server/api/curve_library.h"

#include <optional>
#include <string>
#include <utility>

#include "server/api/content_tag.h"
#include "server/api/curve_json.h"
#include "server/api/image_id.h"
#include "server/api/profile_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

const std::string& name_of(const http::Request& request) {
    return request.path_parameters.at("name");
}

http::Response tagged(std::string text) {
    http::Response response = http::json_text_response(200, std::move(text));
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = content_tag(std::get<std::string>(response.body));
    return response;
}

// The members that characters, and those of a list, have.
void describe_character(JsonObject& object, const NamedCurve& character) {
    object.text("name", character.name)
        .boolean("built_in", character.built_in)
        .integer("level", *curve::level_of(character.points.size(), character.ends))
        .integer("dimension", character.points.dimension())
        .boolean("closed", character.ends == curve::Ends::kClosed)
        .text_or_null("updated_at", character.updated_at);
}

std::string character_text(const NamedCurve& character,
                           const std::optional<FitErrors>& fit) {
    std::string text;
    JsonObject reply(text);
    describe_character(reply, character);
    reply.json("points", points_text(character.points));
    add_fit(reply, fit);
    reply.end();
    return text;
}

std::string stroke_text(const NamedCurve& stroke) {
    std::string text;
    JsonObject reply(text);
    reply.text("name", stroke.name)
        .boolean("closed", stroke.ends == curve::Ends::kClosed)
        .text("updated_at", stroke.updated_at)
        .json("samples", points_text(stroke.points));
    reply.end();
    return text;
}

http::Response stored(const PutCurve& put, std::string text, const std::string& folder) {
    http::Response response =
        http::json_text_response(put.created ? 201 : 200, std::move(text));
    response.headers["Cache-Control"] = "no-store";
    if (put.created) response.headers["Location"] = folder + put.curve.name;
    return response;
}

}  // namespace

Reply list_characters(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto characters = context.curves.characters();
    if (!characters) return characters.error();
    std::string items = "[";
    for (const NamedCurve& character : characters.value()) {
        if (items.size() > 1) items += ',';
        JsonObject item(items);
        describe_character(item, character);
        item.end();
    }
    std::string text;
    JsonObject reply(text);
    reply.json("items", items + ']');
    reply.end();
    return tagged(std::move(text));
}

Reply get_character(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto character = context.curves.character(name_of(request));
    if (!character) return character.error();
    return tagged(character_text(character.value(), {}));
}

Reply put_character(const Context& context, const http::Request& request) {
    const std::string& name = name_of(request);
    if (auto problem = refuse_name(name)) return *std::move(problem);
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    auto asked = to_curve(*std::move(source));
    if (!asked) return asked.problem();
    NamedCurve character;
    character.name = name;
    character.ends = asked->ends;
    character.points = std::move(asked->control);
    const auto put = context.curves.put_character(character);
    if (!put) return put.error();
    return stored(
        put.value(), character_text(put->curve, asked->fit), "/curve/characters/");
}

Reply delete_character(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto removed = context.curves.remove_character(name_of(request));
    if (!removed) return removed.error();
    return http::Response{204, {}, std::string()};
}

Reply post_match(const Context& context, const http::Request& request) {
    constexpr std::int64_t kMostMatches = 1'000;
    constexpr std::int64_t kUsualMatches = 20;
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    const auto limit = inputs->integer("limit", 1, kMostMatches).value_or(kUsualMatches);
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    auto stroke = drawn_stroke_of(*std::move(source));
    if (!stroke) return stroke.problem();
    const auto matches =
        context.curves.match(stroke->samples, static_cast<std::size_t>(limit));
    if (!matches) return matches.error();
    std::string items = "[";
    for (const curve::StrokeMatch& match : matches->best) {
        if (items.size() > 1) items += ',';
        JsonObject item(items);
        item.text("name", match.name)
            .integer("score", match.score)
            .number("similarity", match.similarity);
        item.end();
    }
    std::string text;
    JsonObject reply(text);
    reply.json("items", items + ']')
        .integer("strokes", static_cast<std::int64_t>(matches->strokes));
    reply.end();
    return http::json_text_response(200, std::move(text));
}

Reply get_stroke(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto stroke = context.curves.stroke(name_of(request));
    if (!stroke) return stroke.error();
    return tagged(stroke_text(stroke.value()));
}

Reply put_stroke(const Context& context, const http::Request& request) {
    const std::string& name = name_of(request);
    if (auto problem = refuse_name(name)) return *std::move(problem);
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto source = read_curve_source(*inputs);
    if (!source) return source.problem();
    if (const auto problem = inputs->refused()) return *problem;
    auto samples = drawn_stroke_of(*std::move(source));
    if (!samples) return samples.problem();
    NamedCurve stroke;
    stroke.name = name;
    stroke.ends = samples->ends;
    stroke.points = std::move(samples->samples);
    const auto put = context.curves.put_stroke(stroke);
    if (!put) return put.error();
    return stored(put.value(), stroke_text(put->curve), "/curve/strokes/");
}

Reply delete_stroke(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto removed = context.curves.remove_stroke(name_of(request));
    if (!removed) return removed.error();
    return http::Response{204, {}, std::string()};
}

}  // namespace haarmony::server
