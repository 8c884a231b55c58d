#include "server/http/message.h"

#include <gtest/gtest.h>

namespace haarmony::http {
namespace {

TEST(Headers, NamesCompareWithoutCase) {
    Headers headers{{"Content-Type", "a"}};
    headers["CONTENT-TYPE"] = "b";
    EXPECT_EQ(headers.size(), 1U);
    EXPECT_EQ(headers.at("content-type"), "b");
    headers["Content-Types"] = "c";
    EXPECT_EQ(headers.size(), 2U);
}

TEST(Request, AbsentHeaderIsEmpty) {
    Request request;
    request.headers["Accept"] = "x";
    EXPECT_EQ(request.header("accept"), "x");
    EXPECT_EQ(request.header("Range"), "");
}

}  // namespace
}  // namespace haarmony::http
