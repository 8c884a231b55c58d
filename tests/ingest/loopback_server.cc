#include "tests/ingest/loopback_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <utility>

#include "ingest/decoder_wire.h"

namespace haarmony::ingest {
namespace {

// False when the server is to stop.
bool wait_for(const FileDescriptor& readable, const FileDescriptor& stop) {
    std::array<pollfd, 2> wait = {pollfd{readable.get(), POLLIN, 0},
                                  pollfd{stop.get(), POLLIN, 0}};
    while (::poll(wait.data(), wait.size(), -1) < 0) {
    }
    return wait[1].revents == 0;
}

}  // namespace

std::string http_ok(const std::string& body) {
    return "HTTP/1.1 200 OK\r\nConnection: close\r\nContent-Length: " +
           std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string http_redirect(const std::string& location) {
    return "HTTP/1.1 302 Found\r\nConnection: close\r\nContent-Length: 0\r\nLocation: " +
           location + "\r\n\r\n";
}

LoopbackServer::LoopbackServer(std::map<std::string, std::string> responses)
    : responses_(std::move(responses)),
      listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* plain = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(listener_.get(), plain, sizeof(address)), 0);
    EXPECT_EQ(::listen(listener_.get(), 16), 0);
    socklen_t length = sizeof(address);
    EXPECT_EQ(::getsockname(listener_.get(), plain, &length), 0);
    port_ = ntohs(address.sin_port);
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    stop_read_ = FileDescriptor(ends[0]);
    stop_write_ = FileDescriptor(ends[1]);
    thread_ = std::thread([this] { serve(); });
}

LoopbackServer::~LoopbackServer() {
    EXPECT_EQ(::write(stop_write_.get(), "x", 1), 1);
    thread_.join();
}

std::string LoopbackServer::url(const std::string& path) const {
    return "http://127.0.0.1:" + std::to_string(port_) + path;
}

void LoopbackServer::serve() {
    while (wait_for(listener_, stop_read_)) {
        const FileDescriptor connection(
            ::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
        if (connection.valid()) answer(connection);
    }
}

void LoopbackServer::answer(const FileDescriptor& connection) {
    std::string request;
    while (request.find("\r\n\r\n") == std::string::npos) {
        if (!wait_for(connection, stop_read_)) return;
        std::array<char, 1024> part{};
        const ssize_t got = ::recv(connection.get(), part.data(), part.size(), 0);
        if (got <= 0) return;
        request.append(part.data(), static_cast<std::size_t>(got));
    }
    ++requests_;
    const std::size_t begin = request.find(' ') + 1;
    const auto found =
        responses_.find(request.substr(begin, request.find(' ', begin) - begin));
    if (found != responses_.end() && found->second == kSilence) {
        // Until the client hangs up or the test ends.
        static_cast<void>(wait_for(connection, stop_read_));
        return;
    }
    const std::string response =
        found == responses_.end()
            ? "HTTP/1.1 404 Not Found\r\nConnection: close\r\nContent-Length: 0\r\n\r\n"
            : found->second;
    static_cast<void>(send_all(connection.get(), response.data(), response.size()));
}

}  // namespace haarmony::ingest
