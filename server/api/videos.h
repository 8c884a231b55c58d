// The stored videos: listed, described, removed.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

[[nodiscard]] Reply list_videos(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_video(const Context& context, const http::Request& request);
[[nodiscard]] Reply delete_video(const Context& context, const http::Request& request);

}  // namespace haarmony::server
