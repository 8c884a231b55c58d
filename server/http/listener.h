// The HTTP server: accepts, reads, hands requests to the router on a pool, writes answers.
//
//   [listener] -> session -> router -> a handler of server/api
//
// Limits   deadlines on header, body, idle and write; body limit by route (413 before the
//          body is read where Content-Length tells); header limit; bounded queues (503 with
//          Retry-After when full); a limit on open connections.
// Errors   listen() fails with kIo naming the address.
// Threads  its own pools; stop() may be called from any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/core/result.h"
#include "server/http/message.h"
#include "server/http/router.h"

namespace haarmony::http {

struct ListenerOptions {
    std::string host = "127.0.0.1";
    std::uint16_t port = 8080;  // 0: any free port
    int io_threads = 1;
    int cheap_threads = 2;
    int costly_threads = 2;
    int cheap_queue = 1024;
    int costly_queue = 64;
    int max_connections = 4096;
    std::chrono::milliseconds header_deadline{15'000};
    std::chrono::milliseconds body_deadline{120'000};
    std::chrono::milliseconds idle_deadline{60'000};
    std::chrono::milliseconds write_deadline{120'000};
};

// Sees every request before its handler (keys) and every finished one (access log).
struct Hooks {
    std::function<std::optional<Response>(const Request&, const RouteOptions&)> admit;
    std::function<void(const Request&, int status, std::chrono::microseconds)> finished;
};

class Listener {
  public:
    // Starts to accept at once. `router` must outlive the listener.
    [[nodiscard]] static Result<std::unique_ptr<Listener>> listen(
        const ListenerOptions& options, const Router& router, Hooks hooks);
    ~Listener();

    [[nodiscard]] std::uint16_t port() const;

    // Accepts no more, answers what has been received in full, closes the rest, joins.
    void stop();

  private:
    class Impl;
    explicit Listener(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::http
