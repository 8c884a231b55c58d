#include "server/api/images.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/api/content_tag.h"
#include "server/api/image_id.h"
#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/api/query_options.h"
#include "server/api/signature_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

using nlohmann::json;

constexpr int kMaxListed = 1000;

schema::ListOptions read_list_options(Inputs& inputs) {
    schema::ListOptions options;
    if (const auto limit = inputs.integer("limit", 1, kMaxListed))
        options.limit = static_cast<int>(*limit);
    if (const auto cursor =
            inputs.integer("cursor", 1, std::numeric_limits<std::int64_t>::max()))
        options.after = ImageId{*cursor};
    schema::ImageFilter filter = read_filter(inputs);
    options.tags = std::move(filter.tags);
    options.text = std::move(filter.text);
    return options;
}

}  // namespace

Reply list_images(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    schema::ListOptions options = read_list_options(*inputs);
    if (const auto problem = inputs->refused()) return *problem;

    // One more than asked for tells whether there is a next page.
    const auto limit = static_cast<std::size_t>(options.limit++);
    auto images = context.images.list(options);
    if (!images) return images.error();
    json items = json::array();
    json next_cursor;
    for (const schema::Image& image : images.value()) {
        if (items.size() == limit) {
            next_cursor = std::to_string(items.back()["id"].get<std::int64_t>());
            break;
        }
        items.push_back(image_json(image));
    }
    http::Response response = http::json_response(
        200, {{"items", std::move(items)}, {"next_cursor", std::move(next_cursor)}});
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = content_tag(std::get<std::string>(response.body));
    return response;
}

Reply get_image(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = image_id_of(request);
    if (!id) return id.problem();
    const auto image = context.images.get(*id);
    if (!image) return image.error();
    http::Response response = http::json_response(200, image_json(image.value()));
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = etag_of(image.value());
    return response;
}

Reply get_signature(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = image_id_of(request);
    if (!id) return id.problem();
    const auto signature = context.images.signature(*id);
    if (!signature) return signature.error();
    http::Response response = http::json_response(200, signature_json(signature.value()));
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = content_tag(std::get<std::string>(response.body));
    return response;
}

Reply delete_image(const Context& context, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    auto id = image_id_of(request);
    if (!id) return id.problem();
    const auto removed = context.images.remove(*id);
    if (!removed) return removed.error();
    return http::Response{204, {}, std::string()};
}

}  // namespace haarmony::server
