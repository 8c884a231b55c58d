#include "server/http/connection.h"

#include <sys/socket.h>

#include <array>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <cerrno>
#include <utility>

namespace haarmony::http {
namespace {

namespace net = boost::asio;
using boost::system::error_code;

constexpr std::size_t kReadPiece = 64 * 1024;
constexpr std::size_t kWritePiece = 256 * 1024;
constexpr auto kTuple = net::as_tuple(net::use_awaitable);

std::string remote_of(const net::ip::tcp::socket& socket) {
    error_code error;
    const auto endpoint = socket.remote_endpoint(error);
    if (error) return "unknown";
    return endpoint.address().to_string() + ":" + std::to_string(endpoint.port());
}

}  // namespace

Connection::Connection(net::ip::tcp::socket socket)
    : socket_(std::move(socket)),
      remote_(remote_of(socket_)),
      timer_(socket_.get_executor()) {
    error_code ignored;  // a socket that is broken already shows it at its first read
    socket_.set_option(net::ip::tcp::no_delay(true), ignored);
    socket_.non_blocking(true, ignored);
}

net::any_io_executor Connection::executor() { return socket_.get_executor(); }

bool Connection::has_input() const {
    error_code error;
    return !received_.empty() || (socket_.available(error) > 0 && !error);
}

void Connection::start_deadline(Milliseconds deadline) {
    timed_out_ = false;
    deadline_ = Clock::now() + deadline;
    if (!alarm_ || *alarm_ > deadline_) set_alarm();
}

void Connection::stop_deadline() {
    timed_out_ = false;
    deadline_ = Clock::time_point::max();
}

// Each request has several deadlines, and nearly all of them are stopped in time. So the
// timer runs on, and looks at the deadline of the day when it rings.
void Connection::set_alarm() {
    alarm_ = deadline_;
    timer_.expires_at(deadline_);
    // A handler that is queued already cannot be cancelled, hence the number.
    timer_.async_wait(
        [self = shared_from_this(), number = ++alarm_number_](error_code error) {
            if (error || number != self->alarm_number_) return;
            self->alarm_.reset();
            self->ring();
        });
}

void Connection::ring() {
    if (deadline_ == Clock::time_point::max() || closed_) return;
    if (deadline_ > Clock::now()) return set_alarm();
    deadline_ = Clock::time_point::max();
    timed_out_ = true;
    error_code ignored;
    socket_.cancel(ignored);
}

net::awaitable<Connection::Arrival> Connection::fill() {
    for (;;) {
        // The deadline may pass between two reads, when there is nothing to cancel.
        if (timed_out_) co_return Arrival::kTimeout;
        if (!draining_) {
            // Thousands of idle connections should not hold a buffer each.
            if (received_.empty()) received_.shrink_to_fit();
            reading_ = true;
            co_await socket_.async_wait(net::ip::tcp::socket::wait_read, kTuple);
            reading_ = false;
        }
        if (closed_) co_return Arrival::kEnd;
        // A string of that size would be filled with zeros first, for each request.
        thread_local std::array<char, kReadPiece> piece;
        error_code error;
        const std::size_t bytes = socket_.read_some(net::buffer(piece), error);
        received_.append(piece.data(), bytes);
        if (bytes > 0) co_return Arrival::kBytes;
        if (timed_out_) co_return Arrival::kTimeout;
        if (draining_ || error != net::error::would_block) co_return Arrival::kEnd;
    }
}

net::awaitable<bool> Connection::write(std::string_view bytes, Milliseconds deadline) {
    while (!bytes.empty()) {
        std::string_view piece = bytes.substr(0, kWritePiece);
        bytes.remove_prefix(piece.size());
        bool waited = false;
        while (!piece.empty()) {
            if (timed_out_ || closed_) co_return false;
            // Most answers fit into the system's buffer: nothing to wait for.
            error_code error;
            const std::size_t sent =
                socket_.write_some(net::buffer(piece.data(), piece.size()), error);
            piece.remove_prefix(sent);
            if (!error) continue;
            if (error != net::error::would_block) co_return false;
            if (!waited) start_deadline(deadline);
            waited = true;
            co_await socket_.async_wait(net::ip::tcp::socket::wait_write, kTuple);
        }
        if (waited) stop_deadline();
    }
    co_return true;
}

void Connection::watch(std::function<void(Departure)> left) {
    const std::uint64_t number = ++watch_number_;
    socket_.async_wait(
        net::ip::tcp::socket::wait_read,
        [self = shared_from_this(), number, left = std::move(left)](error_code error) {
            if (error || number != self->watch_number_ || self->closed_) return;
            char byte = 0;
            const ssize_t got =
                ::recv(self->socket_.native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
            if (got == 0) left(Departure::kEndOfInput);
            if (got < 0 && errno != EAGAIN && errno != EINTR) left(Departure::kReset);
        });
}

void Connection::unwatch() {
    ++watch_number_;
    error_code ignored;
    socket_.cancel(ignored);
}

void Connection::drain() {
    draining_ = true;
    error_code ignored;
    if (reading_) socket_.cancel(ignored);
}

net::awaitable<void> Connection::linger(Milliseconds deadline) {
    error_code error;
    socket_.shutdown(net::ip::tcp::socket::shutdown_send, error);
    received_.clear();
    start_deadline(deadline);
    while (!error) {
        const Arrival arrival = co_await fill();
        if (arrival != Arrival::kBytes) break;
        received_.clear();
    }
    close();
}

void Connection::close() {
    closed_ = true;
    timer_.cancel();
    error_code ignored;
    socket_.close(ignored);
}

}  // namespace haarmony::http
