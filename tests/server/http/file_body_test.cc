#include "server/http/file_body.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/server/http/scratch_folder.h"

namespace haarmony::http {
namespace {

std::string drain(const ChunkSource& source) {
    std::string all;
    while (const auto chunk = source()) {
        EXPECT_LE(chunk->size(), kFileChunk);
        all += *chunk;
    }
    return all;
}

TEST(FileBody, GivesExactlyTheRange) {
    const test::ScratchFolder folder;
    const std::string content = test::pattern(3 * kFileChunk + 17);
    const std::string path = folder.write("f", content);
    const auto size = content.size();
    const std::pair<std::size_t, std::size_t> ranges[] = {
        {0, size},
        {0, 0},
        {size, 0},
        {5, 10},
        {kFileChunk - 1, kFileChunk + 2},
        {size - 1, 1}};
    for (const auto& [offset, length] : ranges) {
        const auto source =
            open_file_range({.path = path, .offset = offset, .length = length});
        ASSERT_TRUE(source) << offset << "+" << length;
        EXPECT_EQ(drain(*source), content.substr(offset, length))
            << offset << "+" << length;
    }
}

TEST(FileBody, MissingFileIsNotFoundAndItsPathIsNotTold) {
    const test::ScratchFolder folder;
    const auto source =
        open_file_range({.path = folder.path() / "none", .offset = 0, .length = 0});
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
    EXPECT_THAT(source.error().message, ::testing::Not(::testing::HasSubstr("none")));
    EXPECT_EQ(open_file_range({.path = folder.write("f", "x") + "/g", .length = 0})
                  .error()
                  .code,
              ErrorCode::kNotFound);
}

TEST(FileBody, RangeBeyondTheEndIsRefused) {
    const test::ScratchFolder folder;
    const std::string path = folder.write("f", "12345");
    for (const FileRange& range : {FileRange{path, 0, 6},
                                   FileRange{path, 6, 0},
                                   FileRange{path, 3, 3},
                                   FileRange{path, ~std::uint64_t{0}, 2},
                                   FileRange{path, 1, ~std::uint64_t{0}}}) {
        const auto source = open_file_range(range);
        ASSERT_FALSE(source) << range.offset << "+" << range.length;
        EXPECT_EQ(source.error().code, ErrorCode::kIo);
    }
}

TEST(FileBody, FoldersPipesAndUnreadableNamesAreRefusedWithoutBlocking) {
    const test::ScratchFolder folder;
    EXPECT_FALSE(open_file_range({.path = folder.path(), .length = 0}));
    const std::string pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const auto source = open_file_range({.path = pipe, .length = 0});
    ASSERT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::kIo);
    EXPECT_EQ(
        open_file_range({.path = std::string(5'000, 'n'), .length = 0}).error().code,
        ErrorCode::kIo);
}

TEST(FileBody, FileThatShrinksUnderTheSourceThrows) {
    const test::ScratchFolder folder;
    const std::string path = folder.write("f", test::pattern(2 * kFileChunk));
    const auto source =
        open_file_range({.path = path, .offset = 0, .length = 2 * kFileChunk});
    ASSERT_TRUE(source);
    EXPECT_TRUE((*source)());
    std::filesystem::resize_file(path, kFileChunk + 10);
    EXPECT_THROW((void)(*source)(), std::runtime_error);
}

TEST(FileBody, FileThatIsDeletedIsStillReadToItsEnd) {
    const test::ScratchFolder folder;
    const std::string content = test::pattern(2 * kFileChunk);
    const std::string path = folder.write("f", content);
    const auto source =
        open_file_range({.path = path, .offset = 0, .length = content.size()});
    ASSERT_TRUE(source);
    std::filesystem::remove(path);
    EXPECT_EQ(drain(*source), content);
}

}  // namespace
}  // namespace haarmony::http
