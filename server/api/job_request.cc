#include "server/api/job_request.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "ingest/key_frames.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 4> kTypes{"ingest",
                                                 "reindex",
                                                 "find_duplicates",
                                                 "snapshot"};
constexpr std::array<std::string_view, 5> kColorSpaces{"yiq", "rgb", "hsv", "lab", "luv"};
constexpr std::array<std::string_view, 2> kDecompositions{"standard", "nonstandard"};
constexpr std::size_t kMaxPaths = 1000;

json read_reindex(const Context& context, Inputs& inputs) {
    json request = json::object();
    if (const auto name = inputs.text("profile")) {
        const auto profile = context.images.profile(*name);
        if (!profile && profile.error().code == ErrorCode::kNotFound) {
            inputs.refuse(http::Problem{400,
                                        "unknown_profile",
                                        "there is no profile '" + *name + "'",
                                        "profile",
                                        {}});
        } else if (!profile) {
            inputs.refuse(http::problem_of(profile.error()));
        }
        request["profile"] = *name;
    }
    if (const auto space = inputs.one_of("color_space", kColorSpaces))
        request["color_space"] = *space;
    if (const auto decomposition = inputs.one_of("decomposition", kDecompositions))
        request["decomposition"] = *decomposition;
    if (inputs.has("profile") &&
        (inputs.has("color_space") || inputs.has("decomposition")))
        inputs.refuse("profile", "names the kind already; leave out the kind or it");
    if (const auto all = inputs.boolean("all")) request["all"] = *all;
    return request;
}

json read_find_duplicates(Inputs& inputs) {
    json request = json::object();
    if (const auto least = inputs.number("min_similarity", 0, 1))
        request["min_similarity"] = *least;
    return request;
}

json read_ingest(const Context& context, Inputs& inputs) {
    const auto paths = inputs.strings("paths");
    if (!paths || paths->empty() || paths->size() > kMaxPaths) {
        inputs.refuse(
            "paths",
            "has to name 1 to " + std::to_string(kMaxPaths) + " files or folders");
        return {};
    }
    for (const std::string& path : *paths) {
        const Result<std::string> real = context.media_roots.locate_path(path);
        if (real) continue;
        http::Problem problem = http::problem_of(real.error());
        problem.param = "paths";
        inputs.refuse(std::move(problem));
    }
    json request{{"paths", *paths}};
    if (const auto videos = inputs.boolean("videos")) request["videos"] = *videos;
    if (const auto most =
            inputs.integer("max_key_frames", 1, ingest::kLargestMostKeyFrames))
        request["max_key_frames"] = *most;
    return request;
}

}  // namespace

JobRequest read_job_request(const Context& context, Inputs& inputs) {
    const auto type = inputs.one_of("type", kTypes);
    if (!inputs.has("type")) inputs.refuse("type", "is missing");
    if (!type) return {};
    json request = json::object();
    if (*type == "ingest") request = read_ingest(context, inputs);
    if (*type == "reindex") request = read_reindex(context, inputs);
    if (*type == "find_duplicates") request = read_find_duplicates(inputs);
    return {*type,
            request.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

}  // namespace haarmony::server
