// One connection's life: read a request, have it answered on a pool, write the answer, and
// again while the client keeps the connection open.
//
//   listener -> [session] -> router -> a handler of server/api
//
// Requests of one connection are answered one after another, so pipelined ones in order.
// A client that leaves takes its queued request and its stream with it, and a handler that
// runs is told. A FIN alone is taken for leaving only if the client meant to keep the
// connection, and a quarter of a second after it: others send all, close their half, and
// listen. An answer that is ready all the same is sent.
//
// Threads  start(), drain() and cut() from any thread; the rest on the connection's strand.
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "server/http/connection.h"
#include "server/http/listener.h"
#include "server/http/request_parser.h"
#include "server/http/request_reader.h"
#include "server/http/worker_pool.h"

namespace haarmony::http {

// What all sessions of a listener share. It outlives them.
struct Service {
    const ListenerOptions& options;
    const Router& router;
    const Hooks& hooks;
    WorkerPool& cheap;
    WorkerPool& costly;
    WorkerPool& streams;
};

class Session : public std::enable_shared_from_this<Session> {
  public:
    // Too many: one request, answered if it is an instant one and with 503 else.
    enum class Welcome { kServe, kTooMany };

    // `ended` is called when the session is destroyed.
    Session(boost::asio::ip::tcp::socket socket,
            const Service& service,
            std::function<void()> ended);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    void start(Welcome welcome);
    // Answers what has been received in full, then closes.
    void drain();
    // Closes now; a handler that runs is told by its Request::cancelled.
    void cut();

  private:
    struct Exchange;
    struct JobState;
    enum class JobEnd { kRan, kRefused, kDropped };

    boost::asio::awaitable<void> serve();
    boost::asio::awaitable<void> turn_away();
    boost::asio::awaitable<bool> serve_request();
    boost::asio::awaitable<void> receive(Exchange& exchange);
    boost::asio::awaitable<void> respond(Exchange& exchange);
    void run_handler(Exchange& exchange) const;
    [[nodiscard]] bool answer_here(Exchange& exchange) const;
    boost::asio::awaitable<void> answer_on_pool(Exchange& exchange);
    void watch(const Exchange& exchange);
    boost::asio::awaitable<bool> send(Exchange& exchange);
    boost::asio::awaitable<bool> send_stream(Exchange& exchange,
                                             const ChunkSource& source);
    boost::asio::awaitable<JobEnd> run_on(WorkerPool& pool, std::function<void()> work);
    boost::asio::awaitable<void> sleep_until_woken(std::chrono::milliseconds at_most);

    [[nodiscard]] std::optional<Response> admit(const Request& request,
                                                const RouteMatch& match) const;
    [[nodiscard]] bool ends_after(const Exchange& exchange) const;
    void peer_left(Connection::Departure departure, bool wants_to_stay);
    void give_up();
    bool abandon();
    void report_finished(const Exchange& exchange) const;

    const Service& service_;
    const std::function<void()> ended_;
    const std::shared_ptr<Connection> connection_;
    RequestReader reader_;
    boost::asio::steady_timer wake_;         // its cancellation wakes what waits
    boost::asio::steady_timer half_closed_;  // runs from a FIN on
    std::stop_source stop_;                  // of the request in work
    std::uint64_t request_number_ = 0;
    bool left_ = false;         // probably nobody waits for the answer any more
    bool gone_ = false;         // nobody does
    bool must_linger_ = false;  // a body was refused without being read
};

}  // namespace haarmony::http
