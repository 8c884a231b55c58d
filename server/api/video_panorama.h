// GET /video/panorama: the view out of a cylinder whose inside is a periodic clip.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_panorama(const Context& context, const http::Request& request);

}  // namespace haarmony::server
