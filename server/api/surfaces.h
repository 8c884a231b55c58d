// Bicubic surfaces over the REST interface: a grid comes in and another one goes out.
//
// Threads const-thread-safe.
// Source  the dissertation's sec. 6.3, "Surfaces".
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// POST /surface/decompose, /surface/reconstruct, /surface/edit
[[nodiscard]] Reply post_surface_decompose(const Context& context,
                                           const http::Request& request);
[[nodiscard]] Reply post_surface_reconstruct(const Context& context,
                                             const http::Request& request);
[[nodiscard]] Reply post_surface_edit(const Context& context,
                                      const http::Request& request);

}  // namespace haarmony::server
