// The end of a listener: nothing that was received in full goes unanswered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "tests/server/http/test_server.h"

namespace haarmony::http::test {
namespace {

// stop() on a thread of its own, as it waits for handlers that the test holds.
class Stopping {
  public:
    explicit Stopping(TestServer& server)
        : thread_([this, &server] {
              server.listener->stop();
              done_ = true;
          }) {}
    ~Stopping() { thread_.join(); }
    Stopping(const Stopping&) = delete;
    Stopping& operator=(const Stopping&) = delete;
    [[nodiscard]] bool done() const { return done_; }

  private:
    std::atomic<bool> done_ = false;
    std::thread thread_;
};

bool refuses_connections(std::uint16_t port) {
    try {
        HttpClient client(port);
        return client.at_end();
    } catch (const std::runtime_error&) {
        return true;
    }
}

TEST(ListenerStop, RunningAndQueuedRequestsAreAnswered) {
    TestServer server;
    server.options.costly_threads = 1;
    server.start();
    HttpClient runs(server.port());
    HttpClient waits(server.port());
    runs.send("GET /gate HTTP/1.1\r\nHost: h\r\n\r\n");
    ASSERT_TRUE(server.gate.wait_for(1));
    waits.send("GET /gate HTTP/1.1\r\nHost: h\r\n\r\n");
    ASSERT_TRUE(eventually([&] { return server.listener->load().costly_queued == 1; }));
    HttpClient idle(server.port());
    ASSERT_EQ(idle.get("/hello").status, 200);
    const Stopping stopping(server);
    EXPECT_TRUE(idle.at_end());
    EXPECT_TRUE(refuses_connections(server.port()));
    EXPECT_FALSE(stopping.done());
    server.gate.open();
    for (HttpClient* client : {&runs, &waits}) {
        const HttpReply reply = client->receive();
        EXPECT_EQ(reply.body, "through");
        EXPECT_TRUE(client->at_end());
    }
    EXPECT_TRUE(eventually([&] { return stopping.done(); }));
}

TEST(ListenerStop, RequestsThatHaveArrivedAreAnsweredEvenIfNotReadYet) {
    for (int round = 0; round < 20; ++round) {
        TestServer server;
        server.start();
        std::vector<std::unique_ptr<HttpClient>> clients;
        for (int i = 0; i < 20; ++i) {
            clients.push_back(std::make_unique<HttpClient>(server.port()));
            clients.back()->send("GET /hello HTTP/1.1\r\nHost: h\r\n\r\n");
        }
        server.listener->stop();
        for (const auto& client : clients) EXPECT_EQ(client->receive().body, "hello");
    }
}

TEST(ListenerStop, PipelinedRequestsThatHaveArrivedAreAllAnswered) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    client.send(
        "GET /gate HTTP/1.1\r\nHost: h\r\n\r\n"
        "GET /hello HTTP/1.1\r\nHost: h\r\n\r\n"
        "POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 3\r\n\r\nabc"
        "GET /hello HTTP/1.1\r\nHo");
    ASSERT_TRUE(server.gate.wait_for(1));
    const Stopping stopping(server);
    EXPECT_TRUE(eventually([&] { return refuses_connections(server.port()); }));
    server.gate.open();
    EXPECT_EQ(client.receive().body, "through");
    EXPECT_EQ(client.receive().body, "hello");
    EXPECT_EQ(client.receive().body, "abc");
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerStop, RequestsThatAreNotWholeAreDropped) {
    TestServer server;
    server.start();
    HttpClient silent(server.port());
    HttpClient head(server.port());
    HttpClient body(server.port());
    head.send("GET /hello HTTP/1.1\r\n");
    body.send("POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 5\r\n\r\nab");
    ASSERT_TRUE(eventually([&] { return server.listener->load().connections == 3; }));
    server.listener->stop();
    EXPECT_TRUE(silent.at_end());
    EXPECT_TRUE(head.at_end());
    EXPECT_TRUE(body.at_end());
}

TEST(ListenerStop, StreamThatHasNothingMoreToSayEndsWell) {
    TestServer server;
    server.router.add("GET", "/events", {}, [](const Request&) {
        return Response{
            .status = 200,
            .headers = {},
            .body = ChunkSource([sent = false]() mutable -> std::optional<std::string> {
                return std::exchange(sent, true) ? "" : "event";
            })};
    });
    server.start();
    HttpClient client(server.port());
    client.send("GET /events HTTP/1.1\r\nHost: h\r\n\r\n");
    (void)client.receive_head();
    EXPECT_EQ(client.read_some(), "5\r\nevent\r\n");
    server.listener->stop();
    EXPECT_EQ(client.read_some(), "0\r\n\r\n");
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerStop, GraceEndsWhatDoesNotEndByItself) {
    TestServer server;
    server.options.grace = std::chrono::milliseconds(50);
    server.options.costly_threads = 1;
    std::atomic<bool> heard = false;
    std::atomic<bool> started = false;
    server.router.add(
        "GET", "/long", {.cost = Cost::kCostly}, [&](const Request& request) {
            started = true;
            heard = eventually([&] { return request.cancelled.stop_requested(); });
            return Response{};
        });
    server.router.add("GET", "/endless", {}, [](const Request&) {
        return Response{.status = 200,
                        .headers = {},
                        .body = ChunkSource([] {
                            return std::optional<std::string>(std::string(1'000, 'x'));
                        })};
    });
    server.start();
    HttpClient runs(server.port());
    runs.send("GET /long HTTP/1.1\r\nHost: h\r\n\r\n");
    ASSERT_TRUE(eventually([&] { return started.load(); }));
    HttpClient queued(server.port());
    queued.send("GET /gate HTTP/1.1\r\nHost: h\r\n\r\n");
    ASSERT_TRUE(eventually([&] { return server.listener->load().costly_queued == 1; }));
    HttpClient streams(server.port());
    streams.send("GET /endless HTTP/1.1\r\nHost: h\r\n\r\n");
    (void)streams.receive_head();
    server.listener->stop();
    EXPECT_TRUE(heard);
    EXPECT_EQ(server.gate.came(), 0);
    EXPECT_TRUE(runs.at_end());
    EXPECT_TRUE(queued.at_end());
}

TEST(ListenerStop, MayBeCalledTwiceAndFromSeveralThreads) {
    TestServer server;
    server.start();
    ASSERT_TRUE(server.is_usable());
    {
        const Stopping first(server);
        const Stopping second(server);
    }
    server.listener->stop();
    EXPECT_TRUE(refuses_connections(server.port()));
}

TEST(ListenerStop, UnderLoadNoRequestIsAnsweredByHalf) {
    TestServer server;
    server.options.io_threads = 2;
    server.start();
    std::atomic<int> answered = 0;
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t) {
        threads.emplace_back([&] {
            try {
                HttpClient client(server.port());
                for (;;) {
                    const HttpReply reply = client.get("/hello");
                    EXPECT_EQ(reply.body, "hello");
                    ++answered;
                    if (reply.header("connection") == "close") return;
                }
            } catch (const std::runtime_error& error) {
                // Between two answers a connection may end, but not inside one.
                EXPECT_THAT(error.what(), testing::HasSubstr("ended in a line: ''"));
            }
        });
    }
    EXPECT_TRUE(eventually([&] { return answered > 100; }));
    server.listener->stop();
    for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace haarmony::http::test
