// What a stored picture looks like: its thumbnail and the file it came from.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_thumbnail(const Context& context, const http::Request& request);

// Only a file below a media root, links resolved: 403 for a file elsewhere, 404 for a
// picture without a file and for a file that is gone or is no picture any more.
[[nodiscard]] Reply get_original(const Context& context, const http::Request& request);

}  // namespace haarmony::server
