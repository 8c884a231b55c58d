// One picture of a video: any time, any level, any region.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"
#include "server/http/router.h"

namespace haarmony::server {

[[nodiscard]] Reply get_frame(const Context& context, const http::Request& request);
[[nodiscard]] Reply post_frame(const Context& context, const http::Request& request);

// Cheap where the picture is kept, encoded, under this very request.
[[nodiscard]] http::Cost cost_of_frame(const Context& context,
                                       const http::Request& request);

}  // namespace haarmony::server
