// Storing pictures: POST /images.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// Always a new row; 201 with {"id"} and Location.
[[nodiscard]] Reply post_image(const Context& context, const http::Request& request);

}  // namespace haarmony::server
