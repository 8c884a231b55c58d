#include "server/http/request_parser.h"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/none.hpp>
#include <cassert>
#include <string>
#include <utility>

#include "server/http/header_value.h"
#include "server/http/request_id.h"
#include "server/http/target.h"

namespace haarmony::http {
namespace {

namespace beast = boost::beast::http;
using State = RequestParser::State;

std::string_view view(boost::beast::string_view text) {
    return {text.data(), text.size()};
}

// Whether what stands behind method and target names some version of HTTP. What follows it
// may not have arrived yet, and so must not matter.
bool mentions_http_version(std::string_view head) {
    constexpr std::string_view kName = "HTTP/";
    for (int words = 0; words < 2; ++words) {
        const std::size_t space = head.find(' ');
        if (space == std::string_view::npos) return false;
        head.remove_prefix(space + 1);
    }
    return head.starts_with(kName) && head.size() > kName.size() &&
           head[kName.size()] >= '0' && head[kName.size()] <= '9';
}

}  // namespace

struct RequestParser::Impl {
    Impl() {
        // The limit is set when the route is known; until then a length is only noted.
        parser.body_limit(boost::none);
        parser.header_limit(static_cast<std::uint32_t>(kMaxHead));
        request.request_id = make_request_id();
    }

    void refuse(int status,
                std::string code,
                std::string detail,
                std::string param = {}) {
        state = State::kBad;
        problem = {.status = status,
                   .code = std::move(code),
                   .detail = std::move(detail),
                   .param = std::move(param),
                   .headers = {}};
    }

    std::size_t feed_head(std::string_view bytes);
    std::size_t feed_body(std::string_view bytes);
    void fail(boost::beast::error_code error, std::string_view bytes);
    void take_headers();
    void finish_head();
    void check_framing();

    beast::request_parser<beast::string_body> parser;
    Request request;
    Problem problem;
    State state = State::kHead;
    std::size_t head_bytes = 0;  // taken so far
    std::uint64_t limit = 0;
    int hosts = 0;
};

std::size_t RequestParser::Impl::feed_head(std::string_view bytes) {
    const std::size_t all = bytes.size();
    if (head_bytes == 0) {
        // RFC 9112 section 2.2: empty lines before the request line are not part of it.
        while (bytes.starts_with("\r\n")) bytes.remove_prefix(2);
        if (bytes.empty() || bytes == "\r") return all - bytes.size();
        if (std::min(bytes.find('\n'), bytes.size()) > kMaxRequestLine) {
            refuse(414,
                   "target_too_long",
                   "The request line is longer than " + std::to_string(kMaxRequestLine) +
                       " bytes.");
            return all - bytes.size();
        }
    }
    boost::beast::error_code error;
    const std::size_t taken =
        parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    head_bytes += taken;
    // Beast forgets what it has taken already, so its own limit is only one on each line.
    const std::size_t head =
        head_bytes + (parser.is_header_done() ? 0 : bytes.size() - taken);
    if (head > kMaxHead) error = beast::error::header_limit;
    if (error && error != beast::error::need_more) {
        fail(error, bytes);
    } else if (parser.is_header_done()) {
        finish_head();
    }
    return all - bytes.size() + taken;
}

std::size_t RequestParser::Impl::feed_body(std::string_view bytes) {
    // Beast asserts that the rest of a chunked body is at least "0\r\n\r\n". It will be.
    if (parser.chunked() && bytes.size() < 5) return 0;
    boost::beast::error_code error;
    const std::size_t taken =
        parser.put(boost::asio::buffer(bytes.data(), bytes.size()), error);
    if (error && error != beast::error::need_more) {
        fail(error, bytes);
    } else if (parser.is_done()) {
        request.body = std::move(parser.get().body());
        state = State::kDone;
    } else if (bytes.size() - taken > kMaxHead) {
        refuse(400, "malformed_request", "A chunk's header or the trailer has no end.");
    }
    return taken;
}

void RequestParser::Impl::fail(boost::beast::error_code error, std::string_view bytes) {
    take_headers();
    if (error == beast::error::header_limit) {
        refuse(431,
               "headers_too_large",
               "The headers are longer than " + std::to_string(kMaxHead) + " bytes.");
    } else if (error == beast::error::body_limit) {
        refuse(413,
               "body_too_large",
               "The body is longer than " + std::to_string(limit) + " bytes.");
    } else if (error == beast::error::bad_version && mentions_http_version(bytes)) {
        refuse(505, "unsupported_version", "This server speaks HTTP/1.0 and HTTP/1.1.");
    } else {
        refuse(400, "malformed_request", "Malformed request: " + error.message() + ".");
    }
}

void RequestParser::Impl::take_headers() {
    if (!request.headers.empty()) return;
    const auto& message = parser.get();
    request.method = view(message.method_string());
    for (const auto& field : message) {
        const auto [header, added] = request.headers.emplace(
            std::string(view(field.name_string())), std::string(view(field.value())));
        // Several lines of one name are one list (RFC 9110 section 5.3).
        if (!added) {
            header->second += field.name() == beast::field::cookie ? "; " : ", ";
            header->second += view(field.value());
        }
        if (field.name() == beast::field::host) ++hosts;
    }
    const std::string_view id = request.header("X-Request-Id");
    if (is_request_id(id)) request.request_id = id;
}

void RequestParser::Impl::finish_head() {
    take_headers();
    state = State::kHeadDone;
    check_framing();
    if (state == State::kBad) return;
    Result<Target> target = parse_target(view(parser.get().target()));
    if (!target) {
        refuse(400, "bad_target", target.error().message);
        return;
    }
    request.path = std::move(target->path);
    request.query = std::move(target->query);
}

void RequestParser::Impl::check_framing() {
    const bool http_1_0 = parser.get().version() == 10;
    if (hosts > 1 || (hosts == 0 && !http_1_0)) {
        refuse(400, "bad_host", "A request needs exactly one Host header.", "Host");
        return;
    }
    const auto coding = request.headers.find("Transfer-Encoding");
    if (coding == request.headers.end()) return;
    if (http_1_0 || !parser.chunked()) {
        refuse(400,
               "malformed_request",
               "The end of this body cannot be known: Transfer-Encoding '" +
                   coding->second + "'.",
               "Transfer-Encoding");
    } else if (!equal_without_case(trim(coding->second), "chunked")) {
        refuse(501,
               "unsupported_transfer_coding",
               "Of transfer codings only chunked is known, not '" + coding->second + "'.",
               "Transfer-Encoding");
    }
}

RequestParser::RequestParser() : impl_(std::make_unique<Impl>()) {}
RequestParser::~RequestParser() = default;

std::size_t RequestParser::feed(std::string_view bytes) {
    if (impl_->state == State::kHead) return impl_->feed_head(bytes);
    if (impl_->state == State::kBody) return impl_->feed_body(bytes);
    return 0;
}

RequestParser::State RequestParser::state() const { return impl_->state; }

void RequestParser::begin_body(std::uint64_t limit) {
    assert(impl_->state == State::kHeadDone);
    impl_->limit = limit;
    const auto length = impl_->parser.content_length();
    if (length && *length > limit) {
        impl_->refuse(413,
                      "body_too_large",
                      "The body is " + std::to_string(*length) +
                          " bytes long, but no more than " + std::to_string(limit) +
                          " are taken here.",
                      "Content-Length");
        return;
    }
    impl_->parser.body_limit(limit);
    impl_->parser.eager(true);
    impl_->state = impl_->parser.is_done() ? State::kDone : State::kBody;
}

void RequestParser::refuse(Problem problem) {
    impl_->take_headers();
    impl_->state = State::kBad;
    impl_->problem = std::move(problem);
}

const Problem& RequestParser::problem() const {
    assert(impl_->state == State::kBad);
    return impl_->problem;
}

Request& RequestParser::request() { return impl_->request; }
bool RequestParser::keep_alive() const { return impl_->parser.keep_alive(); }
bool RequestParser::is_http_1_0() const { return impl_->parser.get().version() == 10; }

bool RequestParser::has_body() const {
    const auto length = impl_->parser.content_length();
    return impl_->parser.chunked() || (length && *length > 0);
}

}  // namespace haarmony::http
