// Reads the requests of one connection, one after another, each part within its deadline.
//
//   connection, request_parser -> [request_reader] -> session
//
// Errors   what a client does wrong ends in the parser, as kBad; a client that goes is told
//          by the returned value.
// Threads  the connection's strand.
#pragma once

#include <boost/asio/awaitable.hpp>
#include <chrono>
#include <cstdint>

#include "server/http/connection.h"
#include "server/http/listener.h"
#include "server/http/request_parser.h"

namespace haarmony::http {

class RequestReader {
  public:
    // Both outlive the reader.
    RequestReader(Connection& connection, const ListenerOptions& options);

    // Leaves State::kHead. False if the connection ended before there was a request to
    // answer; between requests that is no error.
    [[nodiscard]] boost::asio::awaitable<bool> read_head(
        RequestParser& parser,
        std::chrono::milliseconds deadline);

    // To kDone or kBad, after seeing to what the head says of the body and, where the client
    // waits for it, saying "100 Continue". False if the client went in the middle.
    // Requires: State::kHeadDone.
    [[nodiscard]] boost::asio::awaitable<bool> read_body(RequestParser& parser,
                                                         std::uint64_t limit);

  private:
    Connection& connection_;
    const ListenerOptions& options_;
    bool first_ = true;  // no request has been read yet
};

}  // namespace haarmony::http
