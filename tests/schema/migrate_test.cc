#include "schema/migrate.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include "schema/curve_store.h"
#include "schema/database.h"
#include "schema/duplicate_store.h"
#include "schema/feedback_store.h"
#include "schema/image_store.h"
#include "schema/job_store.h"
#include "schema/profile_store.h"
#include "schema/snapshot_store.h"
#include "schema/video_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

// Of a snapshot, in hexadecimal digits and as the store has it.
const std::string kToken = "0102030405060708090a0b0c0d0e0f10";
constexpr SnapshotToken
    kTokenBytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};

// What the tables of `version` and of those before hold beside the pictures.
void add_newer_rows(sqlite3* database, int version) {
    const std::pair<int, std::string> rows[] = {
        {3, "INSERT INTO image_signatures VALUES (3, 'old-variant', x'0a0b')"},
        {5,
         "INSERT INTO profiles VALUES (7, 'old', 'yiq', 'standard', 40, 'min',"
         " '[[1,2,3,4,5,6],[1,2,3,4,5,6],[1,2,3,4,5,6]]', NULL, NULL, '2020')"},
        {6,
         "INSERT INTO jobs VALUES (4, 't', '{}', 'queued', 0, 1, 2, 3, 4, 5, 6, 'here',"
         " '{}', '2020', '', '')"},
        {7, "INSERT INTO feedback VALUES (9, 'painted', 1, NULL, '{}', 1.5, '2020')"},
        {8,
         "INSERT INTO duplicate_generations VALUES (3, 1, '2020');"
         "INSERT INTO duplicates VALUES (3, 1, 2, 'near', 0.5)"},
        {9, "INSERT INTO snapshots VALUES (2, x'" + kToken + "', 5, '2020')"},
        {10,
         "INSERT INTO curves VALUES (6, 'stroke', 'old', 1, 1, x'000000000000F03F',"
         " '2020')"},
        {11,
         "INSERT INTO videos VALUES (8, '0123456789abcdef', 'old', 3, 4, 5, 30, 1, 0.5,"
         " 1, 2, 3, 4, 5, 6, 7, 1, NULL, '2020');"
         "INSERT INTO frame_signatures VALUES (2, 8, 3, 4, 1, x'0a')"}};
    for (const auto& [since, sql] : rows) {
        if (version >= since) run_sql(database, sql);
    }
}

// The rows of add_newer_rows() through the stores.
void expect_newer_rows(Database& database, int version) {
    ImageStore images(database);
    EXPECT_EQ(images.signature(ImageId{3}, "old-variant").has_value(), version >= 3);
    ProfileStore profiles(database);
    EXPECT_EQ(profiles.get("old").has_value(), version >= 5);
    JobStore jobs(database);
    const auto job = expect(jobs.next_queued());
    ASSERT_EQ(job.has_value(), version >= 6);
    if (job) {
        EXPECT_EQ(job->position, "here");
        EXPECT_EQ(job->counts, (JobCounts{1, 2, 3, 4, 5}));
    }
    FeedbackStore feedback(database);
    EXPECT_EQ(expect(feedback.count("painted")), version >= 7 ? 1 : 0);
    CurveStore curves(database);
    const auto stroke = curves.get(CurveKind::kStroke, "old");
    ASSERT_EQ(stroke.has_value(), version >= 10);
    if (stroke) {
        EXPECT_EQ(stroke->numbers, std::vector<double>{1});
    }
    VideoStore videos(database);
    const auto video = videos.get(8);
    ASSERT_EQ(video.has_value(), version >= 11);
    if (video) {
        EXPECT_EQ(video->frames, 5);
        EXPECT_EQ(expect(videos.frames_after(0, 9)).size(), 1u);
    }
    DuplicateStore duplicates(database);
    EXPECT_EQ(expect(duplicates.pairs(0)).size(), version >= 8 ? 1u : 0u);
    SnapshotStore snapshots(database);
    EXPECT_EQ(expect(snapshots.find(kTokenBytes)).has_value(), version >= 9);
    // All three files of the fixture have one hash.
    EXPECT_EQ(expect(duplicates.same_content()).size(), 1u);
}

// A database as version `version` left it, with pictures written by that version's SQL:
// ids 1 to 5, of which 4 failed and 5 is deleted.
void make_fixture(const std::string& path, int version) {
    const RawConnection connection(path);
    sqlite3* database = connection.handle();
    expect(migrate(database, migrations().first(static_cast<std::size_t>(version))));
    run_sql(database, "PRAGMA journal_mode = WAL; PRAGMA foreign_keys = ON");
    for (int number = 1; number <= 5; ++number) {
        const std::string state = number < 4    ? "indexed"
                                  : number == 4 ? "failed"
                                                : "deleted";
        const std::string n = std::to_string(number);
        run_sql(database,
                "INSERT INTO images VALUES (" + n + ", 'file', '" + state +
                    "', 'file:///old/" + n +
                    "', 10, 20, 'hash', 30, 40, 'image/png', 0, " +
                    (number < 4 ? "x'0102030" + n + "'" : "NULL") + ", '" +
                    (number == 4 ? "broken" : "") +
                    "', '2020-01-01T00:00:00.000Z', '2020-01-01T00:00:00.000Z', 1,"
                    " '{\"n\":" +
                    n + "}')");
        run_sql(database, "INSERT INTO image_tags VALUES (" + n + ", 'old')");
    }
    run_sql(database, "INSERT INTO thumbnails VALUES (1, 'image/webp', x'ff')");
    add_newer_rows(database, version);
}

std::string schema_text(sqlite3* database) {
    return sql_text(
        database,
        "SELECT group_concat(type || name || coalesce(sql, ''), char(10)) FROM"
        " (SELECT * FROM sqlite_schema ORDER BY type, name)");
}

TEST(Migrate, EveryOlderVersionReachesTheSchemaOfANewDatabaseAndKeepsItsRows) {
    const ScratchFolder folder;
    const Database fresh = open_database(folder.file("fresh.db"));
    for (int version = 1; version <= current_version(); ++version) {
        SCOPED_TRACE(version);
        const std::string path = folder.file(std::to_string(version) + ".db");
        make_fixture(path, version);
        Database database = open_database(path);
        EXPECT_EQ(schema_text(database.handle()), schema_text(fresh.handle()));
        EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");

        ImageStore store(database);
        for (int number = 1; number <= 3; ++number) {
            const Image image = expect(store.get(ImageId{number}));
            EXPECT_EQ(image.uri, "file:///old/" + std::to_string(number));
            EXPECT_EQ(image.tags, std::vector<std::string>{"old"});
            EXPECT_EQ(expect(store.signature(ImageId{number})).back(), number);
        }
        EXPECT_EQ(expect(store.get(ImageId{4})).failure, "broken");
        EXPECT_EQ(expect(store.thumbnail(ImageId{1})).bytes.size(), 1u);
        EXPECT_EQ(expect(store.counts()).deleted, 1);

        // A follower that starts from nothing learns of every searchable picture.
        std::vector<ImageId> searchable;
        for (const Change& change : expect(store.changes_after(0, 100))) {
            if (!change.signature.empty()) searchable.push_back(change.id);
        }
        EXPECT_EQ(searchable, (std::vector{ImageId{1}, ImageId{2}, ImageId{3}}));
        // Words of before are found, and of pictures that can be searched alone.
        EXPECT_EQ(expect(store.matching({.text = "old", .tags = {"old"}})), searchable);
        EXPECT_EQ(expect(store.matching({.text = "\"old 2\"", .tags = {}})),
                  std::vector{ImageId{2}});
        run_sql(database.handle(),
                "INSERT INTO image_text (image_text) VALUES ('integrity-check')");
        expect_newer_rows(database, version);
        EXPECT_GT(to_int(expect(store.add(file_picture(1)))), 5);
    }
}

TEST(Migrate, IsNumberedFromOneWithoutAGap) {
    ASSERT_FALSE(migrations().empty());
    for (std::size_t i = 0; i < migrations().size(); ++i) {
        EXPECT_EQ(migrations()[i].version, static_cast<int>(i) + 1);
    }
}

TEST(Migrate, AFailingStepLeavesTheVersionBeforeItAndNothingOfItself) {
    const ScratchFolder folder;
    const RawConnection connection(folder.file("x.db"));
    const Migration steps[] = {
        {1, "0001_one.sql", "CREATE TABLE one (a INTEGER); INSERT INTO one VALUES (1);"},
        {2,
         "0002_two.sql",
         "CREATE TABLE two (a); INSERT INTO one VALUES (2); nonsense;"}};
    for (int attempt = 0; attempt < 2; ++attempt) {
        const auto result = migrate(connection.handle(), steps);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        for (const std::string words : {"x.db", "0002_two.sql", "nonsense"}) {
            EXPECT_NE(result.error().message.find(words), std::string::npos)
                << result.error().message;
        }
        EXPECT_EQ(sql_integer(connection.handle(), "PRAGMA user_version"), 1);
        EXPECT_EQ(sql_integer(connection.handle(), "SELECT sum(a) FROM one"), 1);
        EXPECT_EQ(sql_integer(connection.handle(),
                              "SELECT count(*) FROM sqlite_schema WHERE name = 'two'"),
                  0);
        EXPECT_NE(sqlite3_get_autocommit(connection.handle()), 0);
    }
}

TEST(Migrate, AStepThatLeavesDanglingReferencesIsRolledBack) {
    const ScratchFolder folder;
    const RawConnection connection(folder.file("x.db"));
    const Migration steps[] = {
        {1,
         "0001_one.sql",
         "CREATE TABLE one (a INTEGER PRIMARY KEY);"
         "CREATE TABLE two (a INTEGER REFERENCES one (a)); INSERT INTO two VALUES (9);"}};
    const auto result = migrate(connection.handle(), steps);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("1 rows that refer to nothing"),
              std::string::npos)
        << result.error().message;
    EXPECT_EQ(sql_integer(connection.handle(), "PRAGMA user_version"), 0);
    EXPECT_EQ(sql_integer(connection.handle(), "SELECT count(*) FROM sqlite_schema"), 0);
}

TEST(Migrate, AFullDiskLeavesTheOlderVersionWhole) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    make_fixture(path, 1);
    {
        const RawConnection connection(path);
        run_sql(connection.handle(),
                "PRAGMA max_page_count = 1");  // no page more than now
        const auto result = migrate(connection.handle(), migrations());
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kIo);
        EXPECT_NE(result.error().message.find("full"), std::string::npos)
            << result.error().message;
        EXPECT_EQ(sql_integer(connection.handle(), "PRAGMA user_version"), 1);
        EXPECT_EQ(sql_integer(connection.handle(), "SELECT count(*) FROM images"), 5);
    }
    const Database database = open_database(path);
    EXPECT_EQ(sql_integer(database.handle(), "PRAGMA user_version"), current_version());
}

TEST(Migrate, WaitsNoLongerThanTheBusyTimeoutForAnotherWriter) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    make_fixture(path, 1);
    const RawConnection writer(path);
    run_sql(writer.handle(), "BEGIN IMMEDIATE; DELETE FROM thumbnails");
    const RawConnection connection(path);
    const auto result = migrate(connection.handle(), migrations());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kUnavailable) << result.error().message;
}

TEST(Migrate, AnOlderVersionCannotBeOpenedReadOnly) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    make_fixture(path, 1);
    const auto before = read_bytes(path);
    const auto result = Database::open(path, Database::Mode::kReadOnly);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kConflict);
    for (const std::string& words :
         {path, std::string("version 1"), std::to_string(current_version())}) {
        EXPECT_NE(result.error().message.find(words), std::string::npos)
            << result.error().message;
    }
    EXPECT_EQ(read_bytes(path), before);
}

TEST(Migrate, AnUpToDateDatabaseOpensWhileAnotherProcessWrites) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    Database writer = open_database(path);
    run_sql(writer.handle(), "BEGIN IMMEDIATE; DELETE FROM thumbnails");
    Database second = open_database(path);
    ImageStore store(second);
    EXPECT_EQ(expect(store.counts()).indexed, 0);
    run_sql(writer.handle(), "ROLLBACK");
}

}  // namespace
}  // namespace haarmony::schema
