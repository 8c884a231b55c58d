// The characters and strokes that have names.
//
// Threads const-thread-safe.
// Source  sec. 3.4.2 [the curve character library], sec. 6.3 [handwriting].
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// GET /curve/characters with ?limit= (1..1000, default 100) and ?cursor=, and GET, PUT, DELETE /curve/characters/{name}
[[nodiscard]] Reply list_characters(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_character(const Context& context, const http::Request& request);
[[nodiscard]] Reply put_character(const Context& context, const http::Request& request);
[[nodiscard]] Reply delete_character(const Context& context,
                                     const http::Request& request);
// POST /curve/match
[[nodiscard]] Reply post_match(const Context& context, const http::Request& request);
// GET /curve/strokes likewise, and GET, PUT, DELETE /curve/strokes/{name}
[[nodiscard]] Reply list_strokes(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_stroke(const Context& context, const http::Request& request);
[[nodiscard]] Reply put_stroke(const Context& context, const http::Request& request);
[[nodiscard]] Reply delete_stroke(const Context& context, const http::Request& request);

}  // namespace haarmony::server
