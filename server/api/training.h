// Training: the weights of a profile from pairs that were logged or are sent.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// {"base": "painted", "pairs": [...], "kind": "painted", "replace_worse": false, "seed": 1},
// all optional; without pairs, the newest that were logged under the kind. 422 "untrainable"
// where the pairs are too few or teach nothing.
[[nodiscard]] Reply post_training(const Context& context, const http::Request& request);

}  // namespace haarmony::server
