#include "server/http/conditional.h"

#include <gtest/gtest.h>

#include <string>

namespace haarmony::http {
namespace {

constexpr std::string_view kBody = "0123456789";

Response media(std::string etag = "\"v1\"") {
    return {.status = 200,
            .headers = {{"ETag", std::move(etag)},
                        {"Accept-Ranges", "bytes"},
                        {"Content-Type", "image/png"},
                        {"Cache-Control", "no-cache"}},
            .body = std::string(kBody)};
}

Request get(Headers headers) {
    Request request;
    request.method = "GET";
    request.path = "/x";
    request.headers = std::move(headers);
    return request;
}

Response applied(const Request& request, Response response) {
    apply_conditions(request, response);
    return response;
}

std::string text_of(const Response& response) {
    return std::get<std::string>(response.body);
}

TEST(Conditional, EtagsCompareWeaklyOrStrongly) {
    // RFC 9110, section 8.8.3.2, the table.
    EXPECT_TRUE(weakly_equal("W/\"1\"", "W/\"1\""));
    EXPECT_FALSE(strongly_equal("W/\"1\"", "W/\"1\""));
    EXPECT_FALSE(weakly_equal("W/\"1\"", "W/\"2\""));
    EXPECT_TRUE(weakly_equal("W/\"1\"", "\"1\""));
    EXPECT_FALSE(strongly_equal("W/\"1\"", "\"1\""));
    EXPECT_TRUE(weakly_equal("\"1\"", "\"1\""));
    EXPECT_TRUE(strongly_equal("\"1\"", "\"1\""));
    EXPECT_FALSE(weakly_equal("1", "1"));
}

TEST(Conditional, MatchingTagIs304WithoutABody) {
    for (const char* condition :
         {"\"v1\"", "W/\"v1\"", "*", " \"a\" , W/\"v1\"", "\"a,b\",\"v1\""}) {
        const Response response = applied(get({{"If-None-Match", condition}}), media());
        EXPECT_EQ(response.status, 304) << condition;
        EXPECT_EQ(text_of(response), "");
        EXPECT_EQ(response.headers.at("ETag"), "\"v1\"");
        EXPECT_EQ(response.headers.at("Cache-Control"), "no-cache");
    }
}

TEST(Conditional, OtherTagsAre200) {
    for (const char* condition : {"\"v2\"", "v1", "\"v\", \"1\"", ","}) {
        EXPECT_EQ(applied(get({{"If-None-Match", condition}}), media()).status, 200)
            << condition;
    }
}

TEST(Conditional, OnlySuccessfulReadsAreTouched) {
    Request request = get({{"If-None-Match", "*"}, {"Range", "bytes=0-1"}});
    request.method = "POST";
    EXPECT_EQ(applied(request, media()).status, 200);
    request.method = "HEAD";
    EXPECT_EQ(applied(request, media()).status, 304);
    request.method = "GET";
    Response missing = media();
    missing.status = 404;
    EXPECT_EQ(applied(request, missing).status, 404);
}

TEST(Conditional, WithoutAnEtagThereIsNothingToMatch) {
    Response response = media();
    response.headers.erase("ETag");
    EXPECT_EQ(applied(get({{"If-None-Match", "*"}}), response).status, 200);
}

TEST(Range, EveryRangeIsWhatTheDefinitionSays) {
    const int length = static_cast<int>(kBody.size());
    for (int first = -1; first <= length + 1; ++first) {
        for (int last = -1; last <= length + 1; ++last) {
            if (first < 0 && last < 0) continue;
            const std::string range =
                "bytes=" + (first < 0 ? "" : std::to_string(first)) + "-" +
                (last < 0 ? "" : std::to_string(last));
            std::string wanted;
            int start = -1;
            for (int i = 0; i < length; ++i) {
                const bool inside = first < 0  ? i >= length - last
                                    : last < 0 ? i >= first
                                               : i >= first && i <= last;
                if (!inside) continue;
                if (start < 0) start = i;
                wanted.push_back(kBody[static_cast<std::size_t>(i)]);
            }
            const bool malformed = first >= 0 && last >= 0 && last < first;
            const Response response = applied(get({{"Range", range}}), media());
            if (malformed) {
                EXPECT_EQ(response.status, 200) << range;
            } else if (wanted.empty()) {
                EXPECT_EQ(response.status, 416) << range;
                EXPECT_EQ(response.headers.at("Content-Range"), "bytes */10");
            } else {
                EXPECT_EQ(response.status, 206) << range;
                EXPECT_EQ(text_of(response), wanted) << range;
                EXPECT_EQ(
                    response.headers.at("Content-Range"),
                    "bytes " + std::to_string(start) + "-" +
                        std::to_string(start + static_cast<int>(wanted.size()) - 1) +
                        "/10");
            }
        }
    }
}

TEST(Range, PositionsBeyond64BitsAreBeyondTheEnd) {
    const std::string huge = "99999999999999999999999999";
    EXPECT_EQ(text_of(applied(get({{"Range", "bytes=7-" + huge}}), media())), "789");
    EXPECT_EQ(text_of(applied(get({{"Range", "bytes=-" + huge}}), media())), kBody);
    EXPECT_EQ(applied(get({{"Range", "bytes=" + huge + "-"}}), media()).status, 416);
}

TEST(Range, MalformedOnesAndOtherUnitsAreIgnored) {
    for (const char* range : {"bytes",
                              "bytes=",
                              "bytes=-",
                              "bytes=a-b",
                              "bytes=1",
                              "items=0-1",
                              "bytes 0-1",
                              "bytes=0-1,x",
                              "bytes=--1",
                              "bytes=+1-2",
                              "bytes=0 -1"}) {
        EXPECT_EQ(applied(get({{"Range", range}}), media()).status, 200) << range;
    }
}

TEST(Range, UnitHasNoCase) {
    EXPECT_EQ(applied(get({{"Range", "Bytes=0-1"}}), media()).status, 206);
}

TEST(Range, SeveralRangesGiveTheWholeOr416) {
    EXPECT_EQ(applied(get({{"Range", "bytes=0-1,3-4"}}), media()).status, 200);
    EXPECT_EQ(applied(get({{"Range", "bytes=20-,0-1"}}), media()).status, 200);
    EXPECT_EQ(applied(get({{"Range", "bytes=20-,30-40"}}), media()).status, 416);
}

TEST(Range, IsCutOutOfAFileToo) {
    Response response = media();
    response.body = FileRange{.path = "p", .offset = 100, .length = 50};
    response = applied(get({{"Range", "bytes=10-19"}}), response);
    EXPECT_EQ(response.status, 206);
    EXPECT_EQ(std::get<FileRange>(response.body).offset, 110U);
    EXPECT_EQ(std::get<FileRange>(response.body).length, 10U);
    EXPECT_EQ(response.headers.at("Content-Range"), "bytes 10-19/50");
}

TEST(Range, OfNothingCannotBeSatisfied) {
    Response response = media();
    response.body = std::string{};
    response = applied(get({{"Range", "bytes=0-"}}), response);
    EXPECT_EQ(response.status, 416);
    EXPECT_EQ(response.headers.at("Content-Range"), "bytes */0");
}

TEST(Range, NeedsAGetABodyOfKnownLengthAndTheHandlersWord) {
    Request request = get({{"Range", "bytes=0-1"}});
    Response silent = media();
    silent.headers.erase("Accept-Ranges");
    EXPECT_EQ(applied(request, silent).status, 200);
    Response none = media();
    none.headers["Accept-Ranges"] = "none";
    EXPECT_EQ(applied(request, none).status, 200);
    Response stream = media();
    stream.body = ChunkSource([] { return std::nullopt; });
    EXPECT_EQ(applied(request, stream).status, 200);
    request.method = "HEAD";
    EXPECT_EQ(applied(request, media()).status, 200);
}

TEST(Range, IfRangeNeedsTheSameStrongTag) {
    const auto status = [](const char* condition, const char* etag) {
        return applied(get({{"Range", "bytes=0-1"}, {"If-Range", condition}}),
                       media(etag))
            .status;
    };
    EXPECT_EQ(status("\"v1\"", "\"v1\""), 206);
    EXPECT_EQ(status("\"v2\"", "\"v1\""), 200);
    EXPECT_EQ(status("W/\"v1\"", "W/\"v1\""), 200);
    EXPECT_EQ(status("Sun, 06 Nov 1994 08:49:37 GMT", "\"v1\""), 200);
}

TEST(Range, IfNoneMatchComesFirst) {
    EXPECT_EQ(applied(get({{"Range", "bytes=90-"}, {"If-None-Match", "\"v1\""}}), media())
                  .status,
              304);
}

}  // namespace
}  // namespace haarmony::http
