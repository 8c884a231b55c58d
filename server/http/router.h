// Which handler answers which address.
//
// Answers 404 for an unknown path, 405 with `Allow` for a known path and another method,
// HEAD by GET (the session leaves the body out), and OPTIONS with `Allow`. A literal segment
// beats a parameter; "/images/" is not "/images".
//
// Errors   a handler's exception is a 500 without its text, which goes to FailureReport.
// Threads  add() before serving; dispatch() from any thread.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace haarmony::http {

// Cheap requests never wait behind costly ones: they have a pool each, and the threads of the
// costly one give way to all others. Instant ones wait for nobody: they are answered on an io
// thread, even where the queues or the connections are full. Their handlers must not block.
enum class Cost { kInstant, kCheap, kCostly };

struct RouteOptions {
    Cost cost = Cost::kCheap;
    std::uint64_t body_limit = 0;  // bytes; 0: the route takes no body
    bool open = false;             // needs no key: health, readiness, the static page
    // Where the cost depends on the request: asked instead of `cost` once the body is there,
    // on an io thread, so it must be quick; it must not throw.
    std::function<Cost(const Request&)> cost_of{};

    [[nodiscard]] Cost cost_for(const Request& request) const {
        return cost_of ? cost_of(request) : cost;
    }
};

struct RouteMatch {
    const RouteOptions* options = nullptr;  // null: no handler; 404, 405 or OPTIONS
    bool open = false;                      // some method of this path needs no key
};

// Hears the text of an exception that a handler let go; for the log only.
using FailureReport = std::function<void(const Request&, std::string_view what)>;

class Router {
  public:
    Router();
    ~Router();
    Router(const Router&) = delete;
    Router& operator=(const Router&) = delete;

    // `pattern` is a path whose segments may be "{name}", e.g. "/images/{id}/thumbnail".
    // Requires: the same method and pattern are added once.
    void add(std::string_view method,
             std::string_view pattern,
             const RouteOptions& options,
             Handler handler);
    // Answers whatever no pattern matches, for GET and HEAD: the static page.
    void set_fallback(const RouteOptions& options, Handler handler);

    // Before the body is read: how large it may be and which pool it goes to.
    [[nodiscard]] RouteMatch match(std::string_view method, std::string_view path) const;

    // The whole answer. A handler's std::exception becomes a 500 without its text.
    [[nodiscard]] Response dispatch(Request& request) const;
    [[nodiscard]] Response dispatch(Request& request, const FailureReport& report) const;

  private:
    struct Route;
    struct Node;
    struct Found;
    [[nodiscard]] Found find(std::string_view path) const;
    [[nodiscard]] Response answer_without_route(Request& request,
                                                const Found& found,
                                                const FailureReport& report) const;

    std::unique_ptr<Node> root_;
    RouteOptions fallback_options_;
    Handler fallback_;
};

}  // namespace haarmony::http
