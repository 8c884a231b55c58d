// A picture at an address of the net, fetched only with --allow-url-fetch.
//
// Errors  kForbidden without that flag; otherwise as ingest/fetch.h, the param being "url".
#pragma once

#include "engine/core/result.h"
#include "server/api/context.h"
#include "server/api/query_source.h"

namespace haarmony::server {

[[nodiscard]] Result<SourceBytes> fetch_picture(const Context& context,
                                                const SourceUrl& source);

}  // namespace haarmony::server
