// Multiresolution curves over the REST interface: nothing is stored, a curve comes in and
// another one goes out. What is stored is in curve_library.h.
//
// Threads const-thread-safe.
// Source  the dissertation's chapter 3.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"
#include "server/http/router.h"

namespace haarmony::server {

// POST /curve/decompose, /curve/reconstruct, /curve/smooth (curve_levels.cc)
[[nodiscard]] Reply post_decompose(const Context& context, const http::Request& request);
[[nodiscard]] Reply post_reconstruct(const Context& context,
                                     const http::Request& request);
[[nodiscard]] Reply post_smooth(const Context& context, const http::Request& request);
// POST /curve/edit
[[nodiscard]] Reply post_curve_edit(const Context& context, const http::Request& request);
// POST /curve/character
[[nodiscard]] Reply post_character(const Context& context, const http::Request& request);
// POST /curve/fit
[[nodiscard]] Reply post_fit(const Context& context, const http::Request& request);
// POST /curve/approximate
[[nodiscard]] Reply post_approximate(const Context& context,
                                     const http::Request& request);
// POST /curve/evaluate
[[nodiscard]] Reply post_evaluate(const Context& context, const http::Request& request);

// Cheap as long as the body is short.
[[nodiscard]] http::Cost cost_of_curve(const http::Request& request);

}  // namespace haarmony::server
