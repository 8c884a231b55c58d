// The disk fails: at every step, by being full, by handing back broken pages.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "schema/image_store.h"
#include "schema/migrate.h"
#include "tests/schema/failing_files.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

constexpr int kSomeSteps = 3;  // fewer, and the countdown did not reach the files at all

// Runs `work` with the first, second, ... operation on files failing, until one run has no
// failure; `check` looks at what each of them left, with the files working again.
template <typename Work, typename Check>
void fail_at_every_step(FailingFiles& files, int result_code, Work work, Check check) {
    for (int step = 0;; ++step) {
        SCOPED_TRACE(step);
        files.fail_from(step, result_code);
        const bool succeeded = work();
        const bool failed = files.failed();
        files.never_fail();
        check(succeeded);
        if (testing::Test::HasFailure()) return;
        if (!failed) {
            EXPECT_TRUE(succeeded);
            EXPECT_GE(step, kSomeSteps);
            return;
        }
    }
}

void add_pictures(ImageStore& store, int count) {
    expect(store.transaction([&]() -> Result<void> {
        for (int i = 0; i < count; ++i) expect(store.add(file_picture(i)));
        return {};
    }));
}

TEST(Failure, AtAnyStepOfCreatingTheNextOpeningMakesAWholeDatabase) {
    for (const int result_code : {SQLITE_FULL, SQLITE_IOERR_FSYNC}) {
        SCOPED_TRACE(result_code);
        FailingFiles files;
        const ScratchFolder folder;
        int round = 0;
        std::string path;
        fail_at_every_step(
            files,
            result_code,
            [&] {
                path = folder.file(std::to_string(++round) + ".db");
                const auto result =
                    Database::open(path, Database::Mode::kReadWriteCreate);
                if (!result) {
                    EXPECT_EQ(result.error().code, ErrorCode::kIo)
                        << result.error().message;
                    EXPECT_NE(result.error().message.find(path), std::string::npos)
                        << result.error().message;
                }
                return result.has_value();
            },
            [&](bool) {
                Database database = open_database(path);
                EXPECT_EQ(sql_integer(database.handle(), "PRAGMA user_version"),
                          current_version());
                EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
            });
    }
}

TEST(Failure, AtAnyStepOfMigratingTheRowsStayAndTheNextOpeningFinishes) {
    FailingFiles files;
    const ScratchFolder folder;
    int round = 0;
    std::string path;
    fail_at_every_step(
        files,
        SQLITE_FULL,
        [&] {
            files.never_fail();
            path = folder.file(std::to_string(++round) + ".db");
            {
                const RawConnection old(path);
                expect(migrate(old.handle(), migrations().first(1)));
                run_sql(old.handle(), "PRAGMA journal_mode = WAL");
                run_sql(
                    old.handle(),
                    "INSERT INTO images VALUES (1, 'file', 'indexed', 'u', 1, 1, '', 1,"
                    " 1, '', 0, x'01', '', '', '', 1, '{}')");
            }
            files.fail_from(round - 1, SQLITE_FULL);
            return Database::open(path, Database::Mode::kReadWriteCreate).has_value();
        },
        [&](bool) {
            Database database = open_database(path);
            ImageStore store(database);
            EXPECT_EQ(expect(store.changes_after(0, 10)).size(), 1u);
            EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
        });
}

TEST(Failure, AtAnyStepOfABatchAllOfItIsThereOrNothing) {
    constexpr int kBatch = 2;
    for (const int result_code : {SQLITE_FULL, SQLITE_IOERR_WRITE}) {
        SCOPED_TRACE(result_code);
        FailingFiles files;
        const ScratchFolder folder;
        const std::string path = folder.file("x.db");
        std::int64_t before = 0;
        int round = 0;
        fail_at_every_step(
            files,
            result_code,
            [&] {
                ++round;
                files.never_fail();
                Database database = open_database(path);
                // A small cache: pages overflow into the log in the middle of the batch.
                run_sql(database.handle(), "PRAGMA cache_size = 2");
                ImageStore store(database);
                before = expect(store.counts()).indexed;
                files.fail_from(round - 1, result_code);
                const auto result = store.transaction([&]() -> Result<void> {
                    for (int i = 0; i < kBatch; ++i) {
                        const auto id = store.add(file_picture(round * kBatch + i));
                        // As a careless caller: on with the rest after a failure.
                        EXPECT_TRUE(id || id.error().code == ErrorCode::kIo);
                    }
                    return {};
                });
                if (!result) {
                    EXPECT_EQ(result.error().code, ErrorCode::kIo)
                        << result.error().message;
                }
                // Until the connection is gone nothing works; then the disk is well again.
                return result.has_value();
            },
            [&](bool) {
                Database database = open_database(path);
                ImageStore store(database);
                EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
                const auto rows = expect(store.counts()).indexed;
                EXPECT_GE(rows, before);
                EXPECT_EQ(
                    sql_integer(database.handle(), "SELECT count(*) FROM thumbnails"),
                    rows);
                EXPECT_EQ(sql_integer(database.handle(), "SELECT count(*) FROM changes"),
                          rows);
            });
    }
}

// A failed write may make SQLite roll back the whole transaction and go on without one:
// what the caller adds next must not be committed by itself.
TEST(Failure, WhatFollowsALostTransactionIsRefused) {
    FailingFiles files;
    const ScratchFolder folder;
    Database database = open_database(folder.file("x.db"));
    run_sql(database.handle(), "PRAGMA cache_size = 2");
    ImageStore store(database);
    add_pictures(store, 1);
    const auto result = store.transaction([&]() -> Result<void> {
        files.fail_from(0, SQLITE_IOERR_WRITE);
        int number = 1;
        while (store.add(file_picture(number)) && number < 1000) ++number;
        files.never_fail();
        EXPECT_NE(sqlite3_get_autocommit(database.handle()), 0);
        const auto late = store.add(file_picture(2000));
        EXPECT_FALSE(late);
        if (!late) {
            EXPECT_EQ(late.error().code, ErrorCode::kIo);
            EXPECT_NE(late.error().message.find("rolled back by an earlier failure"),
                      std::string::npos)
                << late.error().message;
        }
        return {};
    });
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("rolled back"), std::string::npos)
        << result.error().message;
    EXPECT_EQ(expect(store.counts()).indexed, 1);
    EXPECT_TRUE(store.add(file_picture(3000)));
}

TEST(Failure, AFullDiskIsSaidAndTheStoreGoesOnWhenThereIsRoom) {
    const ScratchFolder folder;
    Database database = open_database(folder.file("x.db"));
    ImageStore store(database);
    const ImageId kept = expect(store.add(file_picture(0)));
    const auto pages = sql_integer(database.handle(), "PRAGMA page_count");
    run_sql(database.handle(), "PRAGMA max_page_count = " + std::to_string(pages + 8));

    Result<void> result;
    int number = 0;
    while (result) {
        ASSERT_LT(number, 100);
        result = store.transaction([&]() -> Result<void> {
            for (int i = 0; i < 4; ++i) {
                const auto id = store.add(file_picture(++number));
                if (!id) return id.error();
            }
            return {};
        });
    }
    EXPECT_EQ(result.error().code, ErrorCode::kIo);
    EXPECT_NE(result.error().message.find("full"), std::string::npos)
        << result.error().message;
    EXPECT_EQ(expect(store.counts()).indexed % 4, 1);
    EXPECT_EQ(expect(store.signature(kept)), file_picture(0).signature);

    run_sql(database.handle(), "PRAGMA max_page_count = 1000000");
    EXPECT_TRUE(store.add(file_picture(1000)));
    EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
}

void expect_broken(const Error& error) {
    EXPECT_EQ(error.code, ErrorCode::kIo) << error.message;
    EXPECT_NE(error.message.find("malformed"), std::string::npos) << error.message;
}

TEST(Failure, ABrokenPageIsAnErrorOfEveryFunctionThatMeetsIt) {
    for (const std::string object : {"images",
                                     "images_file_uri",
                                     "images_state",
                                     "thumbnails",
                                     "image_tags",
                                     "changes"}) {
        SCOPED_TRACE(object);
        const ScratchFolder folder;
        const std::string path = folder.file("x.db");
        {
            Database database = open_database(path);
            ImageStore store(database);
            add_pictures(store, 40);
        }
        break_page(path, object);
        Database database = open_database(path);
        ImageStore store(database);
        const auto nothing = [](auto&&...) {};
        if (object == "images") {
            expect_broken(store.get(ImageId{1}).error());
            expect_broken(store.get_many(std::vector{ImageId{1}}).error());
            expect_broken(store.signature(ImageId{1}).error());
            expect_broken(store.for_each_searchable(nothing).error());
            expect_broken(store.changes_after(0, 10).error());
            expect_broken(store.list({}).error());
            expect_broken(store.update(ImageId{1}, file_picture(1)).error());
            expect_broken(store.touch(ImageId{1}, {}).error());
            expect_broken(store.remove(ImageId{1}).error());
            expect_broken(store.purge(ImageId{1}).error());
        } else if (object == "images_file_uri") {
            expect_broken(store.known_file(file_picture(1).uri).error());
            expect_broken(store.for_each_file("file:", nothing).error());
            expect_broken(store.mark_failed(file_picture(1).uri, {}, "cut").error());
        } else if (object == "images_state") {
            expect_broken(store.counts().error());
            expect_broken(store.searchable_ranges(10).error());
        } else if (object == "thumbnails") {
            expect_broken(store.thumbnail(ImageId{1}).error());
        } else if (object == "image_tags") {
            expect_broken(store.get(ImageId{1}).error());
        } else {
            expect_broken(store.changes_after(0, 10).error());
            expect_broken(store.for_each_searchable(nothing).error());
            expect_broken(store.last_sequence().error());
        }
        expect_broken(store.add(file_picture(1000)).error());
    }
}

TEST(Failure, ABrokenFirstPageIsAnErrorOfOpening) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    { const Database database = open_database(path); }
    std::string bytes = read_bytes(path);
    for (std::size_t at = 100; at < 4096; ++at) bytes[at] = '\xee';
    write_bytes(path, bytes);
    for (const auto mode :
         {Database::Mode::kReadWriteCreate, Database::Mode::kReadOnly}) {
        const auto result = Database::open(path, mode);
        ASSERT_FALSE(result);
        expect_broken(result.error());
        EXPECT_NE(result.error().message.find(path), std::string::npos);
    }
    EXPECT_EQ(read_bytes(path), bytes);
}

TEST(Failure, AFileCutShortIsAnError) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    {
        Database database = open_database(path);
        ImageStore store(database);
        add_pictures(store, 40);
    }
    const std::string bytes = read_bytes(path);
    write_bytes(path, bytes.substr(0, 8192));
    auto database = Database::open(path, Database::Mode::kReadWriteCreate);
    if (!database) {
        expect_broken(database.error());
        return;
    }
    ImageStore store(*database);
    expect_broken(store.for_each_searchable([](const SearchableImage&) {}).error());
}

}  // namespace
}  // namespace haarmony::schema
