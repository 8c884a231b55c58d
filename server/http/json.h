// JSON bodies: read strictly, written safely.
//
// Errors  kInvalidArgument saying where: malformed text (line and column), text that is not
//         UTF-8, a number that is not finite (then, and only then, `param` is its place:
//         "points[3][1]"), nesting deeper than kMaxJsonDepth, an object with the same
//         member twice.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "engine/core/result.h"
#include "server/http/message.h"

namespace haarmony::http {

inline constexpr int kMaxJsonDepth = 64;

[[nodiscard]] Result<nlohmann::json> parse_json(const std::string& text);

// application/json; bytes that are not UTF-8 (names of files) are replaced by U+FFFD.
[[nodiscard]] Response json_response(int status, const nlohmann::json& value);
[[nodiscard]] std::string to_text(const nlohmann::json& value);
// Of JSON that is written already.
[[nodiscard]] Response json_text_response(int status, std::string text);

}  // namespace haarmony::http
