#include "server/http/header_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace haarmony::http {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(HeaderValue, CaseAndSpaceDoNotCount) {
    EXPECT_TRUE(equal_without_case("GZip", "gzIP"));
    EXPECT_FALSE(equal_without_case("gzip", "gzi"));
    EXPECT_EQ(lower_case("ABC-\xC3\x84"), "abc-\xC3\x84");
    EXPECT_EQ(trim(" \t a b\t "), "a b");
    EXPECT_EQ(trim(" \t"), "");
}

TEST(HeaderValue, TokensHaveNoSeparators) {
    EXPECT_TRUE(is_token("X-Request_Id!#$%&'*+.^`|~"));
    for (const char* bad : {"", "a b", "a:b", "a\"", "a/b", "(a)", "a\x7f", "\xC3\xA9"}) {
        EXPECT_FALSE(is_token(bad)) << bad;
    }
}

TEST(HeaderValue, ControlCharactersAreSeenButTabsAreNone) {
    EXPECT_TRUE(has_control("a\nb"));
    EXPECT_TRUE(has_control(std::string_view("\0", 1)));
    EXPECT_TRUE(has_control("\x7f"));
    EXPECT_FALSE(has_control("a\tb \xC3\xA9"));
}

TEST(HeaderValue, ListSplitsAtCommasOutsideQuotes) {
    EXPECT_THAT(split_list(" a , \"b,c\" ,, W/\"d\","),
                ElementsAre("a", "\"b,c\"", "W/\"d\""));
    EXPECT_TRUE(split_list(" , ,").empty());
}

TEST(HeaderValue, ParametersAreReadAsTokensOrQuotedStrings) {
    const auto parsed =
        parse_parameterized("Form-Data; NAME=a; filename=\"b; \\\"c\\\\d\"; x=\"\";");
    ASSERT_TRUE(parsed);
    EXPECT_EQ(parsed->value, "form-data");
    EXPECT_THAT(
        parsed->parameters,
        ElementsAre(Pair("name", "a"), Pair("filename", "b; \"c\\d"), Pair("x", "")));
}

TEST(HeaderValue, BackslashOfAWindowsPathStandsForItself) {
    const auto parsed =
        parse_parameterized("form-data; filename=\"C:\\pictures\\a.png\"");
    ASSERT_TRUE(parsed);
    EXPECT_THAT(parsed->parameters, ElementsAre(Pair("filename", "C:\\pictures\\a.png")));
}

TEST(HeaderValue, MalformedParametersAreRefused) {
    for (const char* bad : {"",
                            ";a=b",
                            "x; a",
                            "x; a=",
                            "x; =b",
                            "x; a b=c",
                            "x; a=\"open",
                            "x; a=\"b\"c",
                            "x; a=b c",
                            "x; a=b; A=c",
                            "x; a=\"b\\\""}) {
        const auto parsed = parse_parameterized(bad);
        ASSERT_FALSE(parsed) << bad;
        EXPECT_THAT(parsed.error().message, testing::HasSubstr(bad));
    }
}

}  // namespace
}  // namespace haarmony::http
