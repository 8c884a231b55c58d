#include "server/api/base64.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/server/api/interface.h"

namespace haarmony::server {
namespace {

TEST(Base64, ReadsTheVectorsOfTheRfc) {
    // RFC 4648, section 10.
    const std::vector<std::pair<std::string, std::string>> vectors{
        {"", ""},
        {"Zg==", "f"},
        {"Zm8=", "fo"},
        {"Zm9v", "foo"},
        {"Zm9vYg==", "foob"},
        {"Zm9vYmE=", "fooba"},
        {"Zm9vYmFy", "foobar"}};
    for (const auto& [text, bytes] : vectors) {
        const auto decoded = decode_base64(text);
        ASSERT_TRUE(decoded) << text;
        EXPECT_EQ(decoded.value(), bytes);
    }
}

TEST(Base64, IsTheInverseOfEncoding) {
    std::mt19937 random(20);
    for (std::size_t size = 0; size < 200; ++size) {
        std::string bytes;
        for (std::size_t i = 0; i < size; ++i)
            bytes.push_back(static_cast<char>(random()));
        const auto decoded = decode_base64(base64(bytes));
        ASSERT_TRUE(decoded) << size;
        EXPECT_EQ(decoded.value(), bytes) << size;
    }
}

TEST(Base64, RefusesEverythingElse) {
    for (const std::string text : {"Z",         // no whole group
                                   "Zg",        // no padding
                                   "Zg=",       // too little of it
                                   "Z===",      // too much
                                   "Zg==Zg==",  // in the middle
                                   "Zm 9",      // a blank
                                   "Zm9v\n",    // a line break
                                   "Zm-_",      // the other alphabet
                                   "Zh==",      // bits that are thrown away
                                   "Zm9="}) {
        const auto decoded = decode_base64(text);
        ASSERT_FALSE(decoded) << text;
        EXPECT_EQ(decoded.error().code, ErrorCode::kInvalidArgument);
    }
    EXPECT_NE(decode_base64("Zm.v").error().message.find("position 2"),
              std::string::npos);
}

}  // namespace
}  // namespace haarmony::server
