#include "server/app/file_spool.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

std::vector<std::byte> bytes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::byte> made(count);
    for (std::byte& byte : made) byte = static_cast<std::byte>(random());
    return made;
}

// Around the megabyte that is gathered before it is written.
TEST(FileSpool, GivesBackWhatWasAppendedWhereverItIs) {
    const schema::ScratchFolder folder;
    auto spool = FileSpool::nameless(folder.path());
    ASSERT_TRUE(spool) << spool.error().message;
    std::vector<std::pair<std::uint64_t, std::vector<std::byte>>> pieces;
    unsigned seed = 0;
    for (const std::size_t size : {1, 0, 700'000, 700'000, 3'000'000, 5, 1'048'576, 9}) {
        const auto piece = bytes(size, ++seed);
        const auto offset = spool->append(piece);
        ASSERT_TRUE(offset) << offset.error().message;
        pieces.emplace_back(*offset, piece);
        for (const auto& [at, want] : pieces) {
            std::vector<std::byte> got(want.size());
            ASSERT_TRUE(spool->read(at, got));
            EXPECT_EQ(got, want) << "at " << at;
        }
    }
    // Across what is written and what waits.
    std::vector<std::byte> all;
    for (const auto& [at, piece] : pieces)
        all.insert(all.end(), piece.begin(), piece.end());
    std::vector<std::byte> got(all.size());
    ASSERT_TRUE(spool->read(0, got));
    EXPECT_EQ(got, all);
    EXPECT_EQ(spool->bytes(), all.size());
}

TEST(FileSpool, WithoutANameLeavesNothingInTheFolder) {
    const schema::ScratchFolder folder;
    const auto spool = FileSpool::nameless(folder.path());
    ASSERT_TRUE(spool);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FileSpool, WithANameIsTheFileOnceItIsSynchronised) {
    const schema::ScratchFolder folder;
    schema::write_bytes(folder.file("x"), "what was there before");
    auto spool = FileSpool::named(folder.file("x"));
    ASSERT_TRUE(spool) << spool.error().message;
    const std::string text = "abc";
    ASSERT_TRUE(spool->append(std::as_bytes(std::span(text))));
    ASSERT_TRUE(spool->sync());
    EXPECT_EQ(schema::read_bytes(folder.file("x")), text);
}

TEST(FileSpool, WithoutAFolderIsAnErrorThatNamesIt) {
    const schema::ScratchFolder folder;
    const auto check = [](const Result<FileSpool>& spool) {
        ASSERT_FALSE(spool);
        EXPECT_NE(spool.error().message.find("none/"), std::string::npos)
            << spool.error().message;
    };
    check(FileSpool::nameless(folder.file("none")));
    check(FileSpool::named(folder.file("none/x")));
}

}  // namespace
}  // namespace haarmony::server
