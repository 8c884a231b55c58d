#include "server/api/profiles.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "ingest/stored_profile.h"
#include "server/api/content_tag.h"
#include "server/api/image_id.h"
#include "server/api/inputs.h"
#include "server/api/profile_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 2> kBuiltIn{"painted", "scanned"};

// By its name in the database, so that a kind that the engine does not know has none.
json described(const Context& context,
               const schema::StoredProfile& profile,
               bool built_in) {
    const std::string variant = profile.color_space + "-" + profile.decomposition;
    return profile_json(profile, built_in, context.images.searchable(variant));
}

http::Response tagged(const json& value) {
    http::Response response = http::json_response(200, value);
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = content_tag(std::get<std::string>(response.body));
    return response;
}

const std::string& name_of(const http::Request& request) {
    return request.path_parameters.at("name");
}

// What the members of the request fill up; a problem in `inputs` where "base" is unknown.
Result<image::Profile> defaults_of(const Context& context,
                                   Inputs& inputs,
                                   const std::string& name) {
    if (const std::optional<std::string> base = inputs.text("base")) {
        auto profile = context.images.profile(*base);
        if (profile || profile.error().code != ErrorCode::kNotFound) return profile;
        inputs.refuse("base", "is no profile");
        return *image::built_in_profile(kBuiltIn.front());
    }
    auto replaced = context.images.profile(name);
    if (replaced || replaced.error().code != ErrorCode::kNotFound) return replaced;
    return *image::built_in_profile(kBuiltIn.front());
}

// The job that gives stored pictures the signatures that the profile compares; nothing where
// all have them. One that waits already is as good as a new one; one that runs has read the
// profile as it was.
Result<std::optional<std::int64_t>> reindex_job(const Context& context,
                                                const image::Profile& profile) {
    constexpr int kLatest = 100;
    const auto lacking = context.images.lacks(profile.kind);
    if (!lacking) return lacking.error();
    if (!lacking.value()) return std::optional<std::int64_t>();
    const std::string request = json{{"profile", profile.name}}.dump();
    const auto jobs = context.jobs.list(kLatest, {});
    if (!jobs) return jobs.error();
    for (const schema::Job& job : jobs.value())
        if (job.type == "reindex" && job.state == schema::JobState::kQueued &&
            job.request == request)
            return std::optional(job.id);
    const auto job = context.jobs.create("reindex", request);
    if (!job) return job.error();
    return std::optional(job->id);
}

}  // namespace

Reply list_profiles(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto stored = context.images.profiles();
    if (!stored) return stored.error();
    json items = json::array();
    for (const std::string_view name : kBuiltIn)
        items.push_back(
            described(context, ingest::to_stored(*image::built_in_profile(name)), true));
    for (const schema::StoredProfile& profile : stored.value())
        items.push_back(described(context, profile, false));
    return tagged({{"items", std::move(items)}});
}

Reply get_profile(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const std::string& name = name_of(request);
    if (const auto profile = image::built_in_profile(name))
        return tagged(described(context, ingest::to_stored(*profile), true));
    const auto stored = context.images.stored_profile(name);
    if (!stored) return stored.error();
    return tagged(described(context, stored.value(), false));
}

Reply put_profile(const Context& context, const http::Request& request) {
    const std::string& name = name_of(request);
    if (auto problem = refuse_name(name)) return *std::move(problem);
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    if (inputs->picture())
        return Error{ErrorCode::kUnsupportedFormat, "a picture is no profile", "file"};
    const auto defaults = defaults_of(context, *inputs, name);
    if (!defaults) return defaults.error();
    const image::Profile profile = read_profile(*inputs, name, defaults.value());
    if (const auto problem = inputs->refused()) return *problem;
    const auto put = context.images.put_profile(profile);
    if (!put) return put.error();

    const auto job = reindex_job(context, profile);
    if (!job) return job.error();
    json reply = described(context, put->profile, false);
    if (*job) reply["reindex_job"] = **job;
    http::Response response = http::json_response(put->created ? 201 : 200, reply);
    response.headers["Cache-Control"] = "no-store";
    if (put->created) response.headers["Location"] = "/profiles/" + name;
    return response;
}

Reply delete_profile(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    const auto removed = context.images.remove_profile(name_of(request));
    if (!removed) return removed.error();
    return http::Response{204, {}, std::string()};
}

}  // namespace haarmony::server
