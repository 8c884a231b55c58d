#include "server/api/image_upload.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "server/api/attributes.h"
#include "server/api/image_json.h"
#include "server/api/inputs.h"
#include "server/api/query_source.h"
#include "server/api/url_source.h"
#include "server/http/json.h"

namespace haarmony::server {

Reply post_image(const Context& context, const http::Request& request) {
    auto inputs = Inputs::of_request(request);
    if (!inputs) return inputs.problem();
    auto source = read_picture_source(*inputs);
    GivenAttributes given = read_attributes(*inputs);
    if (const auto problem = inputs->refused()) return *problem;

    ImageAttributes attributes;
    SourceBytes bytes;
    if (const auto* url = std::get_if<SourceUrl>(&*source)) {
        auto fetched = fetch_picture(context, *url);
        if (!fetched) return fetched.error();
        bytes = std::move(fetched).value();
        attributes.uri = url->url;
    } else {
        bytes = std::get<SourceBytes>(std::move(*source));
    }
    if (given.uri) attributes.uri = *std::move(given.uri);
    if (given.tags) attributes.tags = *std::move(given.tags);
    if (given.metadata) attributes.metadata = *std::move(given.metadata);

    const auto id = context.images.add(view_of(bytes), attributes);
    if (!id) return id.error();
    http::Response response = http::json_response(201, {{"id", to_int(id.value())}});
    response.headers["Location"] = image_address(id.value());
    return response;
}

}  // namespace haarmony::server
