#include "server/http/response_head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace haarmony::http {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ResponseHead, IsStatusLineHeadersAndAnEmptyLine) {
    const Response response{
        .status = 404, .headers = {{"Content-Type", "text/plain"}}, .body = {}};
    EXPECT_EQ(response_head(response,
                            {.content_length = 7, .request_id = "id", .now = 784111777}),
              "HTTP/1.1 404 Not Found\r\n"
              "Date: Sun, 06 Nov 1994 08:49:37 GMT\r\n"
              "Server: haarmony\r\n"
              "X-Request-Id: id\r\n"
              "Content-Type: text/plain\r\n"
              "X-Content-Type-Options: nosniff\r\n"
              "Content-Length: 7\r\n"
              "\r\n");
}

TEST(ResponseHead, BodiesEndByLengthByChunksOrByClosing) {
    const Response response;
    EXPECT_THAT(response_head(response, {.chunked = true}),
                HasSubstr("Transfer-Encoding: chunked\r\n"));
    const std::string until_close = response_head(response, {.keep_alive = false});
    EXPECT_THAT(until_close, HasSubstr("Connection: close\r\n"));
    EXPECT_THAT(until_close, Not(HasSubstr("Content-Length")));
    EXPECT_THAT(until_close, Not(HasSubstr("Transfer-Encoding")));
    EXPECT_THAT(response_head(response, {.content_length = 0, .http_1_0 = true}),
                HasSubstr("Connection: keep-alive\r\n"));
}

TEST(ResponseHead, StatusesWithoutABodyHaveNoLength) {
    for (const int status : {204, 304}) {
        EXPECT_FALSE(may_have_body(status));
        const Response response{.status = status, .headers = {}, .body = {}};
        EXPECT_THAT(response_head(response, {.content_length = 5}),
                    Not(HasSubstr("Content-Length")));
    }
    EXPECT_TRUE(may_have_body(200));
}

TEST(ResponseHead, HandlersCannotSetWhatTheSessionSets) {
    const Response response{.status = 200,
                            .headers = {{"content-length", "99"},
                                        {"Transfer-Encoding", "gzip"},
                                        {"X-Request-Id", "other"},
                                        {"Server", "x"}},
                            .body = {}};
    const std::string head =
        response_head(response, {.content_length = 1, .request_id = "me"});
    EXPECT_THAT(head, Not(HasSubstr("99")));
    EXPECT_THAT(head, Not(HasSubstr("gzip")));
    EXPECT_THAT(head, Not(HasSubstr("other")));
    EXPECT_THAT(head, HasSubstr("X-Request-Id: me\r\n"));
}

TEST(ResponseHead, ValuesCannotSmuggleInAnotherHeader) {
    const Response response{
        .status = 200,
        .headers = {{"Location", "/a\r\nSet-Cookie: b"}, {"Bad Name", "x"}, {"", "y"}},
        .body = {}};
    const std::string head = response_head(response, {.content_length = 0});
    EXPECT_THAT(head, HasSubstr("Location: /a  Set-Cookie: b\r\n"));
    EXPECT_THAT(head, Not(HasSubstr("Bad Name")));
    EXPECT_THAT(head, Not(HasSubstr("\r\n: y")));
}

}  // namespace
}  // namespace haarmony::http
