// GET /video/timeline: where along a video there is detail in time and in space.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_timeline(const Context& context, const http::Request& request);

}  // namespace haarmony::server
