// An overview of the collection.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// ?count= (1..100, default 12), ?seed= (default 1), ?profile= (default painted), ?members=
// (0..1000, default 12: how many of each are listed), ?text=, ?tags=.
[[nodiscard]] Reply get_clusters(const Context& context, const http::Request& request);

}  // namespace haarmony::server
