#include "server/http/target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace haarmony::http {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

TEST(Target, SplitsAndDecodesPathAndQuery) {
    const auto target = parse_target("/a%20b/%C3%A9?x=1&y=a+b%2Bc&flag&=z&&x=2");
    ASSERT_TRUE(target);
    EXPECT_EQ(target->path, "/a b/\xC3\xA9");
    EXPECT_THAT(target->query,
                ElementsAre(Pair("x", "1"),
                            Pair("y", "a b+c"),
                            Pair("flag", ""),
                            Pair("", "z"),
                            Pair("x", "2")));
}

TEST(Target, PlusIsASpaceOnlyInTheQuery) {
    const auto target = parse_target("/a+b?c+d=e+f");
    ASSERT_TRUE(target);
    EXPECT_EQ(target->path, "/a+b");
    EXPECT_THAT(target->query, ElementsAre(Pair("c d", "e f")));
}

TEST(Target, ValueMayHoldEqualsQuestionMarksAndSlashes) {
    const auto target = parse_target("/p?a=b=c?d/%2F");
    ASSERT_TRUE(target);
    EXPECT_THAT(target->query, ElementsAre(Pair("a", "b=c?d//")));
}

TEST(Target, AbsoluteFormLosesItsAuthority) {
    EXPECT_EQ(parse_target("http://host:80/x?y=1")->path, "/x");
    EXPECT_EQ(parse_target("https://host")->path, "/");
    const auto query_only = parse_target("http://host?y=1");
    ASSERT_TRUE(query_only);
    EXPECT_EQ(query_only->path, "/");
    EXPECT_THAT(query_only->query, ElementsAre(Pair("y", "1")));
}

TEST(Target, AsteriskStandsForTheServer) { EXPECT_EQ(parse_target("*")->path, "*"); }

class BadTarget : public testing::TestWithParam<const char*> {};

TEST_P(BadTarget, IsRefusedAndNamed) {
    const auto target = parse_target(GetParam());
    ASSERT_FALSE(target) << GetParam();
    EXPECT_EQ(target.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(target.error().message, HasSubstr("'"));
}

INSTANTIATE_TEST_SUITE_P(All,
                         BadTarget,
                         testing::Values("/%",
                                         "/%4",
                                         "/%zz",
                                         "/%4g",
                                         "/a%00b",
                                         "/a%2Fb",
                                         "/a%2fb",
                                         "/%FF",
                                         "/%C3",
                                         "/%C0%AF",
                                         "/%ED%A0%80",
                                         "/?q=%",
                                         "/?q=%F5%80%80%80",
                                         "/?%ZZ=1",
                                         "/?q=%00",
                                         "relative",
                                         "",
                                         "http://",
                                         "ftp://host/x",
                                         "http:///x"));

TEST(Target, LongBadTargetIsNotRepeatedInFull) {
    const auto target = parse_target("/" + std::string(5'000, 'x') + "%");
    ASSERT_FALSE(target);
    EXPECT_LT(target.error().message.size(), 200U);
}

TEST(Target, EveryByteSurvivesEncodingAndParsing) {
    for (std::uint32_t point = 1; point < 0x3000; ++point) {
        std::string character;
        if (point < 0x80) {
            character = {static_cast<char>(point)};
        } else if (point < 0x800) {
            character = {static_cast<char>(0xC0 | (point >> 6U)),
                         static_cast<char>(0x80 | (point & 63U))};
        } else {
            character = {static_cast<char>(0xE0 | (point >> 12U)),
                         static_cast<char>(0x80 | ((point >> 6U) & 63U)),
                         static_cast<char>(0x80 | (point & 63U))};
        }
        const std::string path = "/x" + character;
        const auto target = parse_target(encode_path(path));
        ASSERT_TRUE(target) << point << ": " << encode_path(path);
        EXPECT_EQ(target->path, path) << point;
    }
}

TEST(Target, EncodedPathIsPlainAscii) {
    EXPECT_EQ(encode_path("/a b\"<\xC3\xA9>?#%"), "/a%20b%22%3C%C3%A9%3E%3F%23%25");
}

// The definition, by generating every well-formed sequence of one character.
bool is_one_utf8_character(const std::string& bytes) {
    for (std::uint32_t point = 0; point <= 0x10FFFF; ++point) {
        if (point >= 0xD800 && point <= 0xDFFF) continue;
        std::string made;
        if (point < 0x80) {
            made = {static_cast<char>(point)};
        } else if (point < 0x800) {
            made = {static_cast<char>(0xC0 | (point >> 6U)),
                    static_cast<char>(0x80 | (point & 63U))};
        } else if (point < 0x10000) {
            made = {static_cast<char>(0xE0 | (point >> 12U)),
                    static_cast<char>(0x80 | ((point >> 6U) & 63U)),
                    static_cast<char>(0x80 | (point & 63U))};
        } else {
            made = {static_cast<char>(0xF0 | (point >> 18U)),
                    static_cast<char>(0x80 | ((point >> 12U) & 63U)),
                    static_cast<char>(0x80 | ((point >> 6U) & 63U)),
                    static_cast<char>(0x80 | (point & 63U))};
        }
        if (made == bytes) return true;
    }
    return false;
}

TEST(Utf8, AgreesWithTheDefinitionAtEveryEdge) {
    const std::string edges[] = {"\x7F",
                                 "\x80",
                                 "\xC1\xBF",
                                 "\xC2\x80",
                                 "\xDF\xBF",
                                 "\xE0\x9F\xBF",
                                 "\xE0\xA0\x80",
                                 "\xED\x9F\xBF",
                                 "\xED\xA0\x80",
                                 "\xED\xBF\xBF",
                                 "\xEE\x80\x80",
                                 "\xEF\xBF\xBF",
                                 "\xF0\x8F\xBF\xBF",
                                 "\xF0\x90\x80\x80",
                                 "\xF4\x8F\xBF\xBF",
                                 "\xF4\x90\x80\x80",
                                 "\xF5\x80\x80\x80",
                                 "\xFF",
                                 "\xE2\x82",
                                 "\xE2\x28\xA1"};
    for (const std::string& bytes : edges) {
        EXPECT_EQ(is_utf8(bytes), is_one_utf8_character(bytes))
            << testing::PrintToString(bytes);
    }
}

}  // namespace
}  // namespace haarmony::http
