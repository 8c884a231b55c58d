#include "server/api/query.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/signature_codec.h"
#include "server/api/explanation_json.h"
#include "server/api/image_id.h"
#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/api/json_text.h"
#include "server/api/query_options.h"
#include "server/api/query_source.h"
#include "server/api/server_timing.h"
#include "server/api/url_source.h"
#include "server/api/video_match.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

Outcome<QueryPicture> picture_of(const Context& context,
                                 const QuerySource& source,
                                 const LookOptions& look) {
    const bool pixels = !std::holds_alternative<ImageId>(source) &&
                        !std::holds_alternative<image::Signature>(source);
    if ((look.partial || look.misregistered) && !pixels) {
        const std::string name = look.partial ? "partial" : "misregistered";
        return http::Problem{400,
                             "invalid_argument",
                             name +
                                 "=true needs the picture itself: an id and a "
                                 "signature have no pixels",
                             name,
                             {}};
    }
    PictureReader& pictures = context.images.pictures();
    if (const auto* bytes = std::get_if<SourceBytes>(&source))
        return pictures.look(view_of(*bytes), look);
    if (const auto* id = std::get_if<ImageId>(&source))
        return context.images.stored_picture(*id, look.kinds, look.autocrop);
    if (const auto* signature = std::get_if<image::Signature>(&source))
        return QueryPicture{{{signature->kind, {*signature}}}, {}};
    if (const auto* url = std::get_if<SourceUrl>(&source)) {
        const auto bytes = fetch_picture(context, *url);
        if (!bytes) return bytes.error();
        return pictures.look(view_of(bytes.value()), look);
    }
    const image::Raster painted =
        image::rasterize(std::get<image::StrokePicture>(source));
    const ImageView view = painted.view();
    return look_at(view, view.width, view.height, look);
}

// Why a match is as near as it is, as JSON; empty if it is gone since it was found.
Result<std::string> explanation_of(const Context& context,
                                   ImageId id,
                                   const PlannedWay& way,
                                   const image::Profile& profile) {
    const auto target = context.images.signature(id, way.variant);
    if (!target && target.error().code == ErrorCode::kNotFound) return std::string();
    if (!target) return target.error();
    Result<json> explanation =
        explanation_json(way.signature, target.value(), profile, way.query.m);
    if (!explanation) return explanation.error();
    (*explanation)["variant"] = way.variant;
    return http::to_text(explanation.value());
}

// What was asked for is there: images, frames, or both.
struct Found {
    std::optional<SearchAnswer> images;
    std::optional<FrameMatches> frames;
};

Result<Found> search(const Context& context,
                     const QueryPicture& picture,
                     const QueryOptions& options) {
    Found found;
    if (options.kind != QueryKind::kFrame) {
        auto images = context.images.search(picture, options.search);
        if (!images) return images.error();
        found.images = *std::move(images);
    }
    if (options.kind != QueryKind::kImage) {
        auto frames =
            context.frames.search(picture, options.search.plan, options.search.limit);
        if (!frames) return frames.error();
        found.frames = *std::move(frames);
    }
    return found;
}

const SearchPlan& plan_of(const Found& found) {
    return found.images ? found.images->plan : found.frames->plan;
}

std::int64_t searched(const Found& found) {
    return (found.images ? found.images->found.searched : 0) +
           (found.frames ? found.frames->searched : 0);
}

std::chrono::nanoseconds ranking(const Found& found) {
    return (found.images ? found.images->found.ranking : std::chrono::nanoseconds{}) +
           (found.frames ? found.frames->ranking : std::chrono::nanoseconds{});
}

// The list of matches as JSON, best first; an image before a frame as near.
Result<std::string> matches_text(const Context& context,
                                 const Found& answer,
                                 const QueryOptions& options) {
    static const std::vector<FoundImage> no_images;
    static const std::vector<FoundFrame> no_frames;
    const auto& images = answer.images ? answer.images->found.images : no_images;
    const auto& frames = answer.frames ? answer.frames->frames : no_frames;
    const image::Profile& profile = options.search.plan.profiles.front();
    std::string matches = "[";
    int rank = 0;
    std::size_t next_image = 0;
    std::size_t next_frame = 0;
    while (rank < options.search.limit &&
           (next_image < images.size() || next_frame < frames.size())) {
        const bool is_image =
            next_image < images.size() &&
            (next_frame == frames.size() ||
             images[next_image].match.distance <= frames[next_frame].match.distance);
        if (!is_image) {
            if (rank > 0) matches += ',';
            const FoundFrame& frame = frames[next_frame++];
            append_frame_match(
                frame, answer.frames->plan.ways()[frame.match.way], ++rank, matches);
            continue;
        }
        const FoundImage& found = images[next_image++];
        const PlannedWay& way = answer.images->plan.ways()[found.match.way];
        Result<std::string> explanation = std::string();
        if (options.explain)
            explanation = explanation_of(context, found.image.id, way, profile);
        if (!explanation) return explanation;
        if (rank > 0) matches += ',';
        append_match(found, way, profile, ++rank, explanation.value(), matches);
    }
    return matches + ']';
}

json query_json(const SearchPlan& plan, const QueryOptions& options) {
    // The first way asks for the picture as it is.
    const image::Signature& signature = plan.ways().front().signature;
    const std::vector<image::Profile>& profiles = options.search.plan.profiles;
    json query{{"profile", profiles.front().name},
               {"m", plan.m()},
               {"signature", image::signature_to_text(signature)},
               {"low_information", signature.low_information}};
    if (!options.search.plan.combine) return query;
    json names = json::array();
    for (const image::Profile& profile : profiles) names.push_back(profile.name);
    query["combine"] = std::move(names);
    query["combine_by"] =
        options.search.plan.combine_by == image::CombineBy::kWorst ? "worst" : "mean";
    return query;
}

// What one query is told, and what of it took how long.
struct Answer {
    std::string reply;                   // JSON
    std::chrono::nanoseconds ranking{};  // the indexes
    std::chrono::nanoseconds looking{};  // from the source to its signatures
    std::chrono::nanoseconds writing{};  // the reply
};

Outcome<Answer> answer(const Context& context,
                       Inputs& inputs,
                       std::optional<QuerySource> source) {
    const Clock::time_point start = Clock::now();
    const QueryOptions options = read_query_options(context, inputs);
    if (const auto problem = inputs.refused()) return *problem;
    // Before the picture is decoded for nothing.
    if (!context.images.ready())
        return Error{ErrorCode::kUnavailable, "the collection is still being loaded"};
    const Clock::time_point look = Clock::now();
    auto picture = picture_of(context, *source, options.look);
    if (!picture) return picture.problem();
    const auto looking = Clock::now() - look;
    const auto found = search(context, *picture, options);
    if (!found) return found.error();

    const Clock::time_point write = Clock::now();
    const auto matches = matches_text(context, *found, options);
    if (!matches) return matches.error();
    const std::chrono::duration<double, std::milli> took = Clock::now() - start;
    std::string reply;
    JsonObject members(reply);
    members.json("matches", matches.value())
        .integer("searched", searched(*found))
        .number("took_ms", took.count())
        .json("query", http::to_text(query_json(plan_of(*found), options)));
    if (options.seq) members.json("seq", http::to_text(*options.seq));
    members.end();
    return Answer{std::move(reply), ranking(*found), looking, Clock::now() - write};
}

http::Response fresh(std::string reply) {
    http::Response response = http::json_text_response(200, std::move(reply));
    response.headers["Cache-Control"] = "no-store";
    return response;
}

Reply respond(Outcome<Answer> answer) {
    if (!answer) return answer.problem();
    http::Response response = fresh(std::move(answer->reply));
    // The rest of took_ms is the rows of the matches.
    response.headers["Server-Timing"] = server_timing({{"search", answer->ranking},
                                                       {"picture", answer->looking},
                                                       {"reply", answer->writing}});
    return response;
}

constexpr std::size_t kMaxBatch = 100;

Outcome<Answer> answer_object(const Context& context, json query) {
    auto inputs = Inputs::of_object(std::move(query));
    if (!inputs) return inputs.problem();
    return answer(context, *inputs, read_query_source(*inputs));
}

}  // namespace

http::Cost cost_of_query(const http::Request& request) {
    constexpr std::size_t kShort = 16'384;  // twenty times a signature
    for (const auto& [name, value] : request.query)
        if (name == "url") return http::Cost::kCostly;
    if (request.body.empty()) return http::Cost::kCheap;
    if (request.body.size() > kShort ||
        !request.header("Content-Type").starts_with("application/json"))
        return http::Cost::kCostly;
    // A backslash could spell any of the names.
    for (const std::string_view sign : {"\"image\"", "\"strokes\"", "\"url\"", "\\"})
        if (request.body.find(sign) != std::string::npos) return http::Cost::kCostly;
    return http::Cost::kCheap;
}

Reply post_query(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    return respond(answer(context, *inputs, read_query_source(*inputs)));
}

Reply get_query(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    return respond(answer(context, *inputs, read_query_source(*inputs)));
}

Reply post_query_batch(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    std::optional<json> queries = inputs->member("queries");
    if (!queries) {
        inputs->refuse("queries", "is missing: send {\"queries\": [...]}");
    } else if (!queries->is_array() || queries->empty() || queries->size() > kMaxBatch) {
        inputs->refuse("queries",
                       "is not a list of 1 to " + std::to_string(kMaxBatch) + " queries");
    }
    if (const auto problem = inputs->refused()) return *problem;
    std::string results = "[";
    for (json& query : *queries) {
        // Nobody waits for the rest any more.
        if (request.cancelled.stop_requested()) break;
        Outcome<Answer> result = answer_object(context, std::move(query));
        if (results.size() > 1) results += ',';
        results += result ? result->reply
                          : http::to_text(http::problem_json(result.problem(), request));
    }
    std::string reply;
    JsonObject(reply).json("results", results + ']').end();
    return fresh(std::move(reply));
}

Reply get_similar(const Context& context, const http::Request& request) {
    auto id = image_id_of(request);
    if (!id) return id.problem();
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    return respond(answer(context, *inputs, QuerySource(*id)));
}

}  // namespace haarmony::server
