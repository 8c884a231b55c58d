// Errors as RFC 9457 application/problem+json, and the only place where an ErrorCode
// becomes an HTTP status.
//
// Shape   {type, title, status, detail, instance, code, param?, request_id}; `code` is
//         stable snake_case; never a backtrace, never a path of the server's disk.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "server/http/message.h"

namespace haarmony::http {

struct Problem {
    int status = 500;
    std::string code;    // "unknown_parameter"
    std::string detail;  // one sentence with the bad value
    std::string param = {};
    Headers headers = {};  // e.g. Allow, Retry-After
};

// A failure of the server itself: a 500 whose text says nothing about its inside.
[[nodiscard]] Problem internal_problem();
[[nodiscard]] Problem problem_of(const Error& error);
// The object alone, for a reply that holds several answers.
[[nodiscard]] nlohmann::json problem_json(const Problem& problem, const Request& request);
[[nodiscard]] Response to_response(const Problem& problem, const Request& request);
[[nodiscard]] std::string_view reason_phrase(int status);

}  // namespace haarmony::http
