#include "tests/support/http_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace haarmony::test {
namespace {

[[noreturn]] void fail(const std::string& what) {
    throw std::runtime_error("http client: " + what);
}

}  // namespace

std::string HttpReply::header(const std::string& lower_case_name) const {
    const auto found = headers.find(lower_case_name);
    return found == headers.end() ? std::string{} : found->second;
}

HttpClient::HttpClient(std::uint16_t port)
    : descriptor_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (descriptor_ < 0) fail(std::strerror(errno));
    const timeval patience{.tv_sec = kPatience.count(), .tv_usec = 0};
    const int on = 1;
    ::setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    ::setsockopt(descriptor_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    ::setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(descriptor_,
                  reinterpret_cast<const sockaddr*>(&address),
                  sizeof address) != 0) {
        const std::string reason = std::strerror(errno);
        ::close(descriptor_);
        fail("connect: " + reason);
    }
}

HttpClient::~HttpClient() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool HttpClient::send(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t sent =
            ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

void HttpClient::finish_sending() { ::shutdown(descriptor_, SHUT_WR); }

void HttpClient::reset() {
    const linger at_once{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(descriptor_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    ::close(descriptor_);
    descriptor_ = -1;
}

bool HttpClient::more() {
    std::array<char, 65536> piece{};
    ssize_t got = 0;
    // A process that was stopped for a while goes on with EINTR, as it has a time limit.
    do {
        got = ::recv(descriptor_, piece.data(), piece.size(), 0);
    } while (got < 0 && errno == EINTR);
    if (got < 0 && errno != ECONNRESET)
        fail(std::string("recv: ") + std::strerror(errno));
    if (got > 0) buffer_.append(piece.data(), static_cast<std::size_t>(got));
    return got > 0;
}

std::string HttpClient::line() {
    std::size_t end = 0;
    while ((end = buffer_.find("\r\n")) == std::string::npos) {
        if (!more()) fail("the connection ended in a line: '" + buffer_ + "'");
    }
    std::string text = buffer_.substr(0, end);
    buffer_.erase(0, end + 2);
    if (text.find('\n') != std::string::npos) fail("bare line feed in '" + text + "'");
    return text;
}

std::string HttpClient::exactly(std::size_t bytes) {
    while (buffer_.size() < bytes) {
        if (!more()) {
            fail("the connection ended after " + std::to_string(buffer_.size()) + " of " +
                 std::to_string(bytes) + " bytes");
        }
    }
    std::string text = buffer_.substr(0, bytes);
    buffer_.erase(0, bytes);
    return text;
}

std::string HttpClient::chunked_body() {
    std::string body;
    for (;;) {
        const std::string size_line = line();
        std::size_t used = 0;
        const std::size_t size = std::stoul(size_line, &used, 16);
        if (used != size_line.size()) fail("chunk size '" + size_line + "'");
        body += exactly(size);
        if (!line().empty()) fail("chunk without its line end");
        if (size == 0) return body;
    }
}

HttpReply HttpClient::receive_head() {
    const std::string status_line = line();
    if (status_line.size() < 13 || !status_line.starts_with("HTTP/1.1 ") ||
        status_line[12] != ' ') {
        fail("status line '" + status_line + "'");
    }
    HttpReply reply;
    reply.status = std::stoi(status_line.substr(9, 3));
    reply.reason = status_line.substr(13);
    for (std::string text = line(); !text.empty(); text = line()) {
        const std::size_t colon = text.find(": ");
        if (colon == std::string::npos || colon == 0) fail("header '" + text + "'");
        std::string name = text.substr(0, colon);
        for (char& c : name)
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        if (!reply.headers.emplace(name, text.substr(colon + 2)).second) {
            fail("header '" + name + "' twice");
        }
    }
    return reply;
}

HttpReply HttpClient::receive(bool head_only) {
    HttpReply reply = receive_head();
    const bool bodiless =
        head_only || reply.status < 200 || reply.status == 204 || reply.status == 304;
    const bool chunked = reply.headers.contains("transfer-encoding");
    const bool counted = reply.headers.contains("content-length");
    if (chunked && counted) fail("both Content-Length and Transfer-Encoding");
    if (bodiless) return reply;
    if (chunked) {
        reply.body = chunked_body();
    } else if (counted) {
        reply.body = exactly(std::stoul(reply.header("content-length")));
    } else {
        while (more()) {
        }
        reply.body.swap(buffer_);
        reply.until_close = true;
    }
    return reply;
}

std::string HttpClient::read_some() {
    if (buffer_.empty()) more();
    std::string bytes;
    bytes.swap(buffer_);
    return bytes;
}

bool HttpClient::at_end() { return buffer_.empty() && !more(); }

HttpReply HttpClient::get(std::string_view target, std::string_view more_headers) {
    return request("GET", target, more_headers);
}

HttpReply HttpClient::request(std::string_view method,
                              std::string_view target,
                              std::string_view more_headers,
                              std::string_view body) {
    std::string text(method);
    text.append(" ").append(target).append(" HTTP/1.1\r\nHost: localhost\r\n");
    text.append(more_headers);
    if (!body.empty()) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    text.append("\r\n").append(body);
    send(text);
    return receive(method == "HEAD");
}

}  // namespace haarmony::test
