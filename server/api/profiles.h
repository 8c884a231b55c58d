// Profiles: how pictures are compared. The built-in ones can be read, the others written.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// All of them, the built-in ones first.
[[nodiscard]] Reply list_profiles(const Context& context, const http::Request& request);
[[nodiscard]] Reply get_profile(const Context& context, const http::Request& request);
// 201 for a new name, 200 for one that had a profile. What the body leaves out is that of
// the profile "base"; without it, of the one that is replaced, or else of "painted". Where
// stored pictures lack its kind of signature, "reindex_job" is the job that makes them.
[[nodiscard]] Reply put_profile(const Context& context, const http::Request& request);
[[nodiscard]] Reply delete_profile(const Context& context, const http::Request& request);

}  // namespace haarmony::server
