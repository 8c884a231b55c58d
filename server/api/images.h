// Stored pictures: the list, one row, its signature, and its end.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// ?limit= (1..1000, default 100), ?cursor=, ?tags= (all must match).
[[nodiscard]] Reply list_images(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_image(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_signature(const Context& context, const http::Request& request);
[[nodiscard]] Reply delete_image(const Context& context, const http::Request& request);

}  // namespace haarmony::server
