#include "server/http/request_reader.h"

#include <string>
#include <string_view>

#include "server/http/header_value.h"

namespace haarmony::http {
namespace {

namespace net = boost::asio;
using State = RequestParser::State;
using Arrival = Connection::Arrival;

Problem timed_out(std::string_view what) {
    return {.status = 408,
            .code = "request_timeout",
            .detail = "The request's " + std::string(what) + " took too long to arrive."};
}

// Refuses what the head says of the body and we do not do. False if it did.
bool accept_body_headers(RequestParser& parser) {
    const std::string_view coding = parser.request().header("Content-Encoding");
    if (!coding.empty() && !equal_without_case(coding, "identity")) {
        parser.refuse({.status = 415,
                       .code = "unsupported_content_encoding",
                       .detail = "Bodies are taken as they are, not encoded as '" +
                                 std::string(coding) + "'.",
                       .param = "Content-Encoding",
                       .headers = {{"Accept-Encoding", "identity"}}});
        return false;
    }
    const std::string_view expect = parser.request().header("Expect");
    if (!expect.empty() && !equal_without_case(expect, "100-continue")) {
        parser.refuse({.status = 417,
                       .code = "expectation_failed",
                       .detail = "Expect: '" + std::string(expect) + "' is not known.",
                       .param = "Expect"});
        return false;
    }
    return true;
}

}  // namespace

RequestReader::RequestReader(Connection& connection, const ListenerOptions& options)
    : connection_(connection), options_(options) {}

net::awaitable<bool> RequestReader::read_head(RequestParser& parser,
                                              std::chrono::milliseconds deadline) {
    bool begun = !connection_.received().empty();
    connection_.start_read_deadline(first_ || begun ? deadline : options_.idle_deadline);
    connection_.consume(parser.feed(connection_.received()));
    while (parser.state() == State::kHead) {
        const Arrival arrival = co_await connection_.fill();
        if (arrival == Arrival::kEnd) co_return false;
        if (arrival == Arrival::kTimeout) {
            if (!begun) co_return false;
            parser.refuse(timed_out("head"));
            break;
        }
        connection_.consume(parser.feed(connection_.received()));
        const bool goes_on = parser.state() == State::kHead;
        if (goes_on && !begun && !first_) connection_.start_read_deadline(deadline);
        begun = true;
    }
    first_ = false;
    co_return true;
}

net::awaitable<bool> RequestReader::read_body(RequestParser& parser,
                                              std::uint64_t limit) {
    if (!accept_body_headers(parser)) co_return true;
    parser.begin_body(limit);
    const bool wants_word = !parser.request().header("Expect").empty() &&
                            parser.state() == State::kBody && !parser.is_http_1_0() &&
                            connection_.received().empty();
    if (wants_word) {
        const bool told = co_await connection_.write("HTTP/1.1 100 Continue\r\n\r\n",
                                                     options_.write_deadline);
        if (!told) co_return false;
    }
    if (parser.state() != State::kBody) co_return true;
    connection_.start_read_deadline(options_.body_deadline);
    for (;;) {
        connection_.consume(parser.feed(connection_.received()));
        if (parser.state() != State::kBody) co_return true;
        const Arrival arrival = co_await connection_.fill();
        if (arrival == Arrival::kTimeout) parser.refuse(timed_out("body"));
        if (arrival != Arrival::kBytes) co_return arrival == Arrival::kTimeout;
    }
}

}  // namespace haarmony::http
