// Finding pictures: POST /query, GET /query, POST /query/batch and GET /images/{id}/similar.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"
#include "server/http/message.h"
#include "server/http/router.h"

namespace haarmony::server {

// Costly is what decodes, fetches or paints; a search by id or signature is cheap and does
// not wait behind it. Looks at the text of a short JSON body; in doubt a query is costly.
[[nodiscard]] http::Cost cost_of_query(const http::Request& request);

[[nodiscard]] Reply post_query(const Context& context, const http::Request& request);
// The linkable form: everything in the address.
[[nodiscard]] Reply get_query(const Context& context, const http::Request& request);
// At most 100 queries, answered in order; one that fails is a problem in its place.
[[nodiscard]] Reply post_query_batch(const Context& context,
                                     const http::Request& request);
[[nodiscard]] Reply get_similar(const Context& context, const http::Request& request);

}  // namespace haarmony::server
