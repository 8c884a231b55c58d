// How the daemon is: health, readiness, counts, versions.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 200 as long as the process answers.
[[nodiscard]] Reply get_health(const Context& context, const http::Request& request);
// 503 until the collection is loaded.
[[nodiscard]] Reply get_readiness(const Context& context, const http::Request& request);
// Flat numbers.
[[nodiscard]] Reply get_status(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_version(const Context& context, const http::Request& request);

}  // namespace haarmony::server
