// What Database::open refuses, and that it leaves it exactly as it was.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "schema/database.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using Mode = Database::Mode;

// Opens `name` in both modes; each must fail with `code`, name the path, and leave every
// file of the folder as it was, without a new one beside it.
void expect_refused(const ScratchFolder& folder,
                    const std::string& name,
                    ErrorCode code,
                    const std::string& words = "") {
    const auto before = files_of(folder);
    for (const Mode mode : {Mode::kReadWriteCreate, Mode::kReadOnly}) {
        const auto result = Database::open(folder.file(name), mode);
        ASSERT_FALSE(result) << name;
        EXPECT_EQ(result.error().code, code) << result.error().message;
        EXPECT_NE(result.error().message.find(folder.file(name)), std::string::npos)
            << result.error().message;
        EXPECT_NE(result.error().message.find(words), std::string::npos)
            << result.error().message;
        EXPECT_EQ(files_of(folder), before) << name;
    }
}

TEST(Refusal, BytesThatAreNoDatabaseStayUntouched) {
    const ScratchFolder folder;
    write_bytes(folder.file("notes.txt"), "my notes");
    expect_refused(folder, "notes.txt", ErrorCode::kNotADatabase);
    write_bytes(folder.file("zeros"), std::string(8192, '\0'));
    expect_refused(folder, "zeros", ErrorCode::kNotADatabase);
    write_bytes(folder.file("cut"), std::string("SQLite format 3\0", 16));
    expect_refused(folder, "cut", ErrorCode::kNotADatabase);
}

TEST(Refusal, AnotherProgramsDatabaseStaysUntouched) {
    const ScratchFolder folder;
    {
        const RawConnection other(folder.file("browser.db"));
        run_sql(other.handle(), "CREATE TABLE history (url TEXT)");
    }
    expect_refused(folder, "browser.db", ErrorCode::kNotADatabase, "another program");
    {
        const RawConnection other(folder.file("fossil.db"));
        run_sql(other.handle(),
                "PRAGMA application_id = 252006673; PRAGMA user_version = 1;"
                "PRAGMA journal_mode = WAL; CREATE TABLE images (id INTEGER)");
    }
    expect_refused(folder, "fossil.db", ErrorCode::kNotADatabase, "252006673");
}

TEST(Refusal, AnotherProgramsDatabaseInUseStaysUntouched) {
    const ScratchFolder folder;
    const RawConnection other(folder.file("browser.db"));
    run_sql(other.handle(), "PRAGMA journal_mode = WAL; CREATE TABLE history (url TEXT)");
    ASSERT_TRUE(std::filesystem::exists(folder.file("browser.db-wal")));
    expect_refused(folder, "browser.db", ErrorCode::kNotADatabase, "another program");
}

TEST(Refusal, AJournalBesideOtherBytesDoesNotMakeThemOurs) {
    const ScratchFolder folder;
    const std::string magic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
    write_bytes(folder.file("notes.txt"), std::string(4096, 'n'));
    write_bytes(folder.file("notes.txt-journal"), magic + std::string(504, '\0'));
    expect_refused(folder, "notes.txt", ErrorCode::kNotADatabase);
    // Zeros, but the journal speaks of pages that were there before.
    write_bytes(folder.file("zeros"), std::string(4096, '\0'));
    write_bytes(folder.file("zeros-journal"),
                magic + std::string(8, '\0') + std::string("\0\0\0\x05", 4) +
                    std::string(492, '\0'));
    expect_refused(folder, "zeros", ErrorCode::kNotADatabase);
}

TEST(Refusal, ANewerVersionStaysUntouchedAndBothVersionsAreNamed) {
    const ScratchFolder folder;
    { const Database ours = open_database(folder.file("new.db")); }
    {
        const RawConnection newer(folder.file("new.db"));
        run_sql(newer.handle(), "PRAGMA user_version = 4711");
    }
    expect_refused(folder, "new.db", ErrorCode::kNewerVersion, "4711");
    expect_refused(folder,
                   "new.db",
                   ErrorCode::kNewerVersion,
                   "up to " + std::to_string(current_version()));
}

TEST(Refusal, ANewerVersionThatIsOnlyInTheLogIsSeenAndTheLogStays) {
    const ScratchFolder folder;
    const std::string path = folder.file("new.db");
    { const Database ours = open_database(path); }
    {
        RawConnection newer(path);
        newer.keep_log_on_close();
        run_sql(newer.handle(), "PRAGMA user_version = 4711");
    }
    const std::string file = read_bytes(path);
    const std::string log = read_bytes(path + "-wal");
    ASSERT_FALSE(log.empty());
    for (const Mode mode : {Mode::kReadWriteCreate, Mode::kReadOnly}) {
        const auto result = Database::open(path, mode);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kNewerVersion)
            << result.error().message;
        EXPECT_NE(result.error().message.find("4711"), std::string::npos);
    }
    EXPECT_EQ(read_bytes(path), file);
    EXPECT_EQ(read_bytes(path + "-wal"), log);
}

TEST(Refusal, OurMarkWithoutAVersionIsNoDatabaseOfOurs) {
    const ScratchFolder folder;
    {
        const RawConnection other(folder.file("odd.db"));
        run_sql(other.handle(),
                "PRAGMA application_id = " + std::to_string(kApplicationId) +
                    "; CREATE TABLE history (url TEXT)");
    }
    expect_refused(folder, "odd.db", ErrorCode::kNotADatabase);
}

TEST(Refusal, ADirectoryIsNamed) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.file("photos"));
    for (const Mode mode : {Mode::kReadWriteCreate, Mode::kReadOnly}) {
        const auto result = Database::open(folder.file("photos"), mode);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_EQ(result.error().message, folder.file("photos") + ": Is a directory");
    }
}

TEST(Refusal, AFifoIsRefusedWithoutWaitingForItsWriter) {
    const ScratchFolder folder;
    ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
    const auto result = Database::open(folder.file("pipe"), Mode::kReadWriteCreate);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kIo);
    EXPECT_EQ(result.error().message, folder.file("pipe") + ": not a regular file");
}

TEST(Refusal, APathThroughAFileOrALoopIsNamed) {
    const ScratchFolder folder;
    write_bytes(folder.file("plain"), "x");
    std::filesystem::create_symlink("loop", folder.file("loop"));
    for (const std::string name : {"plain/x.db", "loop"}) {
        const auto result = Database::open(folder.file(name), Mode::kReadWriteCreate);
        ASSERT_FALSE(result) << name;
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_NE(result.error().message.find(folder.file(name)), std::string::npos)
            << result.error().message;
    }
}

TEST(Refusal, AMissingFolderIsNamed) {
    const ScratchFolder folder;
    const std::string path = folder.file("missing/x.db");
    const auto writing = Database::open(path, Mode::kReadWriteCreate);
    ASSERT_FALSE(writing);
    EXPECT_EQ(writing.error().code, ErrorCode::kIo);
    EXPECT_NE(writing.error().message.find(path), std::string::npos);
}

TEST(Refusal, AnAbsentOrEmptyFileCannotBeReadOnly) {
    const ScratchFolder folder;
    write_bytes(folder.file("empty.db"), "");
    const auto before = files_of(folder);
    for (const std::string name : {"absent.db", "empty.db"}) {
        const auto result = Database::open(folder.file(name), Mode::kReadOnly);
        ASSERT_FALSE(result) << name;
        EXPECT_EQ(result.error().code, ErrorCode::kNotFound) << result.error().message;
        EXPECT_NE(result.error().message.find(folder.file(name)), std::string::npos);
    }
    EXPECT_EQ(files_of(folder), before);
}

TEST(Refusal, WhatIsNoPathIsAnInvalidArgument) {
    for (const std::string& path : {std::string(), std::string("a\0b", 3)}) {
        const auto result = Database::open(path, Mode::kReadWriteCreate);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    }
}

// Root may read and write everything: such a test must be somebody else for a moment.
class AsNobody {
  public:
    AsNobody() : was_root_(geteuid() == 0) {
        if (was_root_ && seteuid(65534) != 0) throw std::runtime_error("seteuid");
    }
    AsNobody(const AsNobody&) = delete;
    AsNobody& operator=(const AsNobody&) = delete;
    ~AsNobody() {
        if (was_root_ && seteuid(0) != 0) std::abort();
    }

  private:
    bool was_root_;
};

TEST(Refusal, AFileWithoutPermissionIsNamed) {
    const ScratchFolder folder;
    const std::string path = folder.file("secret.db");
    { const Database ours = open_database(path); }
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);

    std::filesystem::permissions(path, std::filesystem::perms::none);
    {
        const AsNobody nobody;
        const auto result = Database::open(path, Mode::kReadWriteCreate);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_NE(result.error().message.find(path), std::string::npos)
            << result.error().message;
    }
    std::filesystem::permissions(path, static_cast<std::filesystem::perms>(0444));
    {
        const AsNobody nobody;
        const auto result = Database::open(path, Mode::kReadWriteCreate);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_NE(result.error().message.find("cannot be written"), std::string::npos)
            << result.error().message;
    }
}

TEST(Refusal, AReadOnlyFolderTakesNoNewDatabase) {
    const ScratchFolder folder;
    std::filesystem::permissions(folder.path(),
                                 static_cast<std::filesystem::perms>(0555));
    const std::string path = folder.file("new.db");
    {
        const AsNobody nobody;
        const auto result = Database::open(path, Mode::kReadWriteCreate);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_NE(result.error().message.find(path), std::string::npos)
            << result.error().message;
    }
    std::filesystem::permissions(folder.path(), std::filesystem::perms::all);
    EXPECT_TRUE(files_of(folder).empty());
}

}  // namespace
}  // namespace haarmony::schema
