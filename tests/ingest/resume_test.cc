// What haarmony-ingest leaves in the database: over several runs, and when it is ended in
// the middle of one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>

#include <chrono>
#include <filesystem>

#include "ingest/change.h"
#include "schema/database.h"
#include "tests/ingest/ingest_fixture.h"

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using testing::HasSubstr;
using testing::StartsWith;

class Resume : public IngestFixture {
  protected:
    // Enough work that the first commit comes long before the end.
    static constexpr int kMany = 200;
    void write_many() const {
        for (int i = 0; i < kMany; ++i) {
            folder_.write(
                "pictures/" + std::to_string(i % 9) + '/' + std::to_string(i) + ".jpg",
                jpeg_of(i, 800, 600));
        }
    }
    // False when the child ended before, or after a minute.
    bool wait_for_rows(std::size_t count) const {
        const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
        while (rows().size() < count) {
            if (std::chrono::steady_clock::now() > deadline) return false;
            ::sched_yield();
        }
        return true;
    }
    std::map<std::string, StoredRow> rows_of_uninterrupted_run() const {
        const std::string other = folder_ / "uninterrupted.db";
        EXPECT_EQ(run_to_end({HAARMONY_INGEST, "--db", other, pictures_}, {}).status, 0);
        return without_ids(rows(other));
    }
    static std::map<std::string, StoredRow> without_ids(
        std::map<std::string, StoredRow> rows) {
        for (auto& [path, row] : rows) row = row.without_id();
        return rows;
    }
    static std::string counts(int seen, int added, int skipped) {
        return "seen=" + std::to_string(seen) + " added=" + std::to_string(added) +
               " updated=0 skipped=" + std::to_string(skipped) + " failed=0 pruned=0";
    }
};

TEST_F(Resume, KilledAtAnyMomentItGoesOnAndEndsLikeARunThatWasNot) {
    write_many();
    std::size_t before = 0;
    for (const int step : {1, 60}) {
        ChildProcess child(command({"--jobs", "1", pictures_}), {});
        ASSERT_TRUE(wait_for_rows(before + step));
        child.signal(SIGKILL);
        ASSERT_EQ(child.wait(), -SIGKILL) << "it was too fast to be killed";
        before = rows().size();
        ASSERT_LT(before, static_cast<std::size_t>(kMany));
    }
    const auto kept = rows();
    const Finished rest = ingest({pictures_});
    EXPECT_EQ(rest.status, 0);
    const int done = static_cast<int>(before);
    EXPECT_EQ(counts_of(rest.out), counts(kMany, kMany - done, done));
    const auto now = rows();
    for (const auto& [path, row] : kept) EXPECT_EQ(now.at(path), row) << path;
    EXPECT_EQ(without_ids(now), rows_of_uninterrupted_run());
}

TEST_F(Resume, ASignalCommitsWhatIsDoneAndIsToldInTheStatus) {
    write_many();
    std::size_t before = 0;
    for (const int signal : {SIGINT, SIGTERM}) {
        ChildProcess child(command({"--jobs", "1", pictures_}), {});
        ASSERT_TRUE(wait_for_rows(before + 1));
        child.signal(signal);
        EXPECT_EQ(child.wait(), 128 + signal);
        const int now = static_cast<int>(rows().size());
        ASSERT_LT(now, kMany) << "it was too fast to be stopped";
        const int done = static_cast<int>(before);
        EXPECT_THAT(
            counts_of(child.out()),
            testing::AnyOf(counts(now, now - done, done),
                           // Stopped before the walk had passed all known files.
                           HasSubstr("added=" + std::to_string(now - done) + ' ')));
        EXPECT_EQ(child.err(), "");
        before = static_cast<std::size_t>(now);
    }
    ASSERT_EQ(ingest({pictures_}).status, 0);
    EXPECT_EQ(without_ids(rows()), rows_of_uninterrupted_run());
}

TEST_F(Resume, AFullDiskIsStatus3AndWhatWasCommittedStays) {
    write_many();
    const Finished full = ingest({"--jobs", "1", pictures_}, {.max_file_size = 1 << 20});
    EXPECT_EQ(full.status, 3);
    EXPECT_THAT(full.err, StartsWith("haarmony-ingest: "));
    const auto kept = rows();
    const int done = static_cast<int>(kept.size());
    EXPECT_GT(done, 0);
    EXPECT_LT(done, kMany);
    EXPECT_EQ(counts_of(full.out), counts(done, done, 0));
    EXPECT_EQ(counts_of(ingest({pictures_}).out), counts(kMany, kMany - done, done));
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
