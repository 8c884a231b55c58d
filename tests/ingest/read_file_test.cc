#include "ingest/read_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <string>

#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {
namespace {

constexpr std::int64_t kPlenty = 1 << 20;

std::string text_of(const FileContent& content) {
    return {content.bytes.begin(), content.bytes.end()};
}

TEST(ReadFile, GivesAllBytesAndTheLookAndHoldsItsShare) {
    const ScratchFolder folder;
    const std::string text(100'000, 'x');
    const std::string path = folder.write("a", text);
    ByteBudget budget(kPlenty);
    {
        const Result<FileContent> content = read_file(path, {}, budget);
        ASSERT_TRUE(content) << content.error().message;
        EXPECT_EQ(text_of(*content), text);
        EXPECT_EQ(content->look, (FileLook{100'000, kLongAgoNs}));
        EXPECT_EQ(budget.in_use(), 100'000);
    }
    EXPECT_EQ(budget.in_use(), 0);
}

TEST(ReadFile, TheLimitItselfIsStillRead) {
    const ScratchFolder folder;
    const std::string path = folder.write("a", "12345");
    ByteBudget budget(kPlenty);
    EXPECT_TRUE(read_file(path, {.max_bytes = 5}, budget));
    const Result<FileContent> content = read_file(path, {.max_bytes = 4}, budget);
    ASSERT_FALSE(content);
    EXPECT_EQ(content.error().code, ErrorCode::kTooLarge);
    EXPECT_EQ(content.error().message, "5 bytes, more than the limit of 4");
}

TEST(ReadFile, WhatIsNoRegularFileAnyMoreIsGone) {
    const ScratchFolder folder;
    ByteBudget budget(kPlenty);
    ASSERT_EQ(::mkfifo((folder / "fifo").c_str(), 0600), 0);
    ASSERT_EQ(::symlink("loop", (folder / "loop").c_str()), 0);
    folder.make_folder("folder");
    folder.write("file", "");
    for (const char* name : {"missing", "fifo", "folder", "loop", "file/below"}) {
        const Result<FileContent> content = read_file(folder / name, {}, budget);
        ASSERT_FALSE(content) << name;
        EXPECT_EQ(content.error().code, ErrorCode::kNotFound) << name;
    }
}

TEST(ReadFile, WhatTheKernelRefusesSaysWhy) {
    ByteBudget budget(kPlenty);
    const Result<FileContent> name = read_file("/" + std::string(300, 'x'), {}, budget);
    ASSERT_FALSE(name);
    EXPECT_EQ(name.error().code, ErrorCode::kIo);
    EXPECT_EQ(name.error().message, "File name too long");
}

TEST(ReadFile, AFileThatChangedIsReadAgain) {
    const ScratchFolder folder;
    const std::string path = folder.write("a", "old");
    ByteBudget budget(kPlenty);
    int reads = 0;
    ReadLimits limits;
    limits.before_second_look = [&] {
        if (++reads == 1) std::ofstream(path) << "newer";
    };
    const Result<FileContent> content = read_file(path, limits, budget);
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_EQ(text_of(*content), "newer");
    EXPECT_EQ(reads, 2);
}

TEST(ReadFile, AFileThatNeverRestsIsAFailure) {
    const ScratchFolder folder;
    const std::string path = folder.write("a", "");
    ByteBudget budget(kPlenty);
    int reads = 0;
    ReadLimits limits;
    limits.before_second_look = [&] {
        ++reads;
        std::ofstream(path, std::ios::app) << "x";
    };
    const Result<FileContent> content = read_file(path, limits, budget);
    ASSERT_FALSE(content);
    EXPECT_EQ(content.error().code, ErrorCode::kUnavailable);
    EXPECT_EQ(content.error().message, "changes while it is read");
    EXPECT_EQ(reads, kReadAttempts);
    EXPECT_EQ(budget.in_use(), 0);
}

TEST(ReadFile, AFileThatShrinksIsReadAgainAsItIs) {
    const ScratchFolder folder;
    const std::string path = folder.write("a", "a long text");
    ByteBudget budget(kPlenty);
    bool shrunk = false;
    ReadLimits limits;
    limits.before_second_look = [&] {
        if (!std::exchange(shrunk, true)) {
            ASSERT_EQ(::truncate(path.c_str(), 3), 0);
        }
    };
    const Result<FileContent> content = read_file(path, limits, budget);
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_EQ(text_of(*content), "a l");
}

}  // namespace
}  // namespace haarmony::ingest
