#include "ingest/fetch.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/ingest/loopback_server.h"

namespace haarmony::ingest {
namespace {

FetchOptions intranet() {
    FetchOptions options;
    options.allow_private_addresses = true;
    return options;
}

ErrorCode code_of(const std::string& url, const FetchOptions& options) {
    const auto fetched = fetch(url, options);
    EXPECT_FALSE(fetched) << url;
    if (fetched) return ErrorCode::kIo;
    EXPECT_FALSE(fetched.error().message.empty());
    EXPECT_EQ(fetched.error().message.find('\n'), std::string::npos);
    return fetched.error().code;
}

TEST(Fetch, BringsTheBytes) {
    std::string body(200'000, 'x');
    body[1000] = '\0';
    const LoopbackServer server({{"/picture", http_ok(body)}});
    const auto fetched = fetch(server.url("/picture"), intranet());
    ASSERT_TRUE(fetched) << fetched.error().message;
    EXPECT_EQ(std::string(fetched->begin(), fetched->end()), body);
}

TEST(Fetch, LoopbackIsForbiddenUnlessAllowed) {
    const LoopbackServer server({{"/picture", http_ok("secret")}});
    EXPECT_EQ(code_of(server.url("/picture"), {}), ErrorCode::kForbidden);
    // The same place by a name and in other spellings.
    const std::string port =
        server.url("").substr(std::string("http://127.0.0.1").size());
    for (const std::string host : {"localhost",
                                   "127.1",
                                   "2130706433",
                                   "0x7f000001",
                                   "0.0.0.0",
                                   "[::ffff:127.0.0.1]"}) {
        EXPECT_EQ(code_of("http://" + host + port + "/picture", {}),
                  ErrorCode::kForbidden)
            << host;
    }
    EXPECT_EQ(server.requests(), 0);
}

TEST(Fetch, AProxyOfTheEnvironmentIsNotAWayAround) {
    const LoopbackServer proxy({});
    ::setenv("http_proxy", proxy.url("").c_str(), 1);
    const ErrorCode code = code_of("http://127.0.0.1:9/", {});
    ::unsetenv("http_proxy");
    EXPECT_EQ(code, ErrorCode::kForbidden);
    EXPECT_EQ(proxy.requests(), 0);
}

TEST(Fetch, OnlyHttpAndHttps) {
    for (const std::string url : {"file:///etc/passwd",
                                  "ftp://127.0.0.1/",
                                  "gopher://127.0.0.1/",
                                  "dict://127.0.0.1/",
                                  "http://",
                                  "http://user:word@127.0.0.1/",
                                  ""}) {
        EXPECT_EQ(code_of(url, intranet()), ErrorCode::kInvalidArgument) << url;
    }
}

TEST(Fetch, RedirectsAreFollowedUpToTheLimit) {
    const LoopbackServer server({{"/a", http_redirect("/b")},
                                 {"/b", http_redirect("/c")},
                                 {"/c", http_ok("there")},
                                 {"/loop", http_redirect("/loop")},
                                 {"/file", http_redirect("file:///etc/passwd")}});
    const auto fetched = fetch(server.url("/a"), intranet());
    ASSERT_TRUE(fetched) << fetched.error().message;
    EXPECT_EQ(std::string(fetched->begin(), fetched->end()), "there");
    FetchOptions one = intranet();
    one.max_redirects = 1;
    EXPECT_EQ(code_of(server.url("/a"), one), ErrorCode::kUnavailable);
    EXPECT_EQ(code_of(server.url("/loop"), intranet()), ErrorCode::kUnavailable);
    EXPECT_EQ(code_of(server.url("/file"), intranet()), ErrorCode::kInvalidArgument);
}

TEST(Fetch, TooManyBytesAnnouncedOrNot) {
    const std::string body(5'000, 'x');
    const LoopbackServer server(
        {{"/announced", http_ok(body)},
         {"/endless", "HTTP/1.1 200 OK\r\nConnection: close\r\n\r\n" + body}});
    FetchOptions small = intranet();
    small.max_bytes = 4'999;
    EXPECT_EQ(code_of(server.url("/announced"), small), ErrorCode::kTooLarge);
    EXPECT_EQ(code_of(server.url("/endless"), small), ErrorCode::kTooLarge);
    small.max_bytes = 5'000;
    EXPECT_TRUE(fetch(server.url("/announced"), small));
    EXPECT_TRUE(fetch(server.url("/endless"), small));
}

TEST(Fetch, StatusesBecomeCodes) {
    const LoopbackServer server(
        {{"/gone", "HTTP/1.1 410 Gone\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"},
         {"/broken",
          "HTTP/1.1 500 Oh\r\nContent-Length: 0\r\nConnection: close\r\n\r\n"}});
    EXPECT_EQ(code_of(server.url("/missing"), intranet()), ErrorCode::kNotFound);
    EXPECT_EQ(code_of(server.url("/gone"), intranet()), ErrorCode::kNotFound);
    const auto broken = fetch(server.url("/broken"), intranet());
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().code, ErrorCode::kUnavailable);
    EXPECT_NE(broken.error().message.find("500"), std::string::npos);
}

TEST(Fetch, CutOffSilentAndAbsentServersAreUnavailable) {
    std::string url;
    {
        const LoopbackServer server(
            {{"/cut",
              "HTTP/1.1 200 OK\r\nContent-Length: 100\r\nConnection: close\r\n\r\nshort"},
             {"/noise", "\x01\x02\x03 not http at all\r\n\r\n"},
             {"/silent", LoopbackServer::kSilence}});
        EXPECT_EQ(code_of(server.url("/cut"), intranet()), ErrorCode::kUnavailable);
        EXPECT_EQ(code_of(server.url("/noise"), intranet()), ErrorCode::kUnavailable);
        FetchOptions hasty = intranet();
        hasty.total = std::chrono::milliseconds(100);
        EXPECT_EQ(code_of(server.url("/silent"), hasty), ErrorCode::kUnavailable);
        url = server.url("/");
    }
    EXPECT_EQ(code_of(url, intranet()), ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace haarmony::ingest
