#include "server/api/query.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "engine/image/signature_codec.h"
#include "server/api/image_id.h"
#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/api/query_options.h"
#include "server/api/query_source.h"
#include "server/api/url_source.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

Outcome<image::Signature> signature_of(const Context& context,
                                       const QuerySource& source,
                                       Mask mask) {
    PictureReader& pictures = context.images.pictures();
    if (const auto* bytes = std::get_if<SourceBytes>(&source))
        return pictures.signature(view_of(*bytes), mask);
    if (const auto* id = std::get_if<ImageId>(&source))
        return context.images.signature(*id);
    if (const auto* signature = std::get_if<image::Signature>(&source)) return *signature;
    if (const auto* url = std::get_if<SourceUrl>(&source)) {
        const auto bytes = fetch_picture(context, *url);
        if (!bytes) return bytes.error();
        return pictures.signature(view_of(bytes.value()), mask);
    }
    return signature_of_pixels(
        image::rasterize(std::get<image::StrokePicture>(source)).view(), mask);
}

json answer_json(const SearchAnswer& answer,
                 const image::Signature& signature,
                 const QueryOptions& options,
                 Clock::duration took) {
    json matches = json::array();
    for (const FoundImage& found : answer.found.images)
        matches.push_back(match_json(found, static_cast<int>(matches.size()) + 1));
    json reply{{"matches", std::move(matches)},
               {"searched", answer.found.searched},
               {"took_ms", std::chrono::duration<double, std::milli>(took).count()},
               {"query",
                {{"profile", options.search.profile.name},
                 {"m", answer.m},
                 {"signature", image::signature_to_text(signature)},
                 {"low_information", signature.low_information}}}};
    if (options.seq) reply["seq"] = *options.seq;
    return reply;
}

Reply answer(const Context& context, Inputs& inputs, std::optional<QuerySource> source) {
    const Clock::time_point start = Clock::now();
    const QueryOptions options = read_query_options(inputs);
    if (const auto problem = inputs.refused()) return *problem;
    // Before the picture is decoded for nothing.
    if (!context.images.ready())
        return Error{ErrorCode::kUnavailable, "the collection is still being loaded"};
    auto signature = signature_of(context, *source, options.mask);
    if (!signature) return signature.problem();
    const auto found = context.images.search(*signature, options.search);
    if (!found) return found.error();
    http::Response response = http::json_response(
        200, answer_json(found.value(), *signature, options, Clock::now() - start));
    response.headers["Cache-Control"] = "no-store";
    return response;
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
    return answer(context, *inputs, read_query_source(*inputs));
}

Reply get_query(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    return answer(context, *inputs, read_query_source(*inputs));
}

Reply get_similar(const Context& context, const http::Request& request) {
    auto id = image_id_of(request);
    if (!id) return id.problem();
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    return answer(context, *inputs, QuerySource(*id));
}

}  // namespace haarmony::server
