#include "server/app/mapped_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

std::string text_of(const MappedFile& file) {
    const auto bytes = file.bytes();
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(MappedFile, HasTheBytesOfTheFileWhateverBecomesOfItsName) {
    const schema::ScratchFolder folder;
    const std::string path = folder.file("x");
    const std::string text(10'000, 'a');
    schema::write_bytes(path, text);
    const auto file = MappedFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(text_of(**file), text);
    schema::write_bytes(folder.file("y"), "other");
    std::filesystem::rename(folder.file("y"), path);
    EXPECT_EQ(text_of(**file), text);
    std::filesystem::remove(path);
    EXPECT_EQ(text_of(**file), text);
    // Hints change nothing.
    MappedFile::forget((*file)->bytes());
    MappedFile::expect((*file)->bytes());
    EXPECT_EQ(text_of(**file), text);
}

TEST(MappedFile, OfNothingHasNothing) {
    const schema::ScratchFolder folder;
    schema::write_bytes(folder.file("x"), "");
    const auto file = MappedFile::open(folder.file("x"));
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE((*file)->bytes().empty());
    MappedFile::expect({});
}

TEST(MappedFile, NamesWhatCannotBeMapped) {
    const schema::ScratchFolder folder;
    const auto gone = MappedFile::open(folder.file("gone"));
    ASSERT_FALSE(gone);
    EXPECT_EQ(gone.error().code, ErrorCode::kNotFound);
    EXPECT_NE(gone.error().message.find("gone"), std::string::npos);
    const auto is_folder = MappedFile::open(folder.path());
    ASSERT_FALSE(is_folder);
    EXPECT_EQ(is_folder.error().code, ErrorCode::kIo);
    const auto closed = MappedFile::of(-1, "nowhere");
    ASSERT_FALSE(closed);
    EXPECT_NE(closed.error().message.find("nowhere"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::server
