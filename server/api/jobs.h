// Long work: queued, looked at, followed and cancelled.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 202 and the job's address.
[[nodiscard]] Reply post_job(const Context& context, const http::Request& request);
// ?limit= (1..1000, default 100), ?cursor=; the newest first.
[[nodiscard]] Reply list_jobs(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_job(const Context& context, const http::Request& request);
// Server-sent events: "progress" with the job whenever it changed, and "end" with what it
// has become, which is the last.
[[nodiscard]] Reply get_job_events(const Context& context, const http::Request& request);
// Cancels: a queued job at once, a running one soon. 409 for a finished one.
[[nodiscard]] Reply delete_job(const Context& context, const http::Request& request);

}  // namespace haarmony::server
