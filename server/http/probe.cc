#include "server/http/probe.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <string_view>
#include <system_error>

namespace haarmony::http {
namespace {

using Clock = std::chrono::steady_clock;

class Socket {
  public:
    explicit Socket(int descriptor) : descriptor_(descriptor) {}
    ~Socket() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    [[nodiscard]] int descriptor() const { return descriptor_; }

    // False, with errno, if nothing happens until the deadline.
    [[nodiscard]] bool wait_for(short events, Clock::time_point deadline) const {
        for (;;) {
            const auto left =
                std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
            pollfd polled{.fd = descriptor_, .events = events, .revents = 0};
            const int ready = ::poll(
                &polled, 1, static_cast<int>(std::max<std::int64_t>(0, left.count())));
            if (ready > 0) return true;
            if (ready == 0) errno = ETIMEDOUT;
            if (ready == 0 || errno != EINTR) return false;
        }
    }

  private:
    const int descriptor_;
};

std::string reason() { return std::generic_category().message(errno); }

bool connect_to(const Socket& socket,
                const addrinfo& address,
                Clock::time_point deadline) {
    if (::connect(socket.descriptor(), address.ai_addr, address.ai_addrlen) == 0)
        return true;
    if (errno != EINPROGRESS || !socket.wait_for(POLLOUT, deadline)) return false;
    socklen_t size = sizeof errno;
    int error = 0;
    if (::getsockopt(socket.descriptor(), SOL_SOCKET, SO_ERROR, &error, &size) != 0)
        return false;
    errno = error;
    return error == 0;
}

bool send_all(const Socket& socket, std::string_view bytes, Clock::time_point deadline) {
    while (!bytes.empty()) {
        const ssize_t sent =
            ::send(socket.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent > 0) {
            bytes.remove_prefix(static_cast<std::size_t>(sent));
        } else if ((errno != EAGAIN && errno != EINTR) ||
                   !socket.wait_for(POLLOUT, deadline)) {
            return false;
        }
    }
    return true;
}

// "HTTP/1.1 200", the first 12 bytes of an answer; fewer if no more come.
std::string receive_start(const Socket& socket, Clock::time_point deadline) {
    std::array<char, 12> start{};
    std::size_t filled = 0;
    while (filled < start.size() && socket.wait_for(POLLIN, deadline)) {
        const ssize_t got = ::recv(socket.descriptor(),
                                   start.data() + filled,
                                   start.size() - filled,
                                   MSG_DONTWAIT);
        if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) break;
        if (got > 0) filled += static_cast<std::size_t>(got);
    }
    return std::string(start.data(), filled);
}

int status_of(std::string_view start) {
    if (start.size() != 12 || !start.starts_with("HTTP/1.") || start[8] != ' ') return 0;
    int status = 0;
    for (const char c : start.substr(9)) {
        if (c < '0' || c > '9') return 0;
        status = status * 10 + (c - '0');
    }
    return status;
}

}  // namespace

Result<int> probe(const std::string& host,
                  std::uint16_t port,
                  const std::string& target,
                  std::chrono::milliseconds timeout) {
    const Clock::time_point deadline = Clock::now() + timeout;
    const std::string where = host + ":" + std::to_string(port);
    const auto fail = [&where](const std::string& what) {
        return Error{.code = ErrorCode::kUnavailable,
                     .message = "no answer from " + where + ": " + what,
                     .param = {}};
    };
    addrinfo wanted{};
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* list = nullptr;
    const int looked_up =
        ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &wanted, &list);
    if (looked_up != 0) return fail(::gai_strerror(looked_up));
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(list,
                                                                         ::freeaddrinfo);

    const Socket socket(::socket(addresses->ai_family,
                                 SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC,
                                 addresses->ai_protocol));
    if (socket.descriptor() < 0 || !connect_to(socket, *addresses, deadline)) {
        return fail(reason());
    }
    const std::string request = "GET " + target + " HTTP/1.1\r\nHost: " + where +
                                "\r\nConnection: close\r\nUser-Agent: haarmony\r\n\r\n";
    if (!send_all(socket, request, deadline)) return fail(reason());
    const std::string start = receive_start(socket, deadline);
    const int status = status_of(start);
    if (status == 0) return fail(start.empty() ? "it said nothing" : "it is not HTTP");
    return status;
}

}  // namespace haarmony::http
