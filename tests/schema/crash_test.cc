// kill -9 at chosen and at arbitrary moments: what was committed is there, whole; what was
// not is gone, whole.
#include <gtest/gtest.h>

#include <filesystem>

#include "schema/duplicate_store.h"
#include "schema/feedback_store.h"
#include "schema/image_store.h"
#include "schema/job_store.h"
#include "schema/migrate.h"
#include "tests/schema/child_process.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

constexpr int kBatch = 20;  // as in schema_process

// Pictures 0 .. count - 1 and nothing else, every row with all its parts.
void expect_pictures(Database& database, int count) {
    EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
    ImageStore store(database);
    ASSERT_EQ(expect(store.counts()).indexed, count);
    for (int number = 0; number < count; ++number) {
        const NewImage want = file_picture(number);
        const auto known = expect(store.known_file(want.uri));
        ASSERT_TRUE(known.has_value()) << want.uri;
        EXPECT_EQ(expect(store.signature(known->id)), want.signature);
        EXPECT_EQ(expect(store.thumbnail(known->id)).bytes, want.thumbnail.bytes);
        EXPECT_EQ(expect(store.get(known->id)).tags.size(), want.tags.size());
    }
    EXPECT_EQ(sql_integer(database.handle(), "SELECT count(*) FROM changes"), count);
    EXPECT_EQ(sql_integer(database.handle(), "SELECT count(*) FROM thumbnails"), count);
}

TEST(Crash, RightAfterTheFirstCommitNothingIsLost) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    {
        ChildProcess child({"transaction", path});
        ASSERT_EQ(child.read_line(), "inside");
        child.kill();
    }
    // The rows are still in the log alone.
    EXPECT_GT(std::filesystem::file_size(path + "-wal"), 0u);
    {
        Database reader = expect(Database::open(path, Database::Mode::kReadOnly));
        expect_pictures(reader, kBatch);
    }
    Database database = open_database(path);
    expect_pictures(database, kBatch);
}

TEST(Crash, RightAfterTheFirstCommitWithoutTheSharedIndexNothingIsLost) {
    const ScratchFolder folder;
    const std::string path = folder.file("x.db");
    {
        ChildProcess child({"transaction", path});
        ASSERT_EQ(child.read_line(), "inside");
        child.kill();
    }
    std::filesystem::remove(path + "-shm");  // as after a restart of the machine
    Database database = open_database(path);
    expect_pictures(database, kBatch);
}

TEST(Crash, AtAnyMomentCommittedBatchesAreWholeAndNumbersGoOn) {
    const ScratchFolder folder;
    for (int stop_after = 0; stop_after < 6; ++stop_after) {
        SCOPED_TRACE(stop_after);
        const std::string path = folder.file(std::to_string(stop_after) + ".db");
        int reported = -1;
        {
            ChildProcess child({"add", path});
            while (reported < stop_after) {
                const auto line = child.read_line();
                ASSERT_TRUE(line.has_value());
                reported = std::stoi(*line);
            }
            for (const std::string& line : child.kill()) reported = std::stoi(line);
        }
        Database database = open_database(path);
        const auto rows = sql_integer(database.handle(), "SELECT count(*) FROM images");
        EXPECT_EQ(rows % kBatch, 0);
        // The last batch may have been committed and not yet reported.
        EXPECT_GE(rows, (reported + 1) * kBatch);
        EXPECT_LE(rows, (reported + 2) * kBatch);
        expect_pictures(database, static_cast<int>(rows));

        const auto last = sql_integer(database.handle(), "SELECT max(seq) FROM changes");
        ImageStore store(database);
        expect(store.add(upload_picture(1)));
        EXPECT_EQ(expect(store.changes_after(last, 10)).size(), 1u);
    }
}

TEST(Crash, AtAnyMomentJobsFeedbackAndDuplicatesAreWhole) {
    const ScratchFolder folder;
    for (int stop_after = 1; stop_after <= 4; ++stop_after) {
        SCOPED_TRACE(stop_after);
        const std::string path = folder.file(std::to_string(stop_after) + ".db");
        int reported = 0;
        {
            ChildProcess child({"stores", path});
            while (reported < stop_after) {
                const auto line = child.read_line();
                ASSERT_TRUE(line.has_value());
                reported = std::stoi(*line);
            }
            for (const std::string& line : child.kill()) reported = std::stoi(line);
        }
        Database database = open_database(path);
        EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");

        // The round that was cut off may have come to any of its steps.
        JobStore jobs(database);
        const auto all = expect(jobs.list(1000, std::nullopt));
        ASSERT_GE(all.size(), static_cast<std::size_t>(reported));
        ASSERT_LE(all.size(), static_cast<std::size_t>(reported) + 1);
        for (const Job& job : all) {
            const auto progress = job.counts.seen;
            if (job.id <= reported) {
                EXPECT_EQ(progress, job.id);
            }
            EXPECT_TRUE(progress == job.id || progress == 0);
            EXPECT_EQ(job.counts.added, progress);
            EXPECT_EQ(job.position, progress == 0 ? "" : std::to_string(progress));
            EXPECT_EQ(job.errors.size(), progress == 0 ? 0u : 3u);
        }
        const auto running = sql_integer(
            database.handle(), "SELECT count(*) FROM jobs WHERE state = 'running'");
        EXPECT_GE(running, reported);
        EXPECT_EQ(expect(jobs.requeue_running()), running);
        EXPECT_EQ(expect(jobs.next_queued())->position, "1");

        FeedbackStore feedback(database);
        EXPECT_GE(expect(feedback.count("painted")), reported);
        DuplicateStore duplicates(database);
        const auto generation = expect(duplicates.published_generation());
        EXPECT_TRUE(generation == reported || generation == reported + 1) << generation;
        const auto pairs = expect(duplicates.pairs(0));
        ASSERT_EQ(pairs.size(), 2u);
        for (const DuplicatePair& pair : pairs) {
            EXPECT_EQ(pair.similarity, static_cast<double>(generation));
        }
        EXPECT_GT(expect(duplicates.begin_generation()), generation);
    }
}

TEST(Crash, InTheMiddleOfAnyMigrationTheNextOpeningFinishesIt) {
    const ScratchFolder folder;
    for (int version = 1; version <= current_version(); ++version) {
        SCOPED_TRACE(version);
        const std::string path = folder.file(std::to_string(version) + ".db");
        {
            ChildProcess child({"migrate", path, std::to_string(version)});
            ASSERT_EQ(child.read_line(), "inside");
            child.kill();
        }
        // Half of it is on the disk: with its journal (first one), or in the log.
        EXPECT_GT(std::filesystem::file_size(path), 0u);
        EXPECT_GT(std::filesystem::file_size(path + (version == 1 ? "-journal" : "-wal")),
                  0u);
        Database database = open_database(path);
        EXPECT_EQ(sql_integer(database.handle(), "PRAGMA user_version"),
                  current_version());
        EXPECT_EQ(sql_text(database.handle(), "PRAGMA integrity_check"), "ok");
        ImageStore store(database);
        expect(store.add(file_picture(1)));
        EXPECT_EQ(expect(store.changes_after(0, 10)).size(), 1u);
    }
}

}  // namespace
}  // namespace haarmony::schema
