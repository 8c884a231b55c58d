#include "server/api/openapi.h"

#include <string>

#include "server/api/content_tag.h"
#include "server/api/image_id.h"
#include "server/embedded.h"

namespace haarmony::server {

Reply get_openapi(const Context& /*context*/, const http::Request& request) {
    if (const auto problem = refuse_parameters(request)) return *problem;
    static const std::string document(embedded_openapi().front().content);
    static const std::string etag = content_tag(document);
    http::Response response;
    response.headers["Content-Type"] = "application/json";
    response.headers["Cache-Control"] = "no-cache";
    response.headers["ETag"] = etag;
    response.body = document;
    return response;
}

}  // namespace haarmony::server
