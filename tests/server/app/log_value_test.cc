#include "server/app/log_value.h"

#include <gtest/gtest.h>

namespace haarmony::server {
namespace {

TEST(LogValue, IsQuotedOnOneLine) {
    EXPECT_EQ(log_value("plain text"), "\"plain text\"");
    EXPECT_EQ(log_value("a\nlevel=info\tb\x7f"), "\"a level=info b \"");
    EXPECT_EQ(log_value(R"(say "a\b")"), R"("say \"a\\b\"")");
    EXPECT_EQ(log_value("\xc3\xa4"), "\"\xc3\xa4\"");
}

}  // namespace
}  // namespace haarmony::server
