#include "server/api/images.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "server/api/content_tag.h"
#include "server/api/image_id.h"
#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/api/list_page.h"
#include "server/api/query_options.h"
#include "server/api/signature_json.h"
#include "server/http/json.h"

namespace haarmony::server {
namespace {

schema::ListOptions read_list_options(const ListPlace& place, Inputs& inputs) {
    schema::ListOptions options;
    options.limit = place.fetched();
    if (place.cursor) options.after = ImageId{*place.cursor};
    schema::ImageFilter filter = read_filter(inputs);
    options.tags = std::move(filter.tags);
    options.text = std::move(filter.text);
    return options;
}

}  // namespace

Reply list_images(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_query(request);
    if (!inputs) return inputs.problem();
    const ListPlace place = ListPlace::read(*inputs);
    const schema::ListOptions options = read_list_options(place, *inputs);
    if (const auto problem = inputs->refused()) return *problem;

    auto images = context.images.list(options);
    if (!images) return images.error();
    http::Response response =
        http::json_response(200, list_page(*images, place, image_json));
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
