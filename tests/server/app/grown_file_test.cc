#include "server/app/grown_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

void write_text(const std::string& path, const std::string& text) {
    const FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644));
    ASSERT_TRUE(file);
    ASSERT_TRUE(write_at(file, 0, bytes_of(text), path));
}

TEST(GrownFile, IsACopyThatGrowsAndLeavesTheOriginalAlone) {
    const schema::ScratchFolder folder;
    std::mt19937 random(1);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{5}, std::size_t{3} << 20}) {
        std::string original(size, '\0');
        for (char& byte : original) byte = static_cast<char>(random());
        write_text(folder.file("original"), original);
        // Whatever an earlier run has left there.
        write_text(folder.file("copy"), std::string(size + 100, 'x'));
        auto file = GrownFile::copy_of(folder.file("original"), folder.file("copy"));
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(schema::read_bytes(folder.file("copy")), original);
        ASSERT_TRUE(file->write(size, bytes_of("more")));
        std::string want = original + "more";
        ASSERT_TRUE(file->write(size / 2, bytes_of("ab")));
        want.replace(size / 2, 2, "ab");
        ASSERT_TRUE(file->sync());
        EXPECT_EQ(schema::read_bytes(folder.file("copy")), want);
        EXPECT_EQ(schema::read_bytes(folder.file("original")), original);
    }
}

TEST(GrownFile, NamesWhatIsMissing) {
    const schema::ScratchFolder folder;
    const auto nothing = GrownFile::copy_of(folder.file("gone"), folder.file("copy"));
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().code, ErrorCode::kNotFound);
    EXPECT_NE(nothing.error().message.find("gone"), std::string::npos);
    write_text(folder.file("there"), "x");
    const auto nowhere = GrownFile::copy_of(folder.file("there"), folder.file("no/copy"));
    ASSERT_FALSE(nowhere);
    EXPECT_NE(nowhere.error().message.find("no/copy"), std::string::npos);
}

TEST(GrownFile, SaysWhenTheDeviceIsFull) {
    const schema::ScratchFolder folder;
    write_text(folder.file("original"), "x");
    const auto full = GrownFile::copy_of(folder.file("original"), "/dev/full");
    ASSERT_FALSE(full);
    EXPECT_EQ(full.error().code, ErrorCode::kIo);
    EXPECT_NE(full.error().message.find("/dev/full"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::server
