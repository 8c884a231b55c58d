#include "schema/uri_words.h"

#include <gtest/gtest.h>

namespace haarmony::schema {
namespace {

TEST(UriWords, AreTheDecodedTextWithoutItsScheme) {
    const std::pair<std::string, std::string> cases[] = {
        {"file:///a/my%20cat.jpg", "/a/my cat.jpg"},
        {"https://host/x", "host/x"},
        {"caf%C3%A9", "caf\xc3\xa9"},
        {"caf%c3%a9", "caf\xc3\xa9"},
        {"plain.jpg", "plain.jpg"},
        {"", ""},
        {"://x", "x"},
        // Only what comes first is a scheme.
        {"a/b://c", "a/b://c"},
        {"/://", "/://"},
    };
    for (const auto& [uri, words] : cases) EXPECT_EQ(uri_words(uri), words) << uri;
}

TEST(UriWords, WhatIsNoEncodingStays) {
    for (const std::string uri : {"100%", "%4", "%zz", "%4g", "%%", "a%2"}) {
        EXPECT_EQ(uri_words(uri), uri);
    }
    EXPECT_EQ(uri_words("%%41"), "%A");
    // Decoded once.
    EXPECT_EQ(uri_words("%2541"), "%41");
}

TEST(UriWords, ANulIsASpace) {
    EXPECT_EQ(uri_words("a%00b"), "a b");
    EXPECT_EQ(uri_words(std::string_view("a\0b", 3)), "a b");
}

}  // namespace
}  // namespace haarmony::schema
