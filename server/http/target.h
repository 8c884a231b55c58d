// The request target, split and percent-decoded (RFC 9112 section 3.2, RFC 3986).
//
// Shape   origin form "/path?query", absolute form "http://host/path?query", or "*".
//         In the query '+' is a space; a name without '=' has an empty value.
// Errors  kInvalidArgument naming the target: a '%' without two hexadecimal digits, a byte
//         sequence that is not UTF-8, a NUL, and in the path an encoded '/', which could not
//         be told from a separator.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"

namespace haarmony::http {

struct Target {
    std::string path;  // decoded, starts with '/'; "*" for the server as a whole
    std::vector<std::pair<std::string, std::string>> query;  // decoded, in order
};

[[nodiscard]] Result<Target> parse_target(std::string_view target);

// The path as it stands in an address: everything but unreserved characters, '/' and the
// few others that a path may carry is percent-encoded.
[[nodiscard]] std::string encode_path(std::string_view path);

// Well-formed UTF-8: no overlong form, no surrogate, nothing above U+10FFFF.
[[nodiscard]] bool is_utf8(std::string_view bytes);

}  // namespace haarmony::http
