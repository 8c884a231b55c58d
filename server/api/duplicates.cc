#include "server/api/duplicates.h"

#include <array>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 3> kLevels{"exact", "near", "similar"};
constexpr int kMaxListed = 1000;

DuplicateQuery read_query(Inputs& inputs) {
    DuplicateQuery query;
    query.least.min_similarity = inputs.number("min_similarity", 0, 1).value_or(0);
    if (const auto level = inputs.one_of("level", kLevels))
        query.least.min_level = image::duplicate_level_from_name(*level).value_or(
            image::DuplicateLevel::kSimilar);
    if (const auto limit = inputs.integer("limit", 1, kMaxListed))
        query.limit = static_cast<int>(*limit);
    if (const auto cursor =
            inputs.integer("cursor", 1, std::numeric_limits<std::int64_t>::max()))
        query.after = ImageId{*cursor};
    return query;
}

json group_json(const FoundGroup& found) {
    json ids = json::array();
    for (const ImageId id : found.group.ids) ids.push_back(to_int(id));
    json images = json::array();
    for (const schema::Image& image : found.images) images.push_back(image_json(image));
    return {{"level", image::duplicate_level_name(found.group.level)},
            {"similarity", found.group.similarity},
            {"ids", std::move(ids)},
            {"images", std::move(images)}};
}

std::optional<ImageId> id_in(const json& value) {
    if (!value.is_number_integer()) return {};
    const auto id = value.get<std::int64_t>();
    if (id < 1) return {};
    return ImageId{id};
}

}  // namespace

Reply list_duplicates(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const DuplicateQuery query = read_query(*inputs);
    if (const auto problem = inputs->refused()) return *problem;
    const auto page = context.duplicates.list(query);
    if (!page) return page.error();
    const auto as_of = context.jobs.last_done("find_duplicates");
    if (!as_of) return as_of.error();

    json items = json::array();
    for (const FoundGroup& found : page->groups) items.push_back(group_json(found));
    json next_cursor;
    if (page->more)
        next_cursor = std::to_string(to_int(page->groups.back().group.ids.front()));
    http::Response response =
        http::json_response(200,
                            {{"items", std::move(items)},
                             {"next_cursor", std::move(next_cursor)},
                             {"as_of", *as_of ? json(**as_of) : json()}});
    response.headers["Cache-Control"] = "no-store";
    return response;
}

Reply post_ignored_duplicates(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    const std::optional<json> ids = inputs->member("ids");
    const bool pair = ids && ids->is_array() && ids->size() == 2;
    const auto one = pair ? id_in((*ids)[0]) : std::nullopt;
    const auto other = pair ? id_in((*ids)[1]) : std::nullopt;
    if (!one || !other || one == other)
        inputs->refuse(http::Problem{
            400, "invalid_argument", "ids has to be two different ids", "ids", {}});
    if (const auto problem = inputs->refused()) return *problem;
    if (const auto ignored = context.duplicates.ignore(*one, *other); !ignored)
        return ignored.error();
    return http::Response{204, {}, std::string()};
}

}  // namespace haarmony::server
