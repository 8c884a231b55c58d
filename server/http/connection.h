// A socket with a deadline, and the bytes that have arrived on it but are not yet used.
//
//   listener -> session -> [connection] -> the operating system
//
// Threads  everything on executor(), which is a strand.
#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace haarmony::http {

class Connection : public std::enable_shared_from_this<Connection> {
  public:
    using Milliseconds = std::chrono::milliseconds;
    enum class Arrival { kBytes, kTimeout, kEnd };
    enum class Departure {
        kReset,       // the other side is gone
        kEndOfInput,  // the other side sends no more; it may still listen
    };

    explicit Connection(boost::asio::ip::tcp::socket socket);

    [[nodiscard]] boost::asio::any_io_executor executor();
    [[nodiscard]] const std::string& remote() const { return remote_; }  // "address:port"

    // What has arrived; consume() takes it from the front.
    [[nodiscard]] std::string_view received() const { return received_; }
    void consume(std::size_t bytes) { received_.erase(0, bytes); }
    // Whether more has arrived, read or not.
    [[nodiscard]] bool has_input() const;

    // From now on, all reads together may take this long.
    void start_read_deadline(Milliseconds deadline) { start_deadline(deadline); }
    void stop_deadline();
    [[nodiscard]] boost::asio::awaitable<Arrival> fill();

    // False if the other side is gone or takes longer than `deadline` for 256 kB.
    [[nodiscard]] boost::asio::awaitable<bool> write(std::string_view bytes,
                                                     Milliseconds deadline);

    // Until unwatch(), `left` is called once if the other side closes or resets. Sees
    // nothing behind bytes that have not been read.
    void watch(std::function<void(Departure)> left);
    void unwatch();

    // Waits for nothing any more: fill() takes what has arrived, and then says kEnd.
    void drain();
    [[nodiscard]] bool draining() const { return draining_; }

    // Closes after an answer to a request whose body was not read: throws it away for a
    // while, since closing at once would make the system destroy the answer on its way.
    [[nodiscard]] boost::asio::awaitable<void> linger(Milliseconds deadline);
    // Operations under way fail.
    void close();
    [[nodiscard]] bool closed() const { return closed_; }

  private:
    using Clock = std::chrono::steady_clock;

    void start_deadline(Milliseconds deadline);
    void set_alarm();
    void ring();

    boost::asio::ip::tcp::socket socket_;
    const std::string remote_;
    Clock::time_point deadline_ = Clock::time_point::max();  // max: none
    boost::asio::steady_timer timer_;
    std::optional<Clock::time_point> alarm_;  // when timer_ rings: not after deadline_
    std::uint64_t alarm_number_ = 0;
    std::uint64_t watch_number_ = 0;
    std::string received_;
    bool timed_out_ = false;
    bool reading_ = false;
    bool draining_ = false;
    bool closed_ = false;
};

}  // namespace haarmony::http
