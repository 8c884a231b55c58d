#include "server/http/problem.h"

#include <nlohmann/json.hpp>

#include "server/http/target.h"

namespace haarmony::http {
namespace {

constexpr std::string_view kRetryAfterSeconds = "1";

// The members of Error that a client may see, with the status and the name of its code.
Problem visible(int status, std::string_view code, const Error& error) {
    return Problem{.status = status,
                   .code = std::string(code),
                   .detail = error.message,
                   .param = error.param,
                   .headers = {}};
}

}  // namespace

Problem internal_problem() {
    return Problem{.status = 500,
                   .code = "internal",
                   .detail = "The server could not answer; its log says why.",
                   .param = {},
                   .headers = {}};
}

Problem problem_of(const Error& error) {
    switch (error.code) {
        case ErrorCode::kInvalidArgument:
            return visible(400, "invalid_argument", error);
        case ErrorCode::kForbidden:
            return visible(403, "forbidden", error);
        case ErrorCode::kNotFound:
            return visible(404, "not_found", error);
        case ErrorCode::kConflict:
            return visible(409, "conflict", error);
        case ErrorCode::kTooLarge:
            return visible(413, "too_large", error);
        case ErrorCode::kUnsupportedFormat:
            return visible(415, "unsupported_format", error);
        case ErrorCode::kUndecodable:
            return visible(422, "undecodable", error);
        case ErrorCode::kUnavailable: {
            Problem problem = visible(503, "unavailable", error);
            problem.headers["Retry-After"] = kRetryAfterSeconds;
            return problem;
        }
        case ErrorCode::kNotADatabase:
        case ErrorCode::kNewerVersion:
        case ErrorCode::kIo:
            break;
    }
    return internal_problem();
}

namespace {

nlohmann::ordered_json members_of(const Problem& problem, const Request& request) {
    nlohmann::ordered_json members;
    members["type"] = "about:blank";
    members["title"] = reason_phrase(problem.status);
    members["status"] = problem.status;
    members["detail"] = problem.detail;
    members["instance"] = encode_path(request.path);
    members["code"] = problem.code;
    if (!problem.param.empty()) members["param"] = problem.param;
    members["request_id"] = request.request_id;
    return members;
}

}  // namespace

nlohmann::json problem_json(const Problem& problem, const Request& request) {
    return members_of(problem, request);
}

Response to_response(const Problem& problem, const Request& request) {
    Response response{.status = problem.status, .headers = problem.headers, .body = {}};
    response.headers["Content-Type"] = "application/problem+json";
    response.headers["Cache-Control"] = "no-store";
    // Details repeat what clients sent, so they may carry bytes that are not UTF-8.
    response.body = members_of(problem, request)
                        .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) +
                    "\n";
    return response;
}

std::string_view reason_phrase(int status) {
    switch (status) {
        case 200:
            return "OK";
        case 201:
            return "Created";
        case 202:
            return "Accepted";
        case 204:
            return "No Content";
        case 206:
            return "Partial Content";
        case 301:
            return "Moved Permanently";
        case 302:
            return "Found";
        case 303:
            return "See Other";
        case 304:
            return "Not Modified";
        case 307:
            return "Temporary Redirect";
        case 308:
            return "Permanent Redirect";
        case 400:
            return "Bad Request";
        case 401:
            return "Unauthorized";
        case 403:
            return "Forbidden";
        case 404:
            return "Not Found";
        case 405:
            return "Method Not Allowed";
        case 406:
            return "Not Acceptable";
        case 408:
            return "Request Timeout";
        case 409:
            return "Conflict";
        case 411:
            return "Length Required";
        case 412:
            return "Precondition Failed";
        case 413:
            return "Content Too Large";
        case 414:
            return "URI Too Long";
        case 415:
            return "Unsupported Media Type";
        case 416:
            return "Range Not Satisfiable";
        case 417:
            return "Expectation Failed";
        case 422:
            return "Unprocessable Content";
        case 429:
            return "Too Many Requests";
        case 431:
            return "Request Header Fields Too Large";
        case 500:
            return "Internal Server Error";
        case 501:
            return "Not Implemented";
        case 503:
            return "Service Unavailable";
        case 505:
            return "HTTP Version Not Supported";
        default:
            return "Unknown";
    }
}

}  // namespace haarmony::http
