// Full queues, and clients that leave before their answer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/server/http/test_server.h"

namespace haarmony::http::test {
namespace {

constexpr const char* kGate = "GET /gate HTTP/1.1\r\nHost: h\r\n\r\n";
constexpr const char* kCheapGate = "GET /cheap-gate HTTP/1.1\r\nHost: h\r\n\r\n";

// One thread of each kind, the costly one held at the gate, and queues of the given size.
class Overloaded {
  public:
    explicit Overloaded(int queue) {
        server.options.costly_threads = 1;
        server.options.costly_queue = queue;
        server.options.cheap_threads = 1;
        server.options.cheap_queue = queue;
        server.router.add("GET", "/cheap-gate", {}, [this](const Request&) {
            server.gate.pass();
            return Response{.status = 200, .headers = {}, .body = "through"};
        });
        server.router.add("GET", "/alive", {.cost = Cost::kInstant}, [](const Request&) {
            return Response{.status = 200, .headers = {}, .body = "alive"};
        });
        server.router.add(
            "POST",
            "/either",
            {.cost = Cost::kCostly,
             .body_limit = 100,
             .cost_of =
                 [](const Request& request) {
                     return request.body == "cheap" ? Cost::kCheap : Cost::kCostly;
                 }},
            [](const Request& request) {
                return Response{.status = 200, .headers = {}, .body = request.body};
            });
        server.start();
        holder = std::make_unique<HttpClient>(server.port());
        holder->send(kGate);
        EXPECT_TRUE(server.gate.wait_for(1));
    }
    [[nodiscard]] bool queued(std::size_t count) {
        return eventually([&] { return server.listener->load().costly_queued == count; });
    }

    TestServer server;
    std::unique_ptr<HttpClient> holder;
};

TEST(ListenerOverload, FullQueueIs503WhileCheapRequestsPass) {
    Overloaded overloaded(2);
    TestServer& server = overloaded.server;
    HttpClient second(server.port());
    HttpClient third(server.port());
    second.send(kGate);
    third.send(kGate);
    ASSERT_TRUE(overloaded.queued(2));
    HttpClient fourth(server.port());
    const HttpReply refused = fourth.get("/gate");
    EXPECT_EQ(refused.status, 503);
    EXPECT_GE(std::stoi(refused.header("retry-after")), 1);
    EXPECT_EQ(nlohmann::json::parse(refused.body)["code"], "overloaded");
    // The connection that was refused is still good, and the cheap pool is free.
    EXPECT_EQ(fourth.get("/hello").body, "hello");
    server.gate.open();
    EXPECT_EQ(overloaded.holder->receive().body, "through");
    EXPECT_EQ(second.receive().body, "through");
    EXPECT_EQ(third.receive().body, "through");
    EXPECT_EQ(fourth.get("/gate").body, "through");
}

// Both queues are full, and every thread is held.
TEST(ListenerOverload, InstantRequestsPassFullQueues) {
    Overloaded overloaded(1);
    TestServer& server = overloaded.server;
    HttpClient waiting(server.port());
    waiting.send(kGate);
    ASSERT_TRUE(overloaded.queued(1));
    HttpClient held(server.port());
    held.send(kCheapGate);
    ASSERT_TRUE(server.gate.wait_for(2));
    HttpClient cheap(server.port());
    cheap.send(kCheapGate);
    ASSERT_TRUE(eventually([&] { return server.listener->load().cheap_queued == 1; }));

    HttpClient client(server.port());
    for (const char* target : {"/gate", "/cheap-gate", "/hello"}) {
        const HttpReply refused = client.get(target);
        EXPECT_EQ(refused.status, 503) << target;
        EXPECT_EQ(refused.header("content-type"), "application/problem+json") << target;
        EXPECT_GE(std::stoi(refused.header("retry-after")), 1) << target;
        EXPECT_EQ(nlohmann::json::parse(refused.body)["code"], "overloaded") << target;
        EXPECT_EQ(client.get("/alive").body, "alive") << target;
    }
    server.gate.open();
    EXPECT_EQ(cheap.receive().body, "through");
    EXPECT_EQ(client.get("/hello").body, "hello");
}

// The body decides: the same route is answered while its costly requests wait.
TEST(ListenerOverload, RequestThatIsCheapInFactPassesTheCostlyOnesOfItsRoute) {
    Overloaded overloaded(1);
    TestServer& server = overloaded.server;
    HttpClient waiting(server.port());
    waiting.send("POST /either HTTP/1.1\r\nHost: h\r\nContent-Length: 6\r\n\r\ncostly");
    ASSERT_TRUE(overloaded.queued(1));
    HttpClient passing(server.port());
    passing.send("POST /either HTTP/1.1\r\nHost: h\r\nContent-Length: 5\r\n\r\ncheap");
    EXPECT_EQ(passing.receive().body, "cheap");
    EXPECT_TRUE(overloaded.queued(1));
    server.gate.open();
    EXPECT_EQ(waiting.receive().body, "costly");
}

TEST(ListenerOverload, ClientThatLeavesTakesItsQueuedRequestWithIt) {
    Overloaded overloaded(10);
    TestServer& server = overloaded.server;
    auto leaves = std::make_unique<HttpClient>(server.port());
    auto resets = std::make_unique<HttpClient>(server.port());
    HttpClient stays(server.port());
    leaves->send(kGate);
    resets->send(kGate);
    stays.send(kGate);
    ASSERT_TRUE(overloaded.queued(3));
    leaves.reset();
    resets->reset();
    ASSERT_TRUE(overloaded.queued(1));
    server.gate.open();
    EXPECT_EQ(stays.receive().body, "through");
    EXPECT_EQ(overloaded.holder->receive().body, "through");
    EXPECT_EQ(server.gate.came(), 2);
    ASSERT_TRUE(eventually([&] { return server.finished().size() == 4; }));
    int left = 0;
    for (const Finished& finished : server.finished())
        left += finished.status == 499 ? 1 : 0;
    EXPECT_EQ(left, 2);
}

TEST(ListenerOverload, ClientThatOnlyClosedItsHalfKeepsItsPlaceInTheQueue) {
    Overloaded overloaded(10);
    HttpClient half(overloaded.server.port());
    half.send("GET /gate HTTP/1.1\r\nHost: h\r\nConnection: close\r\n\r\n");
    half.finish_sending();
    ASSERT_TRUE(overloaded.queued(1));
    overloaded.server.gate.open();
    EXPECT_EQ(half.receive().body, "through");
}

TEST(ListenerOverload, PipelinedRequestsBehindAQueuedOneAreNotLost) {
    Overloaded overloaded(10);
    HttpClient client(overloaded.server.port());
    client.send(std::string(kGate) + "GET /hello HTTP/1.1\r\nHost: h\r\n\r\n");
    client.finish_sending();
    ASSERT_TRUE(overloaded.queued(1));
    overloaded.server.gate.open();
    EXPECT_EQ(client.receive().body, "through");
    EXPECT_EQ(client.receive().body, "hello");
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerOverload, HandlerHearsThatItsClientLeft) {
    TestServer server;
    std::atomic<bool> started = false;
    std::atomic<bool> heard = false;
    server.router.add(
        "GET", "/long", {.cost = Cost::kCostly}, [&](const Request& request) {
            started = true;
            heard = eventually([&] { return request.cancelled.stop_requested(); });
            return Response{};
        });
    server.start();
    auto client = std::make_unique<HttpClient>(server.port());
    client->send("GET /long HTTP/1.1\r\nHost: h\r\n\r\n");
    ASSERT_TRUE(eventually([&] { return started.load(); }));
    client.reset();
    EXPECT_TRUE(eventually([&] { return heard.load(); }));
}

}  // namespace
}  // namespace haarmony::http::test
