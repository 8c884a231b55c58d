// GET /videos/{id}/export: a video as a file that others read.
//
// mrv is the video's own file, with ranges and a strong ETag. The others are made while they
// are sent, from one time level and one space level: a client that leaves ends the work.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply get_export(const Context& context, const http::Request& request);

}  // namespace haarmony::server
