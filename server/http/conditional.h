// Conditional and range requests (RFC 9110 sections 13 and 14), from what the handler said:
// a response with `ETag` honours If-None-Match; one with `Accept-Ranges: bytes` honours
// Range and If-Range. Only 200s to GET and HEAD are touched.
//
// Shape   several ranges in one request are answered with the whole body, which the RFC
//         leaves to the server; 416 if none of them can be satisfied.
// Threads const-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "server/http/message.h"

namespace haarmony::http {

// Turns a 200 into a 304, a 206 or a 416 where the request asks for it.
void apply_conditions(const Request& request, Response& response);

// Whether the client has the body with this tag already, so that apply_conditions() will
// make a 304 of whatever the handler answers with it.
[[nodiscard]] bool is_unmodified(const Request& request, std::string_view etag);

// The comparisons of RFC 9110 section 8.8.3.2.
[[nodiscard]] bool weakly_equal(std::string_view a, std::string_view b);
[[nodiscard]] bool strongly_equal(std::string_view a, std::string_view b);

// The body's length, or nothing for a ChunkSource.
[[nodiscard]] std::optional<std::uint64_t> body_length(const Response& response);

}  // namespace haarmony::http
