// Pictures that are stored more than once.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// ?min_similarity= (0..1), ?level= (exact, near, similar: that or better), ?limit= (1..1000,
// default 100), ?cursor=.
[[nodiscard]] Reply list_duplicates(const Context& context, const http::Request& request);
// {"ids": [a, b]}: the two are no duplicates. 204.
[[nodiscard]] Reply post_ignored_duplicates(const Context& context,
                                            const http::Request& request);

}  // namespace haarmony::server
