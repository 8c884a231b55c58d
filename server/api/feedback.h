// Feedback: pairs of what somebody drew or scanned and the picture that was meant by it,
// logged so that profiles can be trained with them.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 201 {"id"}; 404 for a target that cannot be searched.
[[nodiscard]] Reply post_feedback(const Context& context, const http::Request& request);
// ?limit= (1..1000, default 100), ?cursor=, ?kind=.
[[nodiscard]] Reply list_feedback(const Context& context, const http::Request& request);
[[nodiscard]] Reply delete_feedback(const Context& context, const http::Request& request);
// JSON lines that POST /feedback and haarmony-eval train take; ?kind=. A pair that cannot be
// read any more is left out.
[[nodiscard]] Reply export_feedback(const Context& context, const http::Request& request);

}  // namespace haarmony::server
