#include "schema/database.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "schema/image_store.h"
#include "tests/schema/failing_files.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using Mode = Database::Mode;

TEST(Database, AnAbsentAndAnEmptyFileBecomeADatabase) {
    const ScratchFolder folder;
    write_bytes(folder.file("empty.db"), "");
    for (const std::string name : {"absent.db", "empty.db"}) {
        const Database database = open_database(folder.file(name));
        EXPECT_EQ(sql_integer(database.handle(), "PRAGMA user_version"),
                  current_version());
        EXPECT_EQ(sql_integer(database.handle(), "PRAGMA application_id"),
                  kApplicationId);
    }
}

TEST(Database, TheConnectionHasTheSettingsThatTheReadmePromises) {
    const ScratchFolder folder;
    const Database database = open_database(folder.file("x.db"));
    EXPECT_EQ(sql_text(database.handle(), "PRAGMA journal_mode"), "wal");
    EXPECT_EQ(sql_integer(database.handle(), "PRAGMA synchronous"), 2);
    EXPECT_EQ(sql_integer(database.handle(), "PRAGMA foreign_keys"), 1);
    EXPECT_EQ(sql_integer(database.handle(), "PRAGMA busy_timeout"), kBusyTimeoutMs);
    EXPECT_EQ(sql_integer(database.handle(),
                          "SELECT count(*) FROM pragma_table_list"
                          " WHERE schema = 'main' AND type = 'table' AND NOT strict"
                          " AND name NOT LIKE 'sqlite_%'"),
              0);
}

TEST(Database, NamesThatSqliteReadsAsSomethingElseAreFiles) {
    const ScratchFolder folder;
    const auto was = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    for (const std::string name : {":memory:", "file:x.db?mode=memory"}) {
        { const Database database = open_database(name); }
        EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
    }
    std::filesystem::current_path(was);
}

TEST(Database, OpeningAnExistingOneChangesNothing) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    { const Database database = open_database(path); }
    const auto before = files_of(folder);
    { const Database database = open_database(path); }
    { const auto reader = expect(Database::open(path, Mode::kReadOnly)); }
    EXPECT_EQ(files_of(folder).at("x.db"), before.at("x.db"));
}

// A database of the current version that was not yet switched to write-ahead logging, as
// between the two steps of its creation.
void make_without_log(const std::string& path) {
    { const Database database = open_database(path); }
    const RawConnection connection(path);
    run_sql(connection.handle(), "PRAGMA journal_mode = DELETE");
}

TEST(Database, TheSwitchToTheLogWaitsForAnotherWriter) {
    FailingFiles files;
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    make_without_log(path);
    const RawConnection writer(path);
    run_sql(writer.handle(), "BEGIN IMMEDIATE");
    bool released = false;
    files.when_lock_is_refused(3, [&] {
        run_sql(writer.handle(), "ROLLBACK");
        released = true;
    });
    const Database database = open_database(path);
    EXPECT_TRUE(released);
    EXPECT_EQ(sql_text(database.handle(), "PRAGMA journal_mode"), "wal");
}

TEST(Database, AWriterWhoNeverEndsMakesItUnavailable) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    make_without_log(path);
    const RawConnection writer(path);
    run_sql(writer.handle(), "BEGIN IMMEDIATE");
    const auto result = Database::open(path, Mode::kReadWriteCreate);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUnavailable) << result.error().message;
    EXPECT_NE(result.error().message.find(path), std::string::npos);
}

TEST(Database, AReadOnlyConnectionReadsAndRefusesToWrite) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    Database writer = open_database(path);
    ImageStore store(writer);
    const ImageId id = expect(store.add(file_picture(1)));

    Database reader = expect(Database::open(path, Mode::kReadOnly));
    ImageStore view(reader);
    EXPECT_EQ(expect(view.get(id)).uri, file_picture(1).uri);
    const auto added = view.add(file_picture(2));
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::kIo);
    EXPECT_NE(added.error().message.find("readonly"), std::string::npos)
        << added.error().message;
}

TEST(Database, DataVersionTellsOfOthersCommitsOnly) {
    const ScratchFolder folder;
    Database follower = open_database(folder.file("x.db"));
    Database writer = open_database(folder.file("x.db"));
    ImageStore store(writer);
    ImageStore own(follower);

    const auto quiet = expect(follower.data_version());
    EXPECT_EQ(expect(follower.data_version()), quiet);
    expect(own.add(file_picture(0)));
    EXPECT_EQ(expect(follower.data_version()), quiet);
    expect(store.add(file_picture(1)));
    const auto after = expect(follower.data_version());
    EXPECT_NE(after, quiet);
    EXPECT_EQ(expect(follower.data_version()), after);
    const auto rolled_back = store.transaction([&]() -> Result<void> {
        expect(store.add(file_picture(2)));
        return Error{ErrorCode::kConflict, "changed its mind"};
    });
    EXPECT_FALSE(rolled_back);
    EXPECT_EQ(expect(follower.data_version()), after);
}

TEST(Database, AMovedConnectionGoesOnWorking) {
    const ScratchFolder folder;
    Database first = open_database(folder.file("x.db"));
    Database other = open_database(folder.file("y.db"));
    const auto version = expect(first.data_version());
    Database second = std::move(first);
    EXPECT_EQ(expect(second.data_version()), version);
    other = std::move(second);
    EXPECT_EQ(expect(other.data_version()), version);
    EXPECT_EQ(std::filesystem::path(
                  sql_text(other.handle(), "SELECT file FROM pragma_database_list"))
                  .filename(),
              "x.db");
}

TEST(Database, ASymbolicLinkAndItsTargetAreOneDatabase) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder.file("disk"));
    std::filesystem::create_symlink("disk/x.db", folder.file("link.db"));
    Database through_link = open_database(folder.file("link.db"));
    Database direct = open_database(folder.file("disk/x.db"));
    ImageStore writer(through_link);
    ImageStore reader(direct);
    const ImageId id = expect(writer.add(file_picture(1)));
    EXPECT_EQ(expect(reader.get(id)).uri, file_picture(1).uri);
}

}  // namespace
}  // namespace haarmony::schema
