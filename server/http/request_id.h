// The name under which a request is found in logs: the client's own, or a new one.
//
// Threads const-safe.
#pragma once

#include <string>
#include <string_view>

namespace haarmony::http {

// 1 to 128 visible ASCII characters: safe in a header, in a log line and in JSON.
[[nodiscard]] bool is_request_id(std::string_view text);

// 16 hexadecimal digits, different for every call of one process and, but for chance,
// of all.
[[nodiscard]] std::string make_request_id();

}  // namespace haarmony::http
