#include "engine/image/base64url.h"

#include <gtest/gtest.h>

#include <random>

namespace haarmony::image {
namespace {

std::string encoded(std::string_view bytes) {
    return base64url_encode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
}

// RFC 4648, section 10, without the padding.
TEST(Base64url, MatchesTheVectorsOfTheRfc) {
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg");
    EXPECT_EQ(encoded("fo"), "Zm8");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encoded("\xFB\xFF"), "-_8");
}

TEST(Base64url, RoundTripsBytesOfEveryLength) {
    std::mt19937 random(51);
    for (std::size_t length = 0; length < 70; ++length) {
        std::vector<std::uint8_t> bytes(length);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        const std::string text = base64url_encode(bytes);
        EXPECT_EQ(text.size(), base64url_length(length));
        const auto decoded = base64url_decode(text);
        ASSERT_TRUE(decoded) << text;
        EXPECT_EQ(*decoded, bytes);
    }
}

TEST(Base64url, RefusesWhatIsNoTextOfBytes) {
    const std::pair<std::string_view, std::string_view> cases[] = {
        {"Zg==", "byte 61"},
        {"Zm+v", "byte 43"},
        {"Zm/v", "byte 47"},
        {"Zm v", "byte 32 at position 2"},
        {"Zm9vY", "5 characters"},
        {"Zh", "bits that belong to no byte"},
        {"Zm9", "bits that belong to no byte"},
        {"\xC3\xA4g", "byte 195"},
    };
    for (const auto& [text, reason] : cases) {
        const auto decoded = base64url_decode(text);
        ASSERT_FALSE(decoded) << text;
        EXPECT_EQ(decoded.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(decoded.error().message.find(reason), std::string::npos)
            << decoded.error().message;
    }
}

}  // namespace
}  // namespace haarmony::image
