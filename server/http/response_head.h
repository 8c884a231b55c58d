// The status line and the headers of an answer, as bytes.
//
// The session's own headers (Content-Length, Transfer-Encoding, Connection, Date, Server,
// X-Request-Id) replace those of the handler; every answer says `nosniff`. A header whose
// name is no token is left out, and control characters in a value become spaces, so that no
// handler can be made to write a second header.
#pragma once

#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/message.h"

namespace haarmony::http {

struct Framing {
    std::optional<std::uint64_t> content_length =
        {};  // absent: chunked, or until the end
    bool chunked = false;
    bool keep_alive = true;
    bool http_1_0 = false;  // of the request
    std::string_view request_id = {};
    std::time_t now = 0;
};

[[nodiscard]] std::string response_head(const Response& response, const Framing& framing);

// 1xx, 204 and 304 never have a body (RFC 9112 section 6.3).
[[nodiscard]] bool may_have_body(int status);

// "Sun, 06 Nov 1994 08:49:37 GMT"
[[nodiscard]] std::string http_date(std::time_t time);

}  // namespace haarmony::http
