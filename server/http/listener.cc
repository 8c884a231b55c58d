#include "server/http/listener.h"

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/http/session.h"
#include "server/http/worker_pool.h"

namespace haarmony::http {
namespace {

namespace net = boost::asio;
using boost::system::error_code;
using net::ip::tcp;

// What accept() fails with when descriptors or memory run short does not pass at once.
constexpr std::chrono::milliseconds kAcceptPause{50};

// Beyond the limit on connections so many are told so, or answered where the request is an
// instant one; further ones are closed at once.
constexpr std::size_t kTurnedAway = 64;

Error cannot_listen(const ListenerOptions& options, const error_code& error) {
    return Error{.code = ErrorCode::kIo,
                 .message = "cannot listen on " + options.host + ":" +
                            std::to_string(options.port) + ": " + error.message(),
                 .param = {}};
}

}  // namespace

class Listener::Impl {
  public:
    Impl(const ListenerOptions& options, const Router& router, Hooks hooks)
        : options_(options),
          hooks_(std::move(hooks)),
          cheap_(options.cheap_threads, options.cheap_queue, 0),
          costly_(options.costly_threads, options.costly_queue, options.costly_niceness),
          // Each session pulls one chunk at a time, so there is room for all of them.
          streams_(options.stream_threads, options.max_connections, 0),
          service_{.options = options_,
                   .router = router,
                   .hooks = hooks_,
                   .cheap = cheap_,
                   .costly = costly_,
                   .streams = streams_},
          acceptor_(net::make_strand(io_)),
          pause_(acceptor_.get_executor()),
          work_(io_.get_executor()) {}

    ~Impl() { stop(); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    Result<void> open();
    void stop();
    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] Load load() const;

  private:
    void accept_next();
    void accepted(const error_code& error);
    void welcome(tcp::socket socket);
    void accept_backlog();
    [[nodiscard]] std::vector<std::shared_ptr<Session>> sessions() const;

    const ListenerOptions options_;
    const Hooks hooks_;
    WorkerPool cheap_;
    WorkerPool costly_;
    WorkerPool streams_;
    const Service service_;
    net::io_context io_;
    tcp::acceptor acceptor_;
    net::steady_timer pause_;
    net::executor_work_guard<net::io_context::executor_type> work_;
    std::vector<std::thread> threads_;
    std::uint16_t port_ = 0;
    bool stopping_ = false;  // on the acceptor's strand
    std::promise<void> accepting_ended_;

    mutable std::mutex mutex_;
    std::condition_variable ended_;
    std::unordered_map<Session*, std::weak_ptr<Session>> sessions_;  // guarded by mutex_
    std::size_t accept_failures_ = 0;                                // guarded by mutex_
    std::once_flag stopped_;
};

Result<void> Listener::Impl::open() {
    error_code error;
    tcp::resolver resolver(io_);
    const auto found = resolver.resolve(
        options_.host, std::to_string(options_.port), tcp::resolver::passive, error);
    if (error) return cannot_listen(options_, error);
    const tcp::endpoint endpoint = found.begin()->endpoint();
    acceptor_.open(endpoint.protocol(), error);
    if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(endpoint, error);
    if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
    if (!error) port_ = acceptor_.local_endpoint(error).port();
    if (error) return cannot_listen(options_, error);

    net::post(acceptor_.get_executor(), [this] { accept_next(); });
    // All that run cheap handlers at the same time leave those whose work is the sockets.
    const int threads =
        std::max(1, options_.io_threads) + std::max(1, options_.cheap_threads);
    for (int i = 0; i < threads; ++i) {
        threads_.emplace_back([this] { io_.run(); });
    }
    return {};
}

// One accept or one pause is under way at any time, until the last one finds `stopping_`.
void Listener::Impl::accept_next() {
    acceptor_.async_accept(net::make_strand(io_),
                           [this](error_code error, tcp::socket socket) {
                               if (!error) welcome(std::move(socket));
                               accepted(error);
                           });
}

void Listener::Impl::accepted(const error_code& error) {
    if (stopping_) {
        accepting_ended_.set_value();
    } else if (!error || error == net::error::connection_aborted) {
        accept_next();
    } else {
        {
            const std::lock_guard lock(mutex_);
            ++accept_failures_;
        }
        pause_.expires_after(kAcceptPause);
        pause_.async_wait([this](error_code) { accepted({}); });
    }
}

void Listener::Impl::welcome(tcp::socket socket) {
    std::size_t open = 0;
    std::shared_ptr<Session> session;
    {
        const std::lock_guard lock(mutex_);
        open = sessions_.size();
    }
    const auto limit = static_cast<std::size_t>(std::max(1, options_.max_connections));
    if (open >= limit + kTurnedAway) return;
    // The address of a session names it; `ended` runs in its destructor.
    const auto name = std::make_shared<Session*>(nullptr);
    session = std::make_shared<Session>(std::move(socket), service_, [this, name] {
        const std::lock_guard lock(mutex_);
        sessions_.erase(*name);
        ended_.notify_all();
    });
    *name = session.get();
    {
        const std::lock_guard lock(mutex_);
        sessions_.emplace(session.get(), session);
    }
    session->start(open < limit ? Session::Welcome::kServe : Session::Welcome::kTooMany);
}

// Connections that the system has completed may carry whole requests already.
void Listener::Impl::accept_backlog() {
    error_code error;
    acceptor_.non_blocking(true, error);
    while (!error) {
        tcp::socket socket(net::make_strand(io_));
        acceptor_.accept(socket, error);
        if (!error) welcome(std::move(socket));
    }
}

std::vector<std::shared_ptr<Session>> Listener::Impl::sessions() const {
    std::vector<std::shared_ptr<Session>> alive;
    const std::lock_guard lock(mutex_);
    for (const auto& [address, weak] : sessions_) {
        if (auto session = weak.lock()) alive.push_back(std::move(session));
    }
    return alive;
}

void Listener::Impl::stop() {
    std::call_once(stopped_, [this] {
        if (!threads_.empty()) {
            net::post(acceptor_.get_executor(), [this] {
                stopping_ = true;
                accept_backlog();
                error_code ignored;
                acceptor_.close(ignored);
                pause_.cancel();
            });
            accepting_ended_.get_future().wait();
        }
        for (const auto& session : sessions()) session->drain();
        {
            std::unique_lock lock(mutex_);
            ended_.wait_for(lock, options_.grace, [this] { return sessions_.empty(); });
        }
        // First the queues: a handler that ends now must not make room for the next one.
        for (WorkerPool* pool : {&cheap_, &costly_, &streams_}) pool->discard();
        for (const auto& session : sessions()) session->cut();
        cheap_.stop();
        costly_.stop();
        streams_.stop();
        work_.reset();
        for (std::thread& thread : threads_) thread.join();
    });
}

Load Listener::Impl::load() const {
    Load load;
    load.cheap_queued = cheap_.queued();
    load.costly_queued = costly_.queued();
    const std::lock_guard lock(mutex_);
    load.connections = sessions_.size();
    load.accept_failures = accept_failures_;
    return load;
}

Listener::Listener(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Listener::~Listener() = default;

Result<std::unique_ptr<Listener>> Listener::listen(const ListenerOptions& options,
                                                   const Router& router,
                                                   Hooks hooks) {
    auto impl = std::make_unique<Impl>(options, router, std::move(hooks));
    if (Result<void> opened = impl->open(); !opened) return std::move(opened).error();
    return std::unique_ptr<Listener>(new Listener(std::move(impl)));
}

std::uint16_t Listener::port() const { return impl_->port(); }
Load Listener::load() const { return impl_->load(); }
void Listener::stop() { impl_->stop(); }

}  // namespace haarmony::http
