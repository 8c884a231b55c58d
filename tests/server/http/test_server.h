// A listener on a free port with a router to fill, and the means to hold its handlers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/http/listener.h"
#include "tests/support/http_client.h"

namespace haarmony::http::test {

using haarmony::test::HttpClient;
using haarmony::test::HttpReply;

// Whether `condition` comes true within the patience of the tests.
inline bool eventually(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + haarmony::test::kPatience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

// Handlers wait at it; the test sees how many came and lets them all go.
class Gate {
  public:
    ~Gate() { open(); }
    void pass() {
        std::unique_lock lock(mutex_);
        ++came_;
        changed_.notify_all();
        changed_.wait(lock, [this] { return open_; });
    }
    void open() {
        const std::lock_guard lock(mutex_);
        open_ = true;
        changed_.notify_all();
    }
    // False if fewer than `count` have come after the patience of the tests.
    [[nodiscard]] bool wait_for(int count) {
        std::unique_lock lock(mutex_);
        return changed_.wait_for(
            lock, haarmony::test::kPatience, [&] { return came_ >= count; });
    }
    [[nodiscard]] int came() {
        const std::lock_guard lock(mutex_);
        return came_;
    }

  private:
    std::mutex mutex_;
    std::condition_variable changed_;
    int came_ = 0;
    bool open_ = false;
};

struct Finished {
    std::string method;
    std::string path;
    std::string request_id;
    int status = 0;
};

class TestServer {
  public:
    TestServer() {
        options.port = 0;
        hooks.finished =
            [this](const Request& request, int status, std::chrono::microseconds) {
                const std::lock_guard lock(mutex_);
                finished_.push_back(
                    {request.method, request.path, request.request_id, status});
            };
        hooks.failed = [this](const Request&, std::string_view what) {
            const std::lock_guard lock(mutex_);
            failed_.emplace_back(what);
        };
        router.add("GET", "/hello", {}, [](const Request&) {
            return Response{.status = 200,
                            .headers = {{"Content-Type", "text/plain"}},
                            .body = "hello"};
        });
        // Gives back what it got.
        router.add(
            "POST", "/echo", {.body_limit = 1'000'000}, [](const Request& request) {
                return Response{.status = 200, .headers = {}, .body = request.body};
            });
        router.add("GET", "/gate", {.cost = Cost::kCostly}, [this](const Request&) {
            gate.pass();
            return Response{.status = 200, .headers = {}, .body = "through"};
        });
    }
    // The gate opens first, or a test that failed would wait for its handlers for ever.
    ~TestServer() {
        gate.open();
        listener.reset();
    }

    void start() {
        auto started = Listener::listen(options, router, hooks);
        if (!started) throw std::runtime_error(started.error().message);
        listener = *std::move(started);
    }
    [[nodiscard]] std::uint16_t port() const { return listener->port(); }

    [[nodiscard]] std::vector<Finished> finished() {
        const std::lock_guard lock(mutex_);
        return finished_;
    }
    [[nodiscard]] std::vector<std::string> failed() {
        const std::lock_guard lock(mutex_);
        return failed_;
    }
    // The server answers a fresh connection.
    [[nodiscard]] bool is_usable() {
        HttpClient client(port());
        return client.get("/hello").body == "hello";
    }

    ListenerOptions options;
    Hooks hooks;
    Router router;
    Gate gate;
    std::unique_ptr<Listener> listener;

  private:
    std::mutex mutex_;
    std::vector<Finished> finished_;
    std::vector<std::string> failed_;
};

}  // namespace haarmony::http::test
