// Compression of text answers for clients that accept it (RFC 9110 section 12.5.3).
//
// JSON, problems, SVG and text of at least kMinCompressed bytes are sent as gzip if the
// client takes gzip at least as gladly as the plain bytes. Such answers vary by
// Accept-Encoding, compressed or not, and a compressed one's ETag is weak: its bytes are not
// those that the tag was made of. Pictures, ranges and streams are left alone.
//
// Threads const-safe.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "server/http/message.h"

namespace haarmony::http {

inline constexpr std::size_t kMinCompressed = 1'024;

// Sets `Vary` where the encoding may differ between clients. If the answer is to be
// compressed: true, with the ETag weakened, so that conditions can be tested first.
[[nodiscard]] bool select_gzip(const Request& request, Response& response);

// Requires: select_gzip() said true, and the body is still the same.
void gzip_body(Response& response);

// Whether a client with this Accept-Encoding prefers gzip to the plain bytes.
[[nodiscard]] bool prefers_gzip(std::string_view accept_encoding);

[[nodiscard]] std::string gzip(std::string_view bytes);

}  // namespace haarmony::http
