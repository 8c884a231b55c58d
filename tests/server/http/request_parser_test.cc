#include "server/http/request_parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "server/http/request_id.h"

namespace haarmony::http {
namespace {

using State = RequestParser::State;
using testing::HasSubstr;

// Gives the bytes in pieces of `piece`, as a session does, with a body limit of 100.
// Returns how many bytes the request took.
std::size_t feed_all(RequestParser& parser, std::string_view bytes, std::size_t piece) {
    std::string received;
    std::size_t taken = 0;
    for (std::size_t at = 0; at <= bytes.size(); at += piece) {
        received += bytes.substr(at, piece);
        for (;;) {
            const std::size_t used = parser.feed(received);
            received.erase(0, used);
            taken += used;
            if (parser.state() != State::kHeadDone) break;
            parser.begin_body(100);
        }
        if (parser.state() == State::kDone || parser.state() == State::kBad) break;
    }
    return taken;
}

int status_of(std::string_view bytes, std::size_t piece = 1'000'000) {
    RequestParser parser;
    feed_all(parser, bytes, piece);
    return parser.state() == State::kBad ? parser.problem().status : 0;
}

constexpr std::string_view kChunked =
    "POST /query?limit=3 HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n"
    "X-Request-Id: me\r\n\r\n5\r\nhello\r\n6;ext=\"a\"\r\n world\r\n0\r\nTrailer: "
    "t\r\n\r\n";

TEST(RequestParser, ReadsARequestInPiecesOfAnySize) {
    const std::string next = "GET / HTTP/1.1\r\n";
    const std::string bytes = std::string(kChunked) + next;
    for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
        RequestParser parser;
        const std::size_t taken = feed_all(parser, bytes, piece);
        ASSERT_EQ(parser.state(), State::kDone) << piece;
        EXPECT_EQ(taken, kChunked.size()) << piece;
        EXPECT_EQ(parser.request().method, "POST");
        EXPECT_EQ(parser.request().path, "/query");
        ASSERT_EQ(parser.request().query.size(), 1U);
        EXPECT_EQ(parser.request().query[0].second, "3");
        EXPECT_EQ(parser.request().body, "hello world");
        EXPECT_EQ(parser.request().request_id, "me");
        EXPECT_EQ(parser.request().header("TRAILER"), "");
        EXPECT_TRUE(parser.keep_alive());
    }
}

TEST(RequestParser, EveryTruncationWaitsForMore) {
    for (std::size_t size = 0; size < kChunked.size(); ++size) {
        RequestParser parser;
        feed_all(parser, kChunked.substr(0, size), 7);
        EXPECT_TRUE(parser.state() == State::kHead || parser.state() == State::kBody)
            << size;
    }
}

TEST(RequestParser, DamagedRequestsNeverCrashIt) {
    std::mt19937 random(11);
    for (int i = 0; i < 20'000; ++i) {
        std::string bytes(kChunked);
        for (auto n = 1 + random() % 3; n > 0; --n) {
            bytes[random() % bytes.size()] = static_cast<char>(random());
        }
        RequestParser parser;
        feed_all(parser, bytes, 1 + random() % 50);
        if (parser.state() == State::kBad) {
            EXPECT_GE(parser.problem().status, 400);
            EXPECT_LT(parser.problem().status, 506);
        }
    }
}

TEST(RequestParser, RequestWithoutABodyIsDoneAfterItsHead) {
    RequestParser parser;
    feed_all(parser, "GET /a%20b HTTP/1.0\r\n\r\n", 5);
    EXPECT_EQ(parser.state(), State::kDone);
    EXPECT_EQ(parser.request().path, "/a b");
    EXPECT_TRUE(parser.is_http_1_0());
    EXPECT_FALSE(parser.keep_alive());
    EXPECT_FALSE(parser.has_body());
    EXPECT_TRUE(is_request_id(parser.request().request_id));
}

TEST(RequestParser, EmptyLinesBeforeARequestAreSkipped) {
    EXPECT_EQ(status_of("\r\n\r\nGET / HTTP/1.0\r\n\r\n", 1), 0);
    RequestParser parser;
    feed_all(parser, "\r\n\r\nGET / HTTP/1.0\r\n\r\n", 1);
    EXPECT_EQ(parser.state(), State::kDone);
}

TEST(RequestParser, LinesOfOneHeaderBecomeAList) {
    RequestParser parser;
    feed_all(parser,
             "GET / HTTP/1.1\r\nHost: h\r\nAccept: a\r\naccept: b\r\nCookie: c=1\r\n"
             "Cookie: d=2\r\n\r\n",
             1000);
    EXPECT_EQ(parser.request().header("Accept"), "a, b");
    EXPECT_EQ(parser.request().header("cookie"), "c=1; d=2");
}

TEST(RequestParser, OnlySaneRequestIdsAreEchoed) {
    for (const std::string& bad : {std::string("two words"),
                                   std::string(129, 'x'),
                                   std::string("caf\xC3\xA9"),
                                   std::string()}) {
        RequestParser parser;
        feed_all(parser,
                 "GET / HTTP/1.1\r\nHost: h\r\nX-Request-Id: " + bad + "\r\n\r\n",
                 1000);
        EXPECT_NE(parser.request().request_id, bad);
        EXPECT_TRUE(is_request_id(parser.request().request_id));
    }
    RequestParser parser;
    const std::string longest(128, '~');
    feed_all(parser,
             "GET / HTTP/1.1\r\nHost: h\r\nX-Request-Id: " + longest + "\r\n\r\n",
             1000);
    EXPECT_EQ(parser.request().request_id, longest);
}

TEST(RequestParser, RequestIdIsKnownEvenIfALaterHeaderIsMalformed) {
    RequestParser parser;
    feed_all(parser, "GET / HTTP/1.1\r\nX-Request-Id: me\r\nbad header\r\n\r\n", 1000);
    EXPECT_EQ(parser.state(), State::kBad);
    EXPECT_EQ(parser.request().request_id, "me");
}

TEST(RequestId, IsNeverTheSameTwice) { EXPECT_NE(make_request_id(), make_request_id()); }

class Malformed : public testing::TestWithParam<const char*> {};

TEST_P(Malformed, RequestIs400InPiecesToo) {
    EXPECT_EQ(status_of(GetParam()), 400) << GetParam();
    EXPECT_EQ(status_of(GetParam(), 1), 400) << GetParam();
}

INSTANTIATE_TEST_SUITE_P(
    Framing,
    Malformed,
    testing::Values(
        "\x16\x03\x01\x02",  // TLS
        "GET\r\n\r\n",
        "GET /\r\n\r\n",
        "GET / FTP/1.1\r\n\r\n",
        "GET  / HTTP/1.1\r\nHost: h\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: h\r\nno colon\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: h\r\nA : b\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: h\r\nA: b\x01\r\n\r\n",
        "GET / HTTP/1.1\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n",
        "GET /%zz HTTP/1.1\r\nHost: h\r\n\r\n",
        "GET relative HTTP/1.1\r\nHost: h\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nContent-Length: x\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nContent-Length: -1\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nContent-Length: 99999999999999999999\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nContent-Length: 1\r\nTransfer-Encoding: "
        "chunked\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\nContent-Length: "
        "1\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: gzip\r\nContent-Length: "
        "1\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked, gzip\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked, chunked\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: identity\r\n\r\n",
        "POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\nxyz\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n-1\r\n\r\n",
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: "
        "chunked\r\n\r\n1\r\nabc\r\n\r\n"));

TEST(RequestParser, OtherVersionsAre505) {
    EXPECT_EQ(status_of("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n"), 505);
    EXPECT_EQ(status_of("GET / HTTP/0.9\r\n\r\n"), 505);
    // Only where the version stands: what follows may arrive later, and change nothing.
    EXPECT_EQ(status_of("GET / x HTTP/0.9\r\n\r\n"), 400);
    EXPECT_EQ(status_of("S S \n8HTTP/ x HTTP/0.9\r\n\r\n"), 400);
}

TEST(RequestParser, OtherTransferCodingsAre501) {
    EXPECT_EQ(
        status_of(
            "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: gzip, chunked\r\n\r\n"),
        501);
    EXPECT_EQ(status_of("POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: gzip\r\n"
                        "Transfer-Encoding: chunked\r\n\r\n"),
              501);
}

TEST(RequestParser, LongTargetIs414BeforeItsEndIsSeen) {
    for (const std::size_t piece : {1'000U, 1'000'000U}) {
        EXPECT_EQ(status_of("GET /" + std::string(kMaxRequestLine, 'x'), piece), 414);
        EXPECT_EQ(status_of("GET /" + std::string(100'000, 'x') + " HTTP/1.1\r\n", piece),
                  414);
    }
    EXPECT_EQ(status_of("GET /" + std::string(kMaxRequestLine - 20, 'x') +
                        " HTTP/1.1\r\nHost: h\r\n\r\n"),
              0);
}

TEST(RequestParser, LongHeadIs431InOneLineOrInMany) {
    std::string many = "GET / HTTP/1.1\r\nHost: h\r\n";
    while (many.size() < kMaxHead) many += "A: b\r\n";
    const std::string one =
        "GET / HTTP/1.1\r\nHost: h\r\nA: " + std::string(kMaxHead, 'b');
    for (const std::size_t piece : {1U, 100U, 1'000'000U}) {
        EXPECT_EQ(status_of(many, piece), 431) << piece;
        EXPECT_EQ(status_of(many + "\r\n", piece), 431) << piece;
        EXPECT_EQ(status_of(one, piece), 431) << piece;
    }
}

TEST(RequestParser, BodyLongerThanTheLimitIs413) {
    const std::string head = "POST / HTTP/1.1\r\nHost: h\r\n";
    EXPECT_EQ(status_of(head + "Content-Length: 101\r\n\r\n"), 413);
    EXPECT_EQ(status_of(head + "Content-Length: 100\r\n\r\n"), 0);
    const std::string chunked = head + "Transfer-Encoding: chunked\r\n\r\n";
    EXPECT_EQ(status_of(chunked + "65\r\nx"), 413);
    const std::string part = "32\r\n" + std::string(50, 'x') + "\r\n";
    EXPECT_EQ(status_of(chunked + part + part + "0\r\n\r\n"), 0);
    EXPECT_EQ(status_of(chunked + part + part + "1\r\nx\r\n"), 413);
    EXPECT_EQ(status_of(chunked + "FFFFFFFFFFFFFFFF\r\n"), 413);
}

TEST(RequestParser, RefusalNamesTheLimit) {
    RequestParser parser;
    feed_all(parser, "POST / HTTP/1.1\r\nHost: h\r\nContent-Length: 101\r\n\r\n", 1000);
    EXPECT_EQ(parser.problem().code, "body_too_large");
    EXPECT_THAT(parser.problem().detail, HasSubstr("101"));
    EXPECT_THAT(parser.problem().detail, HasSubstr("100"));
}

TEST(RequestParser, EndlessChunkHeaderOrTrailerIsRefused) {
    const std::string head =
        "POST / HTTP/1.1\r\nHost: h\r\nTransfer-Encoding: chunked\r\n\r\n";
    EXPECT_EQ(status_of(head + "1;" + std::string(100'000, 'x'), 1'000), 400);
    std::string trailer = head + "0\r\n";
    while (trailer.size() < 100'000) trailer += "A: b\r\n";
    EXPECT_EQ(status_of(trailer, 1'000), 400);
}

}  // namespace
}  // namespace haarmony::http
