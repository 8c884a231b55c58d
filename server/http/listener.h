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
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/result.h"
#include "server/http/message.h"
#include "server/http/router.h"

namespace haarmony::http {

struct ListenerOptions {
    std::string host = "127.0.0.1";
    std::uint16_t port = 8080;  // 0: any free port
    int io_threads = 1;     // never busy with anything but sockets and instant requests
    int cheap_threads = 2;  // so many cheap requests run at the same time
    int costly_threads = 2;
    int cheap_queue = 1024;
    int costly_queue = 64;
    int costly_niceness = 10;  // a tenth of the processor, where others want it
    int max_connections = 4096;
    std::chrono::milliseconds header_deadline{15'000};
    std::chrono::milliseconds body_deadline{120'000};
    std::chrono::milliseconds idle_deadline{60'000};
    std::chrono::milliseconds write_deadline{120'000};  // for each 256 kB of an answer
    int stream_threads = 4;  // read files and pull ChunkSources, a chunk at a time
    std::chrono::milliseconds poll_interval{100};  // of a ChunkSource with nothing yet
    std::chrono::milliseconds linger_deadline{
        2'000};                               // for a refused body to be thrown away
    std::chrono::milliseconds grace{10'000};  // what stop() gives to open requests
};

// Sees every request before its handler (keys) and every finished one (access log). All of
// them are called from several threads; admit() runs before the body is read, so
// Request::body is empty, and on an io thread, so it must be quick. None of them may throw.
struct Hooks {
    std::function<std::optional<Response>(const Request&, const RouteOptions&)> admit;
    // A status of 499 means that the client left before the answer.
    std::function<void(const Request&, int status, std::chrono::microseconds)> finished;
    // The text of an exception from a handler or a ChunkSource, which no client sees.
    FailureReport failed;
};

// What the server holds at this moment.
struct Load {
    std::size_t connections = 0;
    std::size_t cheap_queued = 0;
    std::size_t costly_queued = 0;
    std::size_t accept_failures = 0;  // since the start: no file descriptor left, ...
};

class Listener {
  public:
    // Starts to accept at once. `router` must outlive the listener.
    [[nodiscard]] static Result<std::unique_ptr<Listener>>
    listen(const ListenerOptions& options, const Router& router, Hooks hooks);
    ~Listener();

    [[nodiscard]] std::uint16_t port() const;
    [[nodiscard]] Load load() const;

    // Accepts no more, answers what has been received in full, closes the rest, joins.
    // After ListenerOptions::grace the connections that are left are cut and
    // Request::cancelled is set; only handlers that still run are waited for.
    // Requires: not called from a handler or a hook.
    void stop();

  private:
    class Impl;
    explicit Listener(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace haarmony::http
