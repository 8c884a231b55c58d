// What the server refuses: too long, too slow, too many.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <dirent.h>
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "server/http/request_parser.h"
#include "tests/server/http/test_server.h"

namespace haarmony::http::test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;

// Short enough for a test to see it pass, while the others stay at their defaults.
constexpr milliseconds kShort{50};

TEST(ListenerLimits, SlowHeadIs408AndTheEnd) {
    TestServer server;
    server.options.header_deadline = kShort;
    server.start();
    HttpClient client(server.port());
    client.send("GET /hello HTTP/1.1\r\nHo");
    const HttpReply reply = client.receive();
    EXPECT_EQ(reply.status, 408);
    EXPECT_EQ(json::parse(reply.body)["code"], "request_timeout");
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerLimits, HeadDeadlineIsForAllBytesTogether) {
    TestServer server;
    server.options.header_deadline = kShort;
    server.start();
    HttpClient client(server.port());
    // A slow loris: each byte arrives in good time, the head never does.
    client.send("GET /hello HTTP/1.1\r\nX: ");
    std::atomic<bool> ended = false;
    std::thread loris([&] {
        while (!ended && client.send("y")) std::this_thread::sleep_for(milliseconds(5));
    });
    EXPECT_EQ(client.receive().status, 408);
    ended = true;
    loris.join();
}

TEST(ListenerLimits, SilentConnectionIsClosedWithoutAWord) {
    TestServer server;
    server.options.header_deadline = kShort;
    server.start();
    HttpClient client(server.port());
    EXPECT_TRUE(client.at_end());
    EXPECT_TRUE(server.finished().empty());
}

TEST(ListenerLimits, IdleConnectionIsClosedAfterItsDeadline) {
    TestServer server;
    server.options.idle_deadline = kShort;
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/hello").status, 200);
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerLimits, SecondHeadHasTheHeadDeadlineToo) {
    TestServer server;
    server.options.header_deadline = milliseconds(200);
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/hello").status, 200);
    client.send("GET /hello HTTP/1.1\r\n");
    EXPECT_EQ(client.receive().status, 408);
}

TEST(ListenerLimits, SlowBodyIs408AndTheEnd) {
    TestServer server;
    server.options.body_deadline = kShort;
    server.start();
    HttpClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 10\r\n\r\nabc");
    EXPECT_EQ(client.receive().status, 408);
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerLimits, HandlerMayTakeLongerThanTheReadDeadlines) {
    TestServer server;
    server.options.header_deadline = kShort;
    server.options.idle_deadline = kShort;
    server.start();
    HttpClient slow(server.port());
    slow.send("GET /gate HTTP/1.1\r\nHost: h\r\n\r\n");
    ASSERT_TRUE(server.gate.wait_for(1));
    // A second connection sees its own, equal deadline pass; by then the first one has, too.
    HttpClient silent(server.port());
    EXPECT_TRUE(silent.at_end());
    server.gate.open();
    EXPECT_EQ(slow.receive().body, "through");
}

TEST(ListenerLimits, ClientThatDoesNotReadIsDropped) {
    TestServer server;
    server.options.write_deadline = kShort;
    server.router.add("GET", "/endless", {}, [](const Request&) {
        return Response{.status = 200,
                        .headers = {},
                        .body = ChunkSource([]() -> std::optional<std::string> {
                            return std::string(100'000, 'x');
                        })};
    });
    server.start();
    HttpClient client(server.port());
    client.send("GET /endless HTTP/1.1\r\nHost: h\r\n\r\n");
    EXPECT_TRUE(eventually([&] { return server.listener->load().connections == 0; }));
}

TEST(ListenerLimits, LengthOverTheLimitIsRefusedBeforeTheBodyIsRead) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 1000001\r\n\r\n");
    const HttpReply reply = client.receive();
    EXPECT_EQ(reply.status, 413);
    EXPECT_THAT(std::string(json::parse(reply.body)["detail"]),
                testing::HasSubstr("1000001"));
    EXPECT_EQ(reply.header("connection"), "close");
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerLimits, RefusalReachesAClientThatIsStillSending) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 20000000\r\n\r\n");
    client.send(std::string(20'000'000, 'x'));
    EXPECT_EQ(client.receive().status, 413);
}

TEST(ListenerLimits, ClientThatNeverStopsSendingIsCutOff) {
    TestServer server;
    server.options.linger_deadline = kShort;
    server.start();
    HttpClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 2000000000\r\n\r\n");
    while (client.send(std::string(10'000, 'x'))) {
    }
    EXPECT_TRUE(eventually([&] { return server.listener->load().connections == 0; }));
}

TEST(ListenerLimits, ChunkedBodyIsCountedAgainstTheLimit) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    client.send("POST /echo HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n");
    const std::string chunk = "61a80\r\n" + std::string(400'000, 'x') + "\r\n";
    client.send(chunk + chunk + chunk);
    EXPECT_EQ(client.receive().status, 413);
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerLimits, BodyOfExactlyTheLimitIsTaken) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(
        client.request("POST", "/echo", "", std::string(1'000'000, 'x')).body.size(),
        1'000'000U);
}

TEST(ListenerLimits, RouteWithoutABodyTakesNone) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/hello", "Content-Length: 0\r\n").status, 200);
    EXPECT_EQ(client.request("GET", "/hello", "", "x").status, 413);
    EXPECT_TRUE(client.at_end());
}

TEST(ListenerLimits, LongTargetIs414AndLongHeadersAre431) {
    TestServer server;
    server.start();
    HttpClient target(server.port());
    EXPECT_EQ(target.get("/" + std::string(kMaxRequestLine, 'x')).status, 414);
    EXPECT_TRUE(target.at_end());
    HttpClient headers(server.port());
    EXPECT_EQ(headers.get("/hello", "X: " + std::string(kMaxHead, 'y') + "\r\n").status,
              431);
    EXPECT_TRUE(headers.at_end());
}

TEST(ListenerLimits, ConnectionsBeyondTheLimitAreTurnedAway) {
    TestServer server;
    server.options.max_connections = 2;
    server.start();
    HttpClient first(server.port());
    auto second = std::make_unique<HttpClient>(server.port());
    ASSERT_EQ(first.get("/hello").status, 200);
    ASSERT_EQ(second->get("/hello").status, 200);
    {
        HttpClient third(server.port());
        const HttpReply reply = third.get("/hello");
        EXPECT_EQ(reply.status, 503);
        EXPECT_EQ(json::parse(reply.body)["code"], "overloaded");
        EXPECT_GE(std::stoi(reply.header("retry-after")), 1);
        EXPECT_FALSE(reply.header("x-request-id").empty());
        EXPECT_TRUE(third.at_end());
    }
    EXPECT_EQ(first.get("/hello").status, 200);
    second.reset();
    ASSERT_TRUE(eventually([&] { return server.listener->load().connections == 1; }));
    EXPECT_TRUE(server.is_usable());
}

TEST(ListenerLimits, ConnectionBeyondTheLimitIsToldWhatIsInstant) {
    TestServer server;
    server.options.max_connections = 1;
    server.router.add("GET", "/alive", {.cost = Cost::kInstant}, [](const Request&) {
        return Response{.status = 200, .headers = {}, .body = "alive"};
    });
    server.start();
    HttpClient first(server.port());
    ASSERT_EQ(first.get("/hello").status, 200);
    HttpClient second(server.port());
    EXPECT_EQ(second.get("/alive").body, "alive");
    EXPECT_TRUE(second.at_end());
    EXPECT_TRUE(eventually([&] { return server.listener->load().connections == 1; }));
    HttpClient third(server.port());
    EXPECT_EQ(third.get("/hello").status, 503);
}

// A key is asked for beyond the limit, too.
TEST(ListenerLimits, ConnectionBeyondTheLimitIsToldNothingWithoutItsKey) {
    TestServer server;
    server.options.max_connections = 1;
    server.router.add("GET", "/alive", {.cost = Cost::kInstant}, [](const Request&) {
        return Response{.status = 200, .headers = {}, .body = "alive"};
    });
    server.hooks.admit = [](const Request& request,
                            const RouteOptions&) -> std::optional<Response> {
        if (request.path != "/alive") return {};
        return Response{.status = 401, .headers = {}, .body = "no key"};
    };
    server.start();
    HttpClient first(server.port());
    ASSERT_EQ(first.get("/hello").status, 200);
    EXPECT_EQ(HttpClient(server.port()).get("/alive").status, 503);
}

TEST(ListenerLimits, SilentConnectionBeyondTheLimitIsClosed) {
    TestServer server;
    server.options.max_connections = 1;
    server.options.header_deadline = std::chrono::milliseconds(100);
    server.start();
    HttpClient first(server.port());
    ASSERT_EQ(first.get("/hello").status, 200);
    EXPECT_TRUE(HttpClient(server.port()).at_end());
}

TEST(ListenerLimits, ConnectionsFarBeyondTheLimitAreClosedAtOnce) {
    TestServer server;
    server.options.max_connections = 1;
    server.options.linger_deadline = std::chrono::minutes(1);
    server.start();
    HttpClient first(server.port());
    ASSERT_EQ(first.get("/hello").status, 200);
    std::vector<std::unique_ptr<HttpClient>> more;
    int told = 0;
    for (int i = 0; i < 100; ++i) {
        more.push_back(std::make_unique<HttpClient>(server.port()));
        more.back()->send("GET /hello HTTP/1.1\r\nHost: h\r\n\r\n");
        // Either the 503, after which the server lingers, or nothing at all.
        if (!more.back()->at_end()) ++told;
    }
    EXPECT_EQ(told, 64);
    EXPECT_EQ(first.get("/hello").status, 200);
}

// The descriptors that this process has open.
rlim_t open_descriptors() {
    rlim_t highest = 0;
    DIR* folder = ::opendir("/proc/self/fd");
    while (const dirent* entry = ::readdir(folder)) {
        highest = std::max<rlim_t>(highest, std::strtoul(entry->d_name, nullptr, 10));
    }
    ::closedir(folder);
    return highest;
}

TEST(ListenerLimits, RunningOutOfDescriptorsIsSurvived) {
    TestServer server;
    server.start();
    ASSERT_TRUE(server.is_usable());
    ASSERT_TRUE(eventually([&] { return server.listener->load().connections == 0; }));
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    std::vector<int> fillers;
    HttpClient waiting(server.port());
    ASSERT_EQ(waiting.get("/hello").status, 200);
    // With the limit at what is in use and every gap filled, only the client's own new
    // socket still fits: the server cannot accept it.
    const rlimit tight{.rlim_cur = open_descriptors() + 2, .rlim_max = before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &tight), 0);
    for (int copy = ::dup(0); copy >= 0; copy = ::dup(0)) fillers.push_back(copy);
    ASSERT_FALSE(fillers.empty());
    ::close(fillers.back());
    fillers.pop_back();
    HttpClient refused(server.port());
    const bool failed =
        eventually([&] { return server.listener->load().accept_failures >= 2; });
    EXPECT_EQ(waiting.get("/hello").status, 200);
    for (const int descriptor : fillers) ::close(descriptor);
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
    EXPECT_TRUE(failed);
    EXPECT_EQ(refused.get("/hello").status, 200);
}

}  // namespace
}  // namespace haarmony::http::test
