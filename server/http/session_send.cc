// How a session sends an answer: head and body at once, or a stream piece by piece.
#include <array>
#include <cstdio>
#include <ctime>
#include <exception>

#include "server/http/response_head.h"
#include "server/http/session_exchange.h"

namespace haarmony::http {
namespace {

namespace net = boost::asio;
using State = RequestParser::State;

constexpr std::size_t kJoined = 16 * 1024;  // a body up to this goes out with its head

}  // namespace

// Sends head and body. False if the connection cannot be used any more.
net::awaitable<bool> Session::send(Exchange& exchange) {
    Response& response = exchange.response;
    const auto* bytes = std::get_if<std::string>(&response.body);
    const auto* source = std::get_if<ChunkSource>(&response.body);
    if (bytes != nullptr) exchange.content_length = bytes->size();

    const bool has_body =
        may_have_body(response.status) && exchange.request().method != "HEAD";
    exchange.close = exchange.close || ends_after(exchange);
    const bool framed = exchange.content_length.has_value();
    const bool old = !framed && exchange.parser.is_http_1_0();
    if (old && has_body) exchange.close = true;
    std::string head = response_head(response,
                                     {.content_length = exchange.content_length,
                                      .chunked = !framed && !old,
                                      .keep_alive = !exchange.close,
                                      .http_1_0 = exchange.parser.is_http_1_0(),
                                      .request_id = exchange.request().request_id,
                                      .now = std::time(nullptr)});
    const Connection::Milliseconds deadline = service_.options.write_deadline;
    const bool joined = has_body && bytes != nullptr && bytes->size() <= kJoined;
    if (joined) head += *bytes;
    bool sent = co_await connection_->write(head, deadline);
    if (!sent || !has_body || joined) co_return sent;
    if (bytes != nullptr) {
        sent = co_await connection_->write(*bytes, deadline);
    } else {
        sent = co_await send_stream(exchange, *source);
    }
    co_return sent;
}

net::awaitable<bool> Session::send_stream(Exchange& exchange, const ChunkSource& source) {
    const bool chunked = !exchange.content_length && !exchange.parser.is_http_1_0();
    std::uint64_t left = exchange.content_length.value_or(0);
    for (;;) {
        std::optional<std::string> chunk;
        std::string failure;
        std::function<void()> pull = [&] {
            try {
                chunk = source();
            } catch (const std::exception& error) {
                failure = *error.what() == '\0' ? "unnamed" : error.what();
            }
        };
        const JobEnd end = co_await run_on(service_.streams, std::move(pull));
        if (!failure.empty() && service_.hooks.failed) {
            service_.hooks.failed(exchange.request(), failure);
        }
        if (end != JobEnd::kRan || !failure.empty() || left_) co_return abandon();
        if (chunk && chunk->empty() && !connection_->draining()) {
            const auto asked = exchange.response.poll_interval;
            co_await sleep_until_woken(
                asked.count() > 0 ? asked : service_.options.poll_interval);
            if (left_) co_return abandon();
            continue;
        }
        if (!chunk || chunk->empty()) break;
        if (chunked) {
            std::array<char, 24> size{};
            std::snprintf(size.data(), size.size(), "%zx\r\n", chunk->size());
            chunk->insert(0, size.data());
            chunk->append("\r\n");
        } else if (exchange.content_length) {
            left -= chunk->size();
        }
        const bool sent =
            co_await connection_->write(*chunk, service_.options.write_deadline);
        if (!sent) co_return false;
    }
    if (left != 0) co_return false;
    bool ended = true;
    if (chunked) {
        ended = co_await connection_->write("0\r\n\r\n", service_.options.write_deadline);
    }
    co_return ended;
}

bool Session::ends_after(const Exchange& exchange) const {
    if (exchange.parser.state() != State::kDone &&
        exchange.parser.state() != State::kHeadDone) {
        return true;
    }
    // Stopping, the requests that have arrived behind this one are still answered.
    const bool last = connection_->draining() && !connection_->has_input();
    return !exchange.parser.keep_alive() || last;
}

// A stream that nobody listens to has no end; false, for send_stream() to return.
bool Session::abandon() {
    gone_ = left_;
    return false;
}

}  // namespace haarmony::http
