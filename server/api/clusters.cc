#include "server/api/clusters.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/api/query_options.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kMaxClusters = 100;
constexpr int kMaxMembers = 1000;

OverviewOptions read_options(const Context& context, Inputs& inputs) {
    OverviewOptions options;
    if (const auto count = inputs.integer("count", 1, kMaxClusters))
        options.count = static_cast<int>(*count);
    if (const auto seed =
            inputs.integer("seed", 0, std::numeric_limits<std::int64_t>::max()))
        options.seed = static_cast<std::uint64_t>(*seed);
    if (const auto members = inputs.integer("members", 0, kMaxMembers))
        options.members = static_cast<int>(*members);
    options.filter = read_filter(inputs);
    const std::string name = inputs.text("profile").value_or("painted");
    Result<image::Profile> profile = context.images.profile(name);
    if (profile) {
        options.profile = std::move(profile).value();
    } else if (profile.error().code == ErrorCode::kNotFound) {
        inputs.refuse(http::Problem{
            400, "unknown_profile", "there is no profile '" + name + "'", "profile", {}});
    } else {
        inputs.refuse(http::problem_of(profile.error()));
    }
    return options;
}

json cluster_json(const OverviewCluster& cluster) {
    json members = json::array();
    for (const schema::Image& image : cluster.members)
        members.push_back(image_json(image));
    return {{"representative", image_json(cluster.representative)},
            {"size", cluster.size},
            {"low_information", cluster.low_information},
            {"members", std::move(members)}};
}

}  // namespace

Reply get_clusters(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const OverviewOptions options = read_options(context, *inputs);
    if (const auto problem = inputs->refused()) return *problem;
    const auto overview = context.clusters.make(options);
    if (!overview) return overview.error();

    json clusters = json::array();
    for (const OverviewCluster& cluster : overview->clusters)
        clusters.push_back(cluster_json(cluster));
    const std::size_t count = clusters.size();
    http::Response response = http::json_response(200,
                                                  {{"clusters", std::move(clusters)},
                                                   {"total_cost", overview->cost},
                                                   {"count", count},
                                                   {"seed", options.seed},
                                                   {"profile", options.profile.name},
                                                   {"searched", overview->searched}});
    response.headers["Cache-Control"] = "no-store";
    return response;
}

}  // namespace haarmony::server
