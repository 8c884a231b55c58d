// What haarmony-ingest leaves in the database: over several runs, and when it is ended in
// the middle of one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>

#include <chrono>
#include <filesystem>

#include "ingest/batch.h"
#include "schema/database.h"
#include "tests/ingest/ingest_fixture.h"

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using testing::HasSubstr;

class Resume : public IngestFixture {
  protected:
    // More than one batch and all that may wait behind it.
    static constexpr int kGood = static_cast<int>(kBatchRows) + 60;
    static constexpr int kMany = kGood + 1;
    // The first file found is a bad one. Its failure is a line on stderr, written after its
    // batch is committed: into a pipe that is full, so that the run stands still there,
    // with one batch committed and later ones not, for as long as a test likes.
    void write_many() const {
        folder_.write("pictures/0.jpg", "no picture");
        for (int i = 0; i < kGood; ++i) {
            folder_.write(
                "pictures/" + std::to_string(i % 9) + '/' + std::to_string(i) + ".jpg",
                jpeg_of(i, 32, 24));
        }
    }
    std::vector<std::string> command_that_stands_still() const {
        return command({"--jobs", "1", "--progress", "none", pictures_});
    }
    // Returns how many rows there are.
    int wait_for_more_rows(std::size_t than) const {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        std::size_t count = 0;
        while ((count = rows().size()) <= than) {
            if (std::chrono::steady_clock::now() > deadline) {
                ADD_FAILURE() << "no commit within a minute";
                break;
            }
            ::sched_yield();
        }
        return static_cast<int>(count);
    }
    std::map<std::string, StoredRow> rows_of_uninterrupted_run() const {
        const std::string other = folder_ / "uninterrupted.db";
        EXPECT_EQ(run_to_end({HAARMONY_INGEST, "--db", other, pictures_}, {}).status, 1);
        return without_ids(rows(other));
    }
    static std::map<std::string, StoredRow> without_ids(
        std::map<std::string, StoredRow> rows) {
        for (auto& [path, row] : rows) row = row.without_id();
        return rows;
    }

    void expect_orderly_end(int signal) const {
        write_many();
        ChildProcess child(command_that_stands_still(), {.full_errors = true});
        (void)wait_for_more_rows(0);
        child.signal(signal);
        EXPECT_EQ(child.wait(), 128 + signal);
        const int done = static_cast<int>(rows().size());
        EXPECT_LT(done, kMany);
        EXPECT_EQ(counts_of(child.out()),
                  "seen=" + std::to_string(done) + " added=" + std::to_string(done - 1) +
                      " updated=0 skipped=0 failed=1 pruned=0");
        EXPECT_EQ(lines_of(child.err()).size(), 1u) << child.err();
        EXPECT_EQ(ingest({pictures_}).status, 1);
        EXPECT_EQ(without_ids(rows()), rows_of_uninterrupted_run());
    }
};

TEST_F(Resume, KilledInTheMiddleItGoesOnAndEndsLikeARunThatWasNot) {
    write_many();
    ChildProcess child(command_that_stands_still(), {.full_errors = true});
    const int before = wait_for_more_rows(0);
    child.signal(SIGKILL);
    ASSERT_EQ(child.wait(), -SIGKILL);
    const auto kept = rows();
    ASSERT_EQ(static_cast<int>(kept.size()), before);
    ASSERT_LT(before, kMany);
    const Finished rest = ingest({pictures_});
    EXPECT_EQ(rest.status, 1);
    // Of those before, the bad one is tried again.
    EXPECT_EQ(
        counts_of(rest.out),
        "seen=" + std::to_string(kMany) + " added=" + std::to_string(kMany - before) +
            " updated=0 skipped=" + std::to_string(before - 1) + " failed=1 pruned=0");
    const auto now = rows();
    for (const auto& [path, row] : kept) EXPECT_EQ(now.at(path), row) << path;
    EXPECT_EQ(without_ids(now), rows_of_uninterrupted_run());
}

TEST_F(Resume, CtrlCCommitsWhatIsDoneAndIsToldInTheStatus) { expect_orderly_end(SIGINT); }

TEST_F(Resume, SigtermCommitsWhatIsDoneAndIsToldInTheStatus) {
    expect_orderly_end(SIGTERM);
}

TEST_F(Resume, AFullDiskIsStatus3AndWhatWasCommittedStays) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 24));
    expect_ingested("seen=1 added=1 updated=0 skipped=0 failed=0 pruned=0");
    write_many();
    const Finished full =
        ingest({"--jobs", "1", pictures_}, {.max_file_size = 128 << 10});
    EXPECT_EQ(full.status, 3);
    EXPECT_THAT(full.err, HasSubstr("haarmony-ingest: "));
    const auto kept = rows();
    EXPECT_TRUE(kept.contains(pictures_ + "/a.jpg"));
    EXPECT_LT(static_cast<int>(kept.size()), kMany + 1);
    EXPECT_THAT(counts_of(full.out), HasSubstr(" skipped=1 "));
    EXPECT_EQ(ingest({pictures_}).status, 1);
    EXPECT_EQ(without_ids(rows()), rows_of_uninterrupted_run());
}

TEST_F(Resume, ADatabaseThatStaysLockedIsStatus3AndSaysSo) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    expect_ingested("seen=1 added=1 updated=0 skipped=0 failed=0 pruned=0");
    folder_.write("pictures/b.jpg", jpeg_of(2, 32, 32));
    auto database =
        schema::Database::open(database_, schema::Database::Mode::kReadWriteCreate);
    ASSERT_TRUE(database);
    schema::ImageStore store(*database);
    Finished locked;
    ASSERT_TRUE(store.transaction([&]() -> Result<void> {
        locked = ingest({pictures_});
        return {};
    }));
    EXPECT_EQ(locked.status, 3);
    EXPECT_THAT(locked.err, HasSubstr("locked"));
    EXPECT_EQ(counts_of(locked.out),
              "seen=1 added=0 updated=0 skipped=1 failed=0 pruned=0");
    expect_ingested("seen=2 added=1 updated=0 skipped=1 failed=0 pruned=0");
}

TEST_F(Resume, UnchangedFilesAreSkippedAndChangedOnesKeepTheirId) {
    const std::string a = folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const std::string b = folder_.write("pictures/b.jpg", jpeg_of(2, 32, 32));
    const std::string c = folder_.write("pictures/c.jpg", jpeg_of(3, 32, 32));
    expect_ingested("seen=3 added=3 updated=0 skipped=0 failed=0 pruned=0");
    const auto first = rows();
    expect_ingested("seen=3 added=0 updated=0 skipped=3 failed=0 pruned=0");
    EXPECT_EQ(rows(), first);

    folder_.write("pictures/a.jpg", jpeg_of(4, 48, 32));
    ScratchFolder::set_mtime(b, kLongAgoNs + 1);
    expect_ingested("seen=3 added=0 updated=1 skipped=2 failed=0 pruned=0");
    auto second = rows();
    EXPECT_EQ(second.at(a).id, first.at(a).id);
    EXPECT_EQ(second.at(a).width, 48);
    EXPECT_NE(second.at(a).signature, first.at(a).signature);
    EXPECT_EQ(second.at(b).mtime_ns, kLongAgoNs + 1);
    second.at(b).mtime_ns = kLongAgoNs;
    EXPECT_EQ(second.at(b), first.at(b));
    EXPECT_EQ(second.at(c), first.at(c));
    expect_ingested("seen=3 added=0 updated=0 skipped=3 failed=0 pruned=0");
}

TEST_F(Resume, ADeletedPictureStaysDeletedUntilItsFileChangesOrItIsRestored) {
    const std::string a = folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    expect_ingested("seen=1 added=1 updated=0 skipped=0 failed=0 pruned=0");
    const StoredRow first = rows().at(a);
    remove_row(a);
    expect_ingested("seen=1 added=0 updated=0 skipped=1 failed=0 pruned=0");
    ScratchFolder::set_mtime(a, kLongAgoNs + 1);
    expect_ingested("seen=1 added=0 updated=0 skipped=1 failed=0 pruned=0");
    EXPECT_EQ(rows().at(a).state, ImageState::kDeleted);

    const Finished restored = ingest({"--restore", pictures_});
    EXPECT_EQ(counts_of(restored.out),
              "seen=1 added=0 updated=1 skipped=0 failed=0 pruned=0");
    StoredRow back = rows().at(a);
    back.mtime_ns = kLongAgoNs;
    EXPECT_EQ(back, first);
    const Finished again = ingest({"--restore", pictures_});
    EXPECT_EQ(counts_of(again.out),
              "seen=1 added=0 updated=0 skipped=1 failed=0 pruned=0");

    remove_row(a);
    folder_.write("pictures/a.jpg", jpeg_of(2, 32, 32));
    expect_ingested("seen=1 added=0 updated=1 skipped=0 failed=0 pruned=0");
    EXPECT_EQ(rows().at(a).state, ImageState::kIndexed);
    EXPECT_EQ(rows().at(a).id, first.id);
}

TEST_F(Resume, EqualFilesAreTwoRowsAndPruneDropsTheOneThatIsGone) {
    const std::string a = folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const std::string b = folder_.write("pictures/b.jpg", jpeg_of(1, 32, 32));
    expect_ingested("seen=2 added=2 updated=0 skipped=0 failed=0 pruned=0");
    std::filesystem::remove(a);
    expect_ingested("seen=1 added=0 updated=0 skipped=1 failed=0 pruned=0");
    EXPECT_EQ(rows().size(), 2u);
    EXPECT_EQ(counts_of(ingest({"--prune", pictures_}).out),
              "seen=1 added=0 updated=0 skipped=1 failed=0 pruned=1");
    EXPECT_EQ(rows().size(), 1u);
    EXPECT_TRUE(rows().contains(b));
    std::filesystem::rename(pictures_, folder_ / "elsewhere");
    EXPECT_EQ(ingest({"--prune", pictures_}).status, 3);
    EXPECT_EQ(rows().size(), 1u);
}

TEST_F(Resume, AFileThatFailsOnceIsStoredWhenItIsWhole) {
    const std::string whole = jpeg_of(1, 64, 64);
    const std::string a =
        folder_.write("pictures/a.jpg", whole.substr(0, whole.size() / 2));
    expect_ingested("seen=1 added=0 updated=0 skipped=0 failed=1 pruned=0", 1);
    const std::int64_t id = rows().at(a).id;
    folder_.write("pictures/a.jpg", whole);
    expect_ingested("seen=1 added=0 updated=1 skipped=0 failed=0 pruned=0");
    EXPECT_EQ(rows().at(a).id, id);
    EXPECT_EQ(rows().at(a).state, ImageState::kIndexed);
    // Damaged again: found no more, but its row stays.
    folder_.write("pictures/a.jpg", whole.substr(0, whole.size() / 3));
    expect_ingested("seen=1 added=0 updated=0 skipped=0 failed=1 pruned=0", 1);
    EXPECT_EQ(rows().at(a).state, ImageState::kFailed);
    EXPECT_EQ(rows().at(a).id, id);
}

}  // namespace
}  // namespace haarmony::ingest
