// Finding pictures: POST /query, GET /query and GET /images/{id}/similar.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"
#include "server/http/message.h"

namespace haarmony::server {

[[nodiscard]] Reply post_query(const Context& context, const http::Request& request);
// The linkable form: everything in the address.
[[nodiscard]] Reply get_query(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_similar(const Context& context, const http::Request& request);

}  // namespace haarmony::server
