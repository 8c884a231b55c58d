#include "ingest/file_uri.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cstdio>
#include <filesystem>

#include <random>
#include <string>

namespace haarmony::ingest {
namespace {

TEST(FileUri, KeepsUnreservedBytesAndEncodesEveryOther) {
    for (int byte = 1; byte < 256; ++byte) {
        const std::string path = std::string("/") + static_cast<char>(byte);
        const bool kept =
            (std::isalnum(byte) != 0 && byte < 128) ||
            std::string("-._~/").find(static_cast<char>(byte)) != std::string::npos;
        char encoded[8];
        std::snprintf(encoded, sizeof encoded, "%%%02X", static_cast<unsigned>(byte));
        EXPECT_EQ(file_uri(path), "file:///" + (kept ? path.substr(1) : encoded)) << byte;
    }
}

TEST(FileUri, ComesBackByteForByte) {
    std::mt19937 random(7);
    std::uniform_int_distribution<int> byte(1, 255);
    for (int i = 0; i < 500; ++i) {
        std::string path = "/";
        for (int length = i % 40; length > 0; --length)
            path += static_cast<char>(byte(random));
        const Result<std::string> back = path_from_file_uri(file_uri(path));
        ASSERT_TRUE(back) << back.error().message;
        EXPECT_EQ(*back, path);
    }
}

TEST(FileUri, LowerCaseEscapesAreRead) {
    const Result<std::string> path = path_from_file_uri("file:///a%c3%a9");
    ASSERT_TRUE(path);
    EXPECT_EQ(*path, "/a\xc3\xa9");
}

TEST(FileUri, RefusesWhatIsNoLocalPath) {
    for (const char* uri : {"http://a/b",
                            "/a/b",
                            "file:/a",
                            "file://host/a",
                            "file://",
                            "file:///a%",
                            "file:///a%4",
                            "file:///a%4g",
                            "file:///a%g4",
                            "file:///a%00b"}) {
        const Result<std::string> path = path_from_file_uri(uri);
        ASSERT_FALSE(path) << uri;
        EXPECT_EQ(path.error().code, ErrorCode::kInvalidArgument);
        EXPECT_NE(path.error().message.find(uri), std::string::npos);
    }
}

TEST(NormalPath, IsAbsoluteAndHasNoDetours) {
    const std::string here = std::filesystem::current_path().string();
    const std::pair<const char*, std::string> cases[] = {{"/a/b", "/a/b"},
                                                         {"/a/b/", "/a/b"},
                                                         {"/a//b///", "/a/b"},
                                                         {"//a", "/a"},
                                                         {"/a/./b/../c", "/a/c"},
                                                         {"/..", "/"},
                                                         {"/", "/"},
                                                         {".", here},
                                                         {"x/", here + "/x"},
                                                         {"./[a,b]", here + "/[a,b]"}};
    for (const auto& [path, normal] : cases) {
        const Result<std::string> result = normal_path(path);
        ASSERT_TRUE(result) << path;
        EXPECT_EQ(*result, normal) << path;
    }
}

}  // namespace
}  // namespace haarmony::ingest
