// What a session knows of one request and its answer.
//   session.h -> [session_exchange.h] -> session.cc, session_send.cc
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "server/http/problem.h"
#include "server/http/session.h"

namespace haarmony::http {

// `content_length` is that of a stream whose length is known.
struct Session::Exchange {
    explicit Exchange(RequestParser& from) : parser(from) {}

    RequestParser& parser;
    std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
    Response response;
    std::optional<std::uint64_t> content_length;
    Cost cost = Cost::kCheap;
    bool answered = false;  // without a handler
    bool close = false;     // whatever the client wants

    Request& request() { return parser.request(); }
    [[nodiscard]] const Request& request() const { return parser.request(); }
    void refuse(const Problem& problem) { response = to_response(problem, request()); }
};

}  // namespace haarmony::http
