// GET /openapi.json: the description of this interface, built in.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_openapi(const Context& context, const http::Request& request);

}  // namespace haarmony::server
