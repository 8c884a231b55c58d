#include "server/http/probe.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <thread>

namespace haarmony::http {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A listening socket that answers one connection with the given bytes.
class OneAnswer {
  public:
    explicit OneAnswer(std::string bytes)
        : descriptor_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* generic = reinterpret_cast<sockaddr*>(&address);
        EXPECT_EQ(::bind(descriptor_, generic, size), 0);
        EXPECT_EQ(::listen(descriptor_, 1), 0);
        EXPECT_EQ(::getsockname(descriptor_, generic, &size), 0);
        port_ = ntohs(address.sin_port);
        thread_ = std::thread([this, bytes = std::move(bytes)] {
            const int client = ::accept(descriptor_, nullptr, nullptr);
            if (client < 0) return;
            char buffer[4096];
            const ssize_t got = ::recv(client, buffer, sizeof buffer, 0);
            if (got > 0) request_.assign(buffer, static_cast<std::size_t>(got));
            for (const char c : bytes) (void)::send(client, &c, 1, MSG_NOSIGNAL);
            ::close(client);
        });
    }
    ~OneAnswer() {
        ::shutdown(descriptor_, SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
        ::close(descriptor_);
    }
    OneAnswer(const OneAnswer&) = delete;
    OneAnswer& operator=(const OneAnswer&) = delete;

    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] std::string request() {
        thread_.join();
        return request_;
    }

  private:
    int descriptor_;
    std::uint16_t port_ = 0;
    std::string request_;
    std::thread thread_;
};

TEST(Probe, TellsTheStatus) {
    OneAnswer server("HTTP/1.1 503 Service Unavailable\r\n\r\n");
    const auto status = probe("127.0.0.1", server.port(), "/healthz", seconds(20));
    ASSERT_TRUE(status) << status.error().message;
    EXPECT_EQ(*status, 503);
    EXPECT_THAT(server.request(),
                testing::StartsWith("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1:"));
}

TEST(Probe, AnswerThatIsNotHttpIsAnError) {
    for (const char* bytes :
         {"SSH-2.0-OpenSSH_9.2p1\r\n", "HTTP/1.1 2xx\r\n", "HTTP/1.1 20"}) {
        OneAnswer server(bytes);
        const auto status = probe("127.0.0.1", server.port(), "/", seconds(20));
        ASSERT_FALSE(status) << bytes;
        EXPECT_EQ(status.error().code, ErrorCode::kUnavailable);
        EXPECT_THAT(status.error().message, testing::HasSubstr("not HTTP"));
    }
}

TEST(Probe, ServerThatHangsUpIsAnError) {
    OneAnswer server("");
    const auto status = probe("127.0.0.1", server.port(), "/", seconds(20));
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message, testing::HasSubstr("said nothing"));
}

TEST(Probe, SilentServerIsAnErrorAfterTheTimeout) {
    // The system completes the connection, but nobody ever accepts it.
    const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    ASSERT_EQ(::bind(descriptor, generic, size), 0);
    ASSERT_EQ(::listen(descriptor, 1), 0);
    ASSERT_EQ(::getsockname(descriptor, generic, &size), 0);
    const auto status =
        probe("127.0.0.1", ntohs(address.sin_port), "/", milliseconds(50));
    EXPECT_FALSE(status);
    ::close(descriptor);
}

TEST(Probe, ClosedPortIsNamed) {
    // Bound but not listening: nobody else can take the port meanwhile.
    const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    ASSERT_EQ(::bind(descriptor, generic, size), 0);
    ASSERT_EQ(::getsockname(descriptor, generic, &size), 0);
    const std::uint16_t port = ntohs(address.sin_port);
    const auto status = probe("127.0.0.1", port, "/", seconds(20));
    ASSERT_FALSE(status);
    EXPECT_THAT(status.error().message,
                testing::HasSubstr("127.0.0.1:" + std::to_string(port)));
    EXPECT_THAT(status.error().message, testing::HasSubstr("refused"));
    ::close(descriptor);
}

TEST(Probe, UnknownHostIsAnError) {
    EXPECT_FALSE(probe("no such host", 80, "/", milliseconds(50)));
}

}  // namespace
}  // namespace haarmony::http
