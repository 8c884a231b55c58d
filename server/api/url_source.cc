#include "server/api/url_source.h"

#include <utility>
#include <vector>

#include "ingest/fetch.h"

namespace haarmony::server {

Result<SourceBytes> fetch_picture(const Context& context, const SourceUrl& source) {
    if (!context.allow_url_fetch)
        return Error{ErrorCode::kForbidden,
                     "this server fetches no addresses (--allow-url-fetch)",
                     "url"};
    ingest::FetchOptions options;
    options.max_bytes = static_cast<std::int64_t>(context.max_body);
    const Result<std::vector<std::uint8_t>> bytes = ingest::fetch(source.url, options);
    if (bytes) return SourceBytes(std::string(bytes->begin(), bytes->end()));
    Error error = bytes.error();
    error.param = "url";
    // The address is what is wrong, not the path of this request.
    if (error.code == ErrorCode::kNotFound) error.code = ErrorCode::kInvalidArgument;
    return error;
}

}  // namespace haarmony::server
