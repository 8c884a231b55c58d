#include "server/api/curve_library.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "server/api/content_tag.h"
#include "server/api/cornered_json.h"
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
void describe_character(JsonObject& object, const ListedCurve& character) {
    object.text("name", character.name)
        .boolean("built_in", character.built_in)
        .integer("level", *curve::level_of(character.count, character.ends))
        .integer("dimension", character.dimension)
        .boolean("closed", character.ends == curve::Ends::kClosed)
        .text_or_null("updated_at", character.updated_at);
}

void describe_stroke(JsonObject& object, const ListedCurve& stroke) {
    object.text("name", stroke.name)
        .integer("count", static_cast<std::int64_t>(stroke.count))
        .integer("dimension", stroke.dimension)
        .boolean("closed", stroke.ends == curve::Ends::kClosed)
        .text("updated_at", stroke.updated_at);
}

void add_character(JsonObject& object, const NamedCurve& character) {
    describe_character(object,
                       {character.name,
                        character.built_in,
                        character.ends,
                        character.points.dimension(),
                        character.points.size(),
                        character.updated_at});
    object.json("points", points_text(character.points));
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

struct PageRequest {
    std::string after;
    int limit = 0;
};

Outcome<PageRequest> read_page(const http::Request& request) {
    constexpr std::int64_t kMostListed = 1'000;
    constexpr std::int64_t kUsuallyListed = 100;
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const auto limit = inputs->integer("limit", 1, kMostListed).value_or(kUsuallyListed);
    const std::optional<std::string> cursor = inputs->text("cursor");
    if (cursor && !is_word(*cursor))
        inputs->refuse("cursor", "is no next_cursor: 1 to 64 of a-z, 0-9, _ and -");
    if (const auto problem = inputs->refused()) return *problem;
    return PageRequest{cursor.value_or(""), static_cast<int>(limit)};
}

Reply page_of(const Result<CurvePage>& page,
              void (*describe)(JsonObject&, const ListedCurve&)) {
    if (!page) return page.error();
    std::string items = "[";
    for (const ListedCurve& curve : page->items) {
        if (items.size() > 1) items += ',';
        JsonObject item(items);
        describe(item, curve);
        item.end();
    }
    std::string text;
    JsonObject reply(text);
    reply.json("items", items + ']')
        .text_or_null("next_cursor", page->more ? page->items.back().name : "");
    reply.end();
    return tagged(std::move(text));
}

// What a request to keep a curve under a name says of it.
Outcome<CurveSource> read_named(const http::Request& request) {
    if (auto problem = refuse_name(name_of(request))) return *std::move(problem);
    auto inputs = curve_inputs(request);
    if (!inputs) return inputs.problem();
    auto source = read_curve_source(*inputs);
    if (!source) return source;
    if (const auto problem = inputs->refused()) return *problem;
    return source;
}

// A stroke is what was drawn, its corners with it; none can be made in it.
Outcome<Stroke> stroke_as_drawn(CurveSource source) {
    if (has_corners(source))
        return impossible("no_corners",
                          "corners are of curves: a stroke is kept and compared as drawn",
                          "corners");
    return drawn_stroke_of(std::move(source));
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
    auto asked = read_page(request);
    if (!asked) return asked.problem();
    return page_of(context.curves.characters(asked->after, asked->limit),
                   describe_character);
}

Reply get_character(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto character = context.curves.character(name_of(request));
    if (!character) return character.error();
    std::string text;
    JsonObject reply(text);
    add_character(reply, character.value());
    reply.end();
    return tagged(std::move(text));
}

Reply put_character(const Context& context, const http::Request& request) {
    auto source = read_named(request);
    if (!source) return source.problem();
    const bool cornered = has_corners(*source);
    auto asked = to_rounded(*std::move(source));
    if (!asked) return asked.problem();
    NamedCurve character;
    character.name = name_of(request);
    character.ends = asked->curve.ends;
    character.points = std::move(asked->curve.control);
    const auto put = context.curves.put_character(character);
    if (!put) return put.error();
    std::string text;
    JsonObject reply(text);
    add_character(reply, put->curve);
    add_fit(reply, asked->curve.fit);
    if (cornered)
        reply.json("corners", numbers_text(asked->curve.corners))
            .number("rounding_error", asked->rounding_error);
    reply.end();
    return stored(put.value(), std::move(text), "/curve/characters/");
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
    auto stroke = stroke_as_drawn(*std::move(source));
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

Reply list_strokes(const Context& context, const http::Request& request) {
    auto asked = read_page(request);
    if (!asked) return asked.problem();
    return page_of(context.curves.strokes(asked->after, asked->limit), describe_stroke);
}

Reply get_stroke(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto stroke = context.curves.stroke(name_of(request));
    if (!stroke) return stroke.error();
    return tagged(stroke_text(stroke.value()));
}

Reply put_stroke(const Context& context, const http::Request& request) {
    auto source = read_named(request);
    if (!source) return source.problem();
    auto drawn = stroke_as_drawn(*std::move(source));
    if (!drawn) return drawn.problem();
    NamedCurve stroke;
    stroke.name = name_of(request);
    stroke.ends = drawn->ends;
    stroke.points = std::move(drawn->samples);
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
