#include "server/http/listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "server/http/request_id.h"
#include "tests/server/http/test_server.h"

namespace haarmony::http::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Listener, AnswersOverOneConnectionAsOftenAsAsked) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    for (int i = 0; i < 50; ++i) {
        const HttpReply reply = client.get("/hello");
        ASSERT_EQ(reply.status, 200);
        EXPECT_EQ(reply.reason, "OK");
        EXPECT_EQ(reply.body, "hello");
        EXPECT_EQ(reply.header("server"), "haarmony");
        EXPECT_THAT(reply.header("date"), testing::EndsWith(" GMT"));
        EXPECT_EQ(reply.header("x-content-type-options"), "nosniff");
    }
    EXPECT_EQ(server.listener->load().connections, 1U);
}

TEST(Listener, AddressInUseIsNamed) {
    TestServer server;
    server.start();
    ListenerOptions options;
    options.port = server.port();
    const auto second = Listener::listen(options, server.router, {});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kIo);
    EXPECT_THAT(second.error().message,
                HasSubstr("127.0.0.1:" + std::to_string(server.port())));
}

TEST(Listener, AddressThatIsNoneIsNamed) {
    TestServer server;
    server.options.host = "not an address";
    const auto listener = Listener::listen(server.options, server.router, {});
    ASSERT_FALSE(listener);
    EXPECT_THAT(listener.error().message, HasSubstr("not an address"));
}

TEST(Listener, RequestIdIsEchoedOrMadeOnEveryAnswer) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/hello", "X-Request-Id: mine\r\n").header("x-request-id"),
              "mine");
    EXPECT_TRUE(is_request_id(client.get("/hello").header("x-request-id")));
    const HttpReply missing = client.get("/none", "X-Request-Id: lost\r\n");
    EXPECT_EQ(missing.status, 404);
    EXPECT_EQ(missing.header("x-request-id"), "lost");
    EXPECT_EQ(json::parse(missing.body)["request_id"], "lost");
    client.send("GET /%zz HTTP/1.1\r\nHost: h\r\nX-Request-Id: bad\r\n\r\n");
    EXPECT_EQ(client.receive().header("x-request-id"), "bad");
}

TEST(Listener, PipelinedRequestsAreAnsweredInOrder) {
    TestServer server;
    server.options.cheap_threads = 4;
    server.start();
    HttpClient client(server.port());
    std::string all;
    for (int i = 0; i < 200; ++i) {
        const std::string body = "body " + std::to_string(i);
        all += "POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: " +
               std::to_string(body.size()) + "\r\n\r\n" + body;
    }
    client.send(all);
    for (int i = 0; i < 200; ++i) {
        EXPECT_EQ(client.receive().body, "body " + std::to_string(i));
    }
}

TEST(Listener, ChunkedRequestBodiesArriveWhole) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    for (int i = 0; i < 2; ++i) {
        client.send(
            "POST /echo HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n");
        client.send("3\r\nabc\r\n");
        client.send("2;x=y\r\nde\r\n0\r\n\r\n");
        EXPECT_EQ(client.receive().body, "abcde");
    }
}

TEST(Listener, LargeBodiesGoBothWays) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    std::string body(1'000'000, '\0');
    for (std::size_t i = 0; i < body.size(); ++i)
        body[i] = static_cast<char>(i * 31 + i / 256);
    EXPECT_EQ(client.request("POST", "/echo", "", body).body, body);
}

TEST(Listener, ExpectContinueIsAnsweredBeforeTheBody) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    client.send(
        "POST /echo HTTP/1.1\r\nHost: h\r\nExpect: 100-continue\r\nContent-Length: "
        "2\r\n\r\n");
    EXPECT_EQ(client.receive().status, 100);
    client.send("ab");
    EXPECT_EQ(client.receive().body, "ab");
    // Not to HTTP/1.0, and not once the body is on its way.
    client.send(
        "POST /echo HTTP/1.1\r\nHost: h\r\nExpect: 100-continue\r\nContent-Length: "
        "2\r\n\r\ncd");
    EXPECT_EQ(client.receive().body, "cd");
    client.send(
        "POST /echo HTTP/1.0\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n");
    client.send("ef");
    EXPECT_EQ(client.receive().body, "ef");
}

TEST(Listener, RefusedExpectationIsNotToldToContinue) {
    TestServer server;
    server.start();
    for (const auto& [request, status] : {
             std::pair{"POST /echo HTTP/1.1\r\nHost: h\r\nExpect: 100-continue\r\n"
                       "Content-Length: 1000001\r\n\r\n",
                       413},
             std::pair{"POST /none HTTP/1.1\r\nHost: h\r\nExpect: 100-continue\r\n"
                       "Content-Length: 5\r\n\r\n",
                       404},
             std::pair{"POST /echo HTTP/1.1\r\nHost: h\r\nExpect: miracles\r\n"
                       "Content-Length: 5\r\n\r\n",
                       417},
         }) {
        HttpClient client(server.port());
        client.send(request);
        const HttpReply reply = client.receive();
        EXPECT_EQ(reply.status, status);
        EXPECT_EQ(reply.header("connection"), "close");
        EXPECT_TRUE(client.at_end());
    }
}

TEST(Listener, EncodedRequestBodiesAre415) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    const HttpReply reply =
        client.request("POST", "/echo", "Content-Encoding: gzip\r\n", "\x1f\x8b");
    EXPECT_EQ(reply.status, 415);
    EXPECT_EQ(json::parse(reply.body)["param"], "Content-Encoding");
    HttpClient plain(server.port());
    EXPECT_EQ(plain.request("POST", "/echo", "Content-Encoding: identity\r\n", "x").body,
              "x");
}

TEST(Listener, Http10ClosesUnlessAskedToStay) {
    TestServer server;
    server.start();
    HttpClient once(server.port());
    once.send("GET /hello HTTP/1.0\r\n\r\n");
    const HttpReply reply = once.receive();
    EXPECT_EQ(reply.body, "hello");
    EXPECT_EQ(reply.header("connection"), "close");
    EXPECT_TRUE(once.at_end());

    HttpClient stays(server.port());
    for (int i = 0; i < 2; ++i) {
        stays.send("GET /hello HTTP/1.0\r\nConnection: keep-alive\r\n\r\n");
        EXPECT_EQ(stays.receive().header("connection"), "keep-alive");
    }
}

TEST(Listener, ConnectionCloseIsHonoured) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    const HttpReply reply = client.get("/hello", "Connection: close\r\n");
    EXPECT_EQ(reply.header("connection"), "close");
    EXPECT_TRUE(client.at_end());
}

TEST(Listener, AnswerSurvivesWhatIsSentBehindTheLastRequest) {
    TestServer server;
    server.start();
    for (int round = 0; round < 20; ++round) {
        HttpClient client(server.port());
        client.send("GET /hello HTTP/1.1\r\nHost: h\r\nConnection: close\r\n\r\n" +
                    std::string(300'000, 'x'));
        EXPECT_EQ(client.receive().body, "hello");
        EXPECT_TRUE(client.at_end());
    }
}

TEST(Listener, ClientThatClosesItsHalfIsStillAnswered) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    client.send("GET /hello HTTP/1.1\r\nHost: h\r\nConnection: close\r\n\r\n");
    client.finish_sending();
    EXPECT_EQ(client.receive().body, "hello");
}

TEST(Listener, HeadHasTheHeadersOfGetAndNoBody) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    const HttpReply get = client.get("/hello", "X-Request-Id: a\r\n");
    HttpReply head = client.request("HEAD", "/hello", "X-Request-Id: a\r\n");
    head.headers["date"] = get.header("date");
    EXPECT_EQ(head.headers, get.headers);
    EXPECT_EQ(head.header("content-length"), "5");
    const HttpReply missing = client.request("HEAD", "/none");
    EXPECT_EQ(missing.status, 404);
    EXPECT_EQ(client.get("/hello").body, "hello");
}

TEST(Listener, UnknownPathsMethodsAndOptionsAreTheRouters) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/none").status, 404);
    const HttpReply refused = client.request("DELETE", "/hello");
    EXPECT_EQ(refused.status, 405);
    EXPECT_EQ(refused.header("allow"), "GET, HEAD, OPTIONS");
    EXPECT_EQ(refused.header("content-type"), "application/problem+json");
    const HttpReply options = client.request("OPTIONS", "/hello");
    EXPECT_EQ(options.status, 204);
    EXPECT_FALSE(options.headers.contains("content-length"));
    EXPECT_EQ(client.request("OPTIONS", "*").status, 204);
    EXPECT_EQ(client.get("/hello").status, 200);
}

TEST(Listener, MalformedRequestIsAProblemAndTheEnd) {
    TestServer server;
    server.start();
    for (const auto& [bytes, status] : {
             std::pair{"\x16\x03\x01\x02\x03", 400},
             std::pair{"GET / HTTP/1.1\r\n\r\n", 400},
             std::pair{"GET / HTTP/3.0\r\nHost: h\r\n\r\n", 505},
             std::pair{
                 "POST /echo HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: gzip, chunked"
                 "\r\n\r\n",
                 501},
         }) {
        HttpClient client(server.port());
        client.send(bytes);
        const HttpReply reply = client.receive();
        EXPECT_EQ(reply.status, status);
        EXPECT_EQ(reply.header("content-type"), "application/problem+json");
        EXPECT_EQ(json::parse(reply.body)["request_id"], reply.header("x-request-id"));
        EXPECT_TRUE(client.at_end());
    }
}

TEST(Listener, RequestsCutAtEveryByteLeaveItUsable) {
    TestServer server;
    server.start();
    const std::string request =
        "POST /echo HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n"
        "3\r\nabc\r\n0\r\n\r\n";
    for (std::size_t size = 0; size <= request.size(); ++size) {
        HttpClient cut(server.port());
        cut.send(request.substr(0, size));
        if (size % 2 == 0) cut.reset();
    }
    ASSERT_TRUE(eventually([&] { return server.listener->load().connections == 0; }));
    EXPECT_TRUE(server.is_usable());
}

TEST(Listener, BytesOneByOneAreARequestToo) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    const std::string request =
        "POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 3\r\n\r\nabc";
    for (const char c : request) client.send({&c, 1});
    EXPECT_EQ(client.receive().body, "abc");
}

TEST(Listener, ManyConnectionsAtOnceEachGetTheirOwnAnswer) {
    TestServer server;
    server.options.io_threads = 2;
    server.start();
    std::vector<std::thread> threads;
    for (int t = 0; t < 8; ++t) {
        threads.emplace_back([&, t] {
            std::vector<std::unique_ptr<HttpClient>> clients;
            for (int c = 0; c < 25; ++c) {
                clients.push_back(std::make_unique<HttpClient>(server.port()));
            }
            for (int round = 0; round < 4; ++round) {
                for (std::size_t c = 0; c < clients.size(); ++c) {
                    const std::string body =
                        std::to_string(t * 10'000 + static_cast<int>(c));
                    EXPECT_EQ(clients[c]->request("POST", "/echo", "", body).body, body);
                }
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_TRUE(eventually([&] { return server.finished().size() == 800; }));
}

TEST(Listener, HandlersExceptionIsA500AndTheLogHearsWhy) {
    TestServer server;
    server.router.add("GET", "/throws", {}, [](const Request&) -> Response {
        throw std::runtime_error("secret");
    });
    server.start();
    HttpClient client(server.port());
    const HttpReply reply = client.get("/throws");
    EXPECT_EQ(reply.status, 500);
    EXPECT_EQ(json::parse(reply.body)["code"], "internal");
    EXPECT_THAT(reply.body, testing::Not(HasSubstr("secret")));
    EXPECT_THAT(server.failed(), testing::ElementsAre("secret"));
    EXPECT_EQ(client.get("/hello").status, 200);
}

TEST(Listener, FinishedRequestsAreReportedWithTheirStatus) {
    TestServer server;
    server.start();
    HttpClient client(server.port());
    (void)client.get("/hello", "X-Request-Id: a\r\n");
    (void)client.get("/none", "X-Request-Id: b\r\n");
    client.send("nonsense\r\n\r\n");
    (void)client.receive();
    ASSERT_TRUE(eventually([&] { return server.finished().size() == 3; }));
    const auto finished = server.finished();
    EXPECT_EQ(finished[0].method, "GET");
    EXPECT_EQ(finished[0].path, "/hello");
    EXPECT_EQ(finished[0].request_id, "a");
    EXPECT_EQ(finished[0].status, 200);
    EXPECT_EQ(finished[1].status, 404);
    EXPECT_EQ(finished[2].status, 400);
}

TEST(Listener, AdmissionComesBeforeTheBodyAndKnowsOpenRoutes) {
    TestServer server;
    server.router.add("GET", "/healthz", {.open = true}, [](const Request&) {
        return Response{.status = 200, .headers = {}, .body = "well"};
    });
    server.hooks.admit = [](const Request& request,
                            const RouteOptions& options) -> std::optional<Response> {
        if (options.open || request.header("X-Api-Key") == "k") return std::nullopt;
        return Response{
            .status = 401, .headers = {{"WWW-Authenticate", "Bearer"}}, .body = "no"};
    };
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/hello").status, 401);
    EXPECT_EQ(client.get("/none").status, 401);
    EXPECT_EQ(client.get("/healthz").status, 200);
    EXPECT_EQ(client.request("DELETE", "/healthz").status, 405);
    EXPECT_EQ(client.get("/hello", "X-Api-Key: k\r\n").status, 200);
    // The body of 1 MB is promised, but never sent.
    client.send("POST /echo HTTP/1.1\r\nHost: h\r\nContent-Length: 1000000\r\n\r\n");
    EXPECT_EQ(client.receive().status, 401);
    EXPECT_TRUE(client.at_end());
}

TEST(Listener, HandlerSeesTheWholeRequest) {
    TestServer server;
    Request seen;
    server.router.add("GET", "/images/{id}", {}, [&](const Request& request) {
        seen = request;
        return Response{.status = 204, .headers = {}, .body = {}};
    });
    server.start();
    HttpClient client(server.port());
    EXPECT_EQ(client.get("/images/a%20b?x=1&y=%C3%A9", "Accept: text/html\r\n").status,
              204);
    EXPECT_EQ(seen.path_parameters.at("id"), "a b");
    ASSERT_EQ(seen.query.size(), 2U);
    EXPECT_EQ(seen.query[1].second, "\xC3\xA9");
    EXPECT_EQ(seen.header("accept"), "text/html");
    EXPECT_THAT(seen.remote, testing::StartsWith("127.0.0.1:"));
}

}  // namespace
}  // namespace haarmony::http::test
