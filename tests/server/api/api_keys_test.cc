#include "server/api/api_keys.h"

#include <gtest/gtest.h>

#include <string>

namespace haarmony::server {
namespace {

ApiKeys keys() {
    auto parsed = ApiKeys::parse(
        "# who may what\n\n  write:writer-1 \r\nread:reader-1\nplain-1\nread:write:x\n");
    EXPECT_TRUE(parsed);
    return std::move(parsed).value();
}

http::Request request(const std::string& method,
                      const std::string& path,
                      const http::Headers& headers) {
    http::Request request;
    request.method = method;
    request.path = path;
    request.headers = headers;
    return request;
}

int status(const std::string& method,
           const std::string& path,
           const http::Headers& headers) {
    const auto problem = keys().admit(request(method, path, headers));
    return problem ? problem->status : 200;
}

http::Headers bearer(const std::string& key) {
    return {{"Authorization", "Bearer " + key}};
}

TEST(ApiKeys, AWritingKeyMayDoEverything) {
    for (const std::string key : {"writer-1", "plain-1"}) {
        EXPECT_EQ(status("GET", "/images", bearer(key)), 200);
        EXPECT_EQ(status("POST", "/images", bearer(key)), 200);
        EXPECT_EQ(status("DELETE", "/images/1", bearer(key)), 200);
    }
}

TEST(ApiKeys, AReadingKeyMayReadAndSearch) {
    for (const std::string key : {"reader-1", "write:x"}) {
        EXPECT_EQ(status("GET", "/images", bearer(key)), 200);
        EXPECT_EQ(status("HEAD", "/images", bearer(key)), 200);
        EXPECT_EQ(status("OPTIONS", "/images", bearer(key)), 200);
        EXPECT_EQ(status("POST", "/query", bearer(key)), 200);
        EXPECT_EQ(status("POST", "/images", bearer(key)), 403);
        EXPECT_EQ(status("DELETE", "/images/1", bearer(key)), 403);
    }
}

TEST(ApiKeys, OtherKeysAndNoneAreUnauthorized) {
    for (const http::Headers& headers :
         {http::Headers{},
          bearer(""),
          bearer("writer-"),
          bearer("writer-11"),
          bearer("write:writer-1"),
          bearer("WRITER-1"),
          http::Headers{{"Authorization", "writer-1"}},
          http::Headers{{"Authorization", "Basic writer-1"}}})
        EXPECT_EQ(status("GET", "/images", headers), 401);
    const auto problem = keys().admit(request("GET", "/images", {}));
    ASSERT_TRUE(problem);
    EXPECT_EQ(problem->headers.at("WWW-Authenticate"), "Bearer");
}

TEST(ApiKeys, EitherHeaderCarriesAKey) {
    EXPECT_EQ(status("GET", "/images", {{"X-Api-Key", "writer-1"}}), 200);
    EXPECT_EQ(status("GET", "/images", {{"authorization", "bearer   writer-1"}}), 200);
    EXPECT_EQ(status("GET", "/images", {{"X-Api-Key", "wrong"}}), 401);
}

TEST(ApiKeys, AFileWithoutKeysIsNoOpenDoor) {
    for (const std::string text : {"", "\n\n", "# only a comment\n"})
        EXPECT_FALSE(ApiKeys::parse(text)) << text;
}

TEST(ApiKeys, ALineThatIsNoKeyIsNamed) {
    for (const std::string line :
         {"two words", "read:", "write:", "tab\there", "\xc3\xa4"}) {
        const auto refused = ApiKeys::parse("good\n" + line + "\n");
        ASSERT_FALSE(refused) << line;
        EXPECT_NE(refused.error().message.find("line 2"), std::string::npos) << line;
        EXPECT_EQ(refused.error().message.find("words"), std::string::npos)
            << "a key must not stand in a log";
    }
}

}  // namespace
}  // namespace haarmony::server
