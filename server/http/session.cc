#include "server/http/session.h"

#include <algorithm>
#include <boost/asio/as_tuple.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <exception>
#include <utility>

#include "server/http/answer.h"
#include "server/http/problem.h"
#include "server/http/session_exchange.h"

namespace haarmony::http {
namespace {

namespace net = boost::asio;
using Clock = std::chrono::steady_clock;
using State = RequestParser::State;

constexpr int kClientLeft = 499;  // in the access log only
constexpr std::chrono::milliseconds kHalfClosePause{250};
constexpr std::chrono::milliseconds kTurnedAwayDeadline{2'000};

Problem overloaded(std::string detail) {
    return {.status = 503,
            .code = "overloaded",
            .detail = std::move(detail),
            .headers = {{"Retry-After", "1"}}};
}

}  // namespace

// Shared by a job and the session that waits for it; the last to leave the pool wakes it.
struct Session::JobState {
    bool ran = false;    // written by the job, read once `ended`
    bool ended = false;  // on the strand
};

Session::Session(net::ip::tcp::socket socket,
                 const Service& service,
                 std::function<void()> ended)
    : service_(service),
      ended_(std::move(ended)),
      connection_(std::make_shared<Connection>(std::move(socket))),
      reader_(*connection_, service.options),
      wake_(connection_->executor()),
      half_closed_(connection_->executor()) {}

Session::~Session() { ended_(); }

void Session::start(Welcome welcome) {
    net::co_spawn(
        connection_->executor(),
        [self = shared_from_this(), welcome]() -> net::awaitable<void> {
            if (welcome == Welcome::kServe) {
                co_await self->serve();
            } else {
                co_await self->turn_away();
            }
            const bool unread = self->must_linger_ || self->connection_->has_input();
            if (unread && !self->gone_) {
                co_await self->connection_->linger(
                    self->service_.options.linger_deadline);
            }
            self->connection_->close();
        },
        [](const std::exception_ptr& error) {
            // Only memory runs out here; handlers' exceptions end in the router.
            if (error) std::rethrow_exception(error);
        });
}

void Session::drain() {
    net::post(connection_->executor(), [self = shared_from_this()] {
        self->connection_->drain();
        self->wake_.cancel();
    });
}

void Session::cut() {
    net::post(connection_->executor(), [self = shared_from_this()] {
        self->connection_->close();
        self->give_up();
    });
}

net::awaitable<void> Session::serve() {
    for (bool more = true; more;) {
        // g++ 12 makes invalid code of a loop whose condition is a co_await.
        more = co_await serve_request();
    }
}

net::awaitable<void> Session::turn_away() {
    RequestParser parser;
    const bool arrived = co_await reader_.read_head(
        parser, std::min(kTurnedAwayDeadline, service_.options.header_deadline));
    if (!arrived) co_return;
    Exchange exchange(parser);
    exchange.close = true;
    Request& request = parser.request();
    request.remote = connection_->remote();
    const RouteMatch match = service_.router.match(request.method, request.path);
    if (parser.state() == State::kHeadDone && match.options != nullptr &&
        match.options->cost_for(request) == Cost::kInstant && !admit(request, match)) {
        run_handler(exchange);
    } else {
        exchange.refuse(overloaded("The server has as many connections as it takes."));
    }
    connection_->stop_deadline();
    must_linger_ = true;
    co_await send(exchange);
    report_finished(exchange);
}

// One request. True if another may follow.
net::awaitable<bool> Session::serve_request() {
    RequestParser parser;
    const bool arrived =
        co_await reader_.read_head(parser, service_.options.header_deadline);
    if (!arrived) co_return false;
    left_ = false;
    Exchange exchange(parser);
    stop_ = std::stop_source();
    parser.request().remote = connection_->remote();
    parser.request().cancelled = stop_.get_token();

    co_await receive(exchange);
    connection_->stop_deadline();
    if (!gone_) co_await respond(exchange);
    if (gone_) exchange.response.status = kClientLeft;
    report_finished(exchange);
    co_return !gone_ && !exchange.close;
}

// The rest of the request, or an answer that needs no more of it.
net::awaitable<void> Session::receive(Exchange& exchange) {
    RequestParser& parser = exchange.parser;
    if (parser.state() == State::kHeadDone) {
        Request& request = parser.request();
        const RouteMatch match = service_.router.match(request.method, request.path);
        if (std::optional<Response> refusal = admit(request, match)) {
            exchange.response = *std::move(refusal);
            exchange.answered = true;
        } else if (match.options == nullptr) {
            // Without a route no body is read: the answer does not depend on it.
            exchange.response = service_.router.dispatch(request, service_.hooks.failed);
            exchange.answered = true;
        } else {
            const bool arrived =
                co_await reader_.read_body(parser, match.options->body_limit);
            if (!arrived) gone_ = true;
            if (parser.state() == State::kDone)
                exchange.cost = match.options->cost_for(request);
        }
        if (exchange.answered && parser.has_body()) exchange.close = must_linger_ = true;
    }
    if (parser.state() == State::kBad) {
        exchange.refuse(parser.problem());
        exchange.answered = true;
        exchange.close = must_linger_ = true;
    }
}

// The answer, while an eye is kept on the client where it takes time.
net::awaitable<void> Session::respond(Exchange& exchange) {
    const bool queued = !exchange.answered && !answer_here(exchange);
    if (queued) {
        watch(exchange);
        co_await answer_on_pool(exchange);
    }
    const bool streamed = !std::holds_alternative<std::string>(exchange.response.body);
    if (streamed && !queued) watch(exchange);
    if (!gone_) {
        const bool sent = co_await send(exchange);
        if (!sent) exchange.close = true;
    }
    if (!queued && !streamed) co_return;
    connection_->unwatch();
    ++request_number_;
    half_closed_.cancel();
}

void Session::watch(const Exchange& exchange) {
    const bool wants_to_stay =
        exchange.parser.state() != State::kBad && exchange.parser.keep_alive();
    connection_->watch(
        [weak = weak_from_this(), wants_to_stay](Connection::Departure how) {
            if (const auto self = weak.lock()) self->peer_left(how, wants_to_stay);
        });
}

// The answer to a client without a key, where one is needed.
std::optional<Response> Session::admit(const Request& request,
                                       const RouteMatch& match) const {
    if (!service_.hooks.admit) return std::nullopt;
    const RouteOptions options =
        match.options != nullptr ? *match.options : RouteOptions{.open = match.open};
    return service_.hooks.admit(request, options);
}

void Session::run_handler(Exchange& exchange) const {
    Answer made = answer(service_.router, exchange.request(), service_.hooks.failed);
    exchange.response = std::move(made.response);
    exchange.content_length = made.content_length;
}

// Waking another thread takes longer than most cheap handlers: they run on this one as long
// as their pool has a place free. False if the request has to wait for one.
bool Session::answer_here(Exchange& exchange) const {
    if (exchange.cost == Cost::kCostly) return false;
    if (exchange.cost == Cost::kCheap)
        return service_.cheap.run_here([&] { run_handler(exchange); });
    run_handler(exchange);
    return true;
}

net::awaitable<void> Session::answer_on_pool(Exchange& exchange) {
    WorkerPool& pool = exchange.cost == Cost::kCostly ? service_.costly : service_.cheap;
    std::function<void()> work = [this, &exchange] { run_handler(exchange); };
    const JobEnd end = co_await run_on(pool, std::move(work));
    if (end == JobEnd::kRefused) {
        exchange.refuse(overloaded("Too many requests are waiting already."));
    } else if (end == JobEnd::kDropped) {
        gone_ = true;
    }
}

net::awaitable<Session::JobEnd> Session::run_on(WorkerPool& pool,
                                                std::function<void()> work) {
    const auto state = std::make_shared<JobState>();
    // Destroyed after the job, or in its place.
    const auto notice = [self = shared_from_this(), state](void*) {
        net::post(self->connection_->executor(), [self, state] {
            state->ended = true;
            self->wake_.cancel();
        });
    };
    std::optional<WorkerPool::Ticket> ticket;
    {
        std::shared_ptr<void> completion(nullptr, notice);
        ticket = pool.submit(
            [work = std::move(work), state, completion = std::move(completion)] {
                work();
                state->ran = true;
            });
    }
    if (!ticket) co_return JobEnd::kRefused;
    while (!state->ended) {
        if (left_) pool.cancel(*ticket);
        co_await sleep_until_woken(std::chrono::hours(24));
    }
    co_return state->ran ? JobEnd::kRan : JobEnd::kDropped;
}

net::awaitable<void> Session::sleep_until_woken(std::chrono::milliseconds at_most) {
    wake_.expires_after(at_most);
    co_await wake_.async_wait(net::as_tuple(net::use_awaitable));
}

void Session::peer_left(Connection::Departure departure, bool wants_to_stay) {
    if (departure == Connection::Departure::kReset) {
        give_up();
    } else if (wants_to_stay && connection_->received().empty()) {
        half_closed_.expires_after(kHalfClosePause);
        half_closed_.async_wait([self = shared_from_this(), number = request_number_](
                                    const boost::system::error_code& error) {
            if (error || number != self->request_number_) return;
            self->left_ = true;
            self->stop_.request_stop();
            self->wake_.cancel();
        });
    }
}

void Session::give_up() {
    gone_ = true;
    left_ = true;
    stop_.request_stop();
    wake_.cancel();
}

void Session::report_finished(const Exchange& exchange) const {
    if (!service_.hooks.finished) return;
    service_.hooks.finished(exchange.request(),
                            exchange.response.status,
                            std::chrono::duration_cast<std::chrono::microseconds>(
                                Clock::now() - exchange.began));
}

}  // namespace haarmony::http
