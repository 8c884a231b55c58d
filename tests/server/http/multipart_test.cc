#include "server/http/multipart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace haarmony::http {
namespace {

using testing::HasSubstr;

constexpr std::string_view kType = "multipart/form-data; boundary=XX";

std::string part(std::string_view headers, std::string_view body) {
    return "--XX\r\n" + std::string(headers) + "\r\n\r\n" + std::string(body) + "\r\n";
}

std::string named(std::string_view name, std::string_view body) {
    return part("Content-Disposition: form-data; name=\"" + std::string(name) + "\"",
                body);
}

std::string complaint(std::string_view body, std::string_view type = kType) {
    const auto parts = parse_multipart(type, body);
    EXPECT_FALSE(parts) << body;
    if (parts) return {};
    EXPECT_EQ(parts.error().code, ErrorCode::kInvalidArgument);
    return parts.error().message;
}

TEST(Multipart, PartsComeBackInOrderWithTheirHeaders) {
    const std::string body = part(
                                 "content-disposition: form-data; name=\"file\"; "
                                 "filename=\"a.png\"\r\nContent-Type: image/png",
                                 std::string_view("\x89PNG\0\r\n--X", 10)) +
                             named("limit", "20") + "--XX--\r\n";
    const auto parts = parse_multipart(kType, body);
    ASSERT_TRUE(parts) << parts.error().message;
    ASSERT_EQ(parts->size(), 2U);
    EXPECT_EQ((*parts)[0].name, "file");
    EXPECT_EQ((*parts)[0].file_name, "a.png");
    EXPECT_EQ((*parts)[0].content_type, "image/png");
    EXPECT_EQ((*parts)[0].body, std::string_view("\x89PNG\0\r\n--X", 10));
    EXPECT_EQ((*parts)[1].name, "limit");
    EXPECT_EQ((*parts)[1].body, "20");
}

TEST(Multipart, BodiesAreViewsIntoTheRequest) {
    const std::string body = named("a", "hello") + "--XX--";
    const auto parts = parse_multipart(kType, body);
    ASSERT_TRUE(parts);
    EXPECT_EQ((*parts)[0].body.data(), body.data() + body.find("hello"));
}

TEST(Multipart, WhatIsWrittenIsReadBack) {
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
        std::vector<std::string> bodies(random() % 5);
        std::string text;
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            // Bytes from which boundary-like text arises often, but never the boundary.
            for (auto n = random() % 40; n > 0; --n) {
                bodies[i].push_back("\r\n--XYa\0"[random() % 8]);
            }
            if (bodies[i].find("\r\n--XX") != std::string::npos) bodies[i].clear();
            text += named("n" + std::to_string(i), bodies[i]);
        }
        text += "--XX--\r\n";
        const auto parts = parse_multipart(kType, text);
        ASSERT_TRUE(parts) << parts.error().message << testing::PrintToString(text);
        ASSERT_EQ(parts->size(), bodies.size());
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            EXPECT_EQ((*parts)[i].body, bodies[i]);
        }
    }
}

TEST(Multipart, EveryTruncationIsRefused) {
    const std::string body =
        part("Content-Disposition: form-data; name=\"a\"\r\nContent-Type: text/plain",
             "one") +
        named("b", "") + "--XX--";
    ASSERT_TRUE(parse_multipart(kType, body));
    for (std::size_t size = 0; size < body.size(); ++size) {
        complaint(body.substr(0, size));
    }
}

TEST(Multipart, BoundaryLikeTextInsideABodyStays) {
    for (const char* text : {"--XX",
                             "--XX--",
                             "\n--XX",
                             "\r--XX",
                             "\r\n-XX",
                             "\r\n--X\r\n",
                             "\r\n--Xx",
                             "\r\n"}) {
        const std::string body = named("a", std::string("x") + text) + "--XX--";
        const auto parts = parse_multipart(kType, body);
        ASSERT_TRUE(parts) << testing::PrintToString(text);
        ASSERT_EQ(parts->size(), 1U);
        EXPECT_EQ((*parts)[0].body, std::string("x") + text);
    }
}

TEST(Multipart, LineThatGoesOnAfterTheBoundaryIsRefused) {
    EXPECT_THAT(complaint(named("a", "x\r\n--XXY") + "--XX--"),
                HasSubstr("after a multipart boundary"));
}

TEST(Multipart, PaddingAfterABoundaryIsAllowed) {
    const std::string body =
        "--XX \t\r\nContent-Disposition: form-data; name=a\r\n\r\nx\r\n--XX--";
    const auto parts = parse_multipart(kType, body);
    ASSERT_TRUE(parts) << parts.error().message;
    EXPECT_EQ((*parts)[0].body, "x");
}

TEST(Multipart, DuplicateNamesAreKeptForTheCallerToJudge) {
    const auto parts =
        parse_multipart(kType, named("a", "1") + named("a", "2") + "--XX--");
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), 2U);
    EXPECT_EQ((*parts)[1].name, "a");
}

TEST(Multipart, FormWithoutPartsIsEmpty) {
    const auto parts = parse_multipart(kType, "--XX--\r\n");
    ASSERT_TRUE(parts);
    EXPECT_TRUE(parts->empty());
}

TEST(Multipart, OneLineEndMayStandInFrontButNothingElse) {
    EXPECT_TRUE(parse_multipart(kType, "\r\n" + named("a", "1") + "--XX--"));
    EXPECT_THAT(complaint("preamble\r\n" + named("a", "1") + "--XX--"),
                HasSubstr("does not begin with its boundary"));
    EXPECT_THAT(complaint("\n" + named("a", "1") + "--XX--"),
                HasSubstr("does not begin"));
}

TEST(Multipart, TextAfterTheEndIsRefused) {
    EXPECT_THAT(complaint(named("a", "1") + "--XX--\r\nepilogue"),
                HasSubstr("goes on after its end: '\r\nepilogue'"));
    complaint(named("a", "1") + "--XX--\n");
}

TEST(Multipart, NamesAreUnescapedAsBrowsersAndCurlEscapeThem) {
    const auto parts =
        parse_multipart(kType,
                        part("Content-Disposition: form-data; name=\"a%22b%0D%0A%41\"; "
                             "filename=\"\\\"x\\\".png\"",
                             "") +
                            "--XX--");
    ASSERT_TRUE(parts) << parts.error().message;
    EXPECT_EQ((*parts)[0].name, "a\"b\r\n%41");
    EXPECT_EQ((*parts)[0].file_name, "\"x\".png");
}

TEST(Multipart, QuotedBoundaryMayHoldWhatATokenMayNot) {
    const std::string body =
        "--a b:c\r\nContent-Disposition: form-data; name=n\r\n\r\nx\r\n--a b:c--";
    EXPECT_TRUE(
        parse_multipart("Multipart/Form-Data; charset=utf-8; Boundary=\"a b:c\"", body));
}

TEST(Multipart, BadContentTypesAreRefused) {
    const std::string body = "--XX--";
    EXPECT_THAT(complaint(body, "multipart/mixed; boundary=XX"),
                HasSubstr("not multipart/form-data: 'multipart/mixed'"));
    EXPECT_THAT(complaint(body, "multipart/form-data"), HasSubstr("without a boundary"));
    EXPECT_THAT(complaint(body, "multipart/form-data; boundary=\"\""),
                HasSubstr("bad multipart boundary"));
    complaint(body, "multipart/form-data; boundary=\"a \"");
    complaint(body, "multipart/form-data; boundary=\"a\xC3\xA9\"");
    complaint(body, "multipart/form-data; boundary=" + std::string(71, 'x'));
    complaint(body, "multipart/form-data; boundary=XX; boundary=XX");
    complaint(body, "multipart/form-data; boundary=\"XX");
    complaint(body, "");
}

TEST(Multipart, BadPartHeadersAreRefused) {
    const auto with = [](std::string_view headers) {
        return part(headers, "x") + "--XX--";
    };
    EXPECT_THAT(complaint(with("Content-Type: text/plain")),
                HasSubstr("without Content-Disposition"));
    EXPECT_THAT(complaint(with("Content-Disposition: form-data")),
                HasSubstr("without a name"));
    complaint(with("Content-Disposition: form-data; name=\"\""));
    EXPECT_THAT(complaint(with("Content-Disposition: attachment; name=a")),
                HasSubstr("not form-data: 'attachment'"));
    EXPECT_THAT(
        complaint(with("Content-Disposition: form-data; name=a; filename*=UTF-8''x")),
        HasSubstr("filename*"));
    complaint(with("Content-Disposition: form-data; name=\"\xFF\""));
    complaint(with("Content-Disposition: form-data; name=a; name=b"));
    EXPECT_THAT(complaint(with("Content-Disposition: form-data; name=a\r\n"
                               "Content-Disposition: form-data; name=b")),
                HasSubstr("two Content-Dispositions"));
    EXPECT_THAT(complaint(with("Content-Disposition: form-data; name=a\r\n"
                               "Content-Type: a/b\r\nContent-Type: c/d")),
                HasSubstr("two Content-Types"));
    EXPECT_THAT(complaint(with("Content-Disposition: form-data; name=a\r\n"
                               "Content-Transfer-Encoding: base64")),
                HasSubstr("base64"));
    EXPECT_THAT(complaint(with("no colon here")), HasSubstr("no colon here"));
    complaint(with("Bad Name: x"));
    complaint(with("Content-Disposition: form-data;\r\n name=folded"));
    complaint(with("Content-Disposition: form-data; name=\"a\nb\""));
}

TEST(Multipart, BareLineFeedsDoNotEndHeaders) {
    complaint("--XX\nContent-Disposition: form-data; name=a\n\nx\n--XX--");
    complaint("--XX\r\nContent-Disposition: form-data; name=a\n\nx\r\n--XX--");
}

TEST(Multipart, UnknownHeadersAndPlainTransferEncodingsAreIgnored) {
    EXPECT_TRUE(
        parse_multipart(kType,
                        part("X-Other: y\r\nContent-Disposition: form-data; name=a"
                             "\r\nContent-Transfer-Encoding: Binary",
                             "x") +
                            "--XX--"));
}

TEST(Multipart, PartsAndTheirHeadersAreLimited) {
    std::string body;
    for (int i = 0; i < kMaxParts; ++i) body += named("n", "");
    EXPECT_TRUE(parse_multipart(kType, body + "--XX--"));
    EXPECT_THAT(complaint(body + named("n", "") + "--XX--"),
                HasSubstr("more than " + std::to_string(kMaxParts)));
    const std::string long_header = "X: " + std::string(9'000, 'y');
    EXPECT_THAT(complaint(part(long_header, "") + "--XX--"), HasSubstr("too long"));
}

}  // namespace
}  // namespace haarmony::http
