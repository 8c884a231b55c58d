#include "server/app/snapshot_keeper.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "server/app/snapshot_job.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"
#include "tests/server/app/job_watch.h"
#include "tests/server/app/log_watch.h"
#include "tests/server/app/snapshot_contents.h"

namespace haarmony::server {
namespace {

using schema::JobState;

bool always(std::uint64_t, std::uint64_t) { return true; }

class SnapshotKeeperTest : public testing::Test {
  protected:
    void add(unsigned first, unsigned count) {
        const auto other = beside(collection_);
        for (unsigned n = first; n < first + count; ++n)
            ASSERT_TRUE(
                other->images().add(file_row(n, "file:///p/" + std::to_string(n))));
    }
    void follow() {
        keeper_.reset();
        follower_.reset();
        FollowerOptions options;
        options.database_path = collection_.path();
        options.poll_interval = std::chrono::milliseconds(1);
        options.snapshot_path = path();
        follower_ = IndexFollower::start(options).value();
        ASSERT_TRUE(becomes_true([&] { return follower_->ready(); }));
    }
    // By itself it looks all the time, or as good as never.
    void keep(bool by_itself, std::int64_t least_changes = 4) {
        SnapshotKeeperOptions options;
        options.database_path = collection_.path();
        options.threads = 2;
        options.least_changes = least_changes;
        options.look_interval = by_itself
                                    ? std::chrono::milliseconds(1)
                                    : std::chrono::milliseconds(std::chrono::hours(1));
        options.retry_interval = options.look_interval;
        keeper_ = std::make_unique<SnapshotKeeper>(options, *follower_);
    }
    [[nodiscard]] std::string path() const {
        return snapshot_path_of(collection_.path());
    }
    [[nodiscard]] bool comes_to(std::int64_t sequence) const {
        return becomes_true([&] { return keeper_->sequence() == sequence; });
    }

    Collection collection_;
    std::unique_ptr<IndexFollower> follower_;
    std::unique_ptr<SnapshotKeeper> keeper_;
};

TEST_F(SnapshotKeeperTest, LiesBesideTheDatabase) {
    EXPECT_EQ(snapshot_path_of("/a/b.db"), "/a/b.db.snapshot");
}

TEST_F(SnapshotKeeperTest, WritesWhenAskedAndTellsWhatItWrote) {
    add(1, 3);
    follow();
    keep(false);
    EXPECT_EQ(keeper_->sequence(), std::nullopt);
    std::uint64_t told = 0;
    const auto written = keeper_->write([&](std::uint64_t bytes, std::uint64_t total) {
        EXPECT_LE(told, bytes);
        told = bytes;
        EXPECT_LE(bytes, total);
        return true;
    });
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_GT(told, 0U);
    EXPECT_EQ(written->bytes, std::int64_t(std::filesystem::file_size(path())));
    EXPECT_EQ(written->images, 3);
    EXPECT_EQ(written->sequence, 3);
    EXPECT_EQ(keeper_->sequence(), 3);
}

TEST_F(SnapshotKeeperTest, WritesByItselfWhatWasReadFromTheDatabase) {
    add(1, 3);
    follow();
    keep(true);
    EXPECT_TRUE(comes_to(3));
    EXPECT_TRUE(read_some(path(), 60));
    // What a file was taken from needs none.
    follow();
    const LogWatch written("event=snapshot_written");
    keep(true);
    EXPECT_EQ(keeper_->sequence(), 3);
    keeper_->save_and_stop();
    EXPECT_TRUE(written.lines().empty());
}

TEST_F(SnapshotKeeperTest, WritesByItselfWhenEnoughHasChanged) {
    add(1, 2);
    follow();
    keep(true);
    ASSERT_TRUE(comes_to(2));
    add(3, 4);
    EXPECT_TRUE(comes_to(6));
    const LogWatch written("event=snapshot_written");
    add(7, 3);
    ASSERT_TRUE(becomes_true([&] { return follower_->sequence() == 9; }));
    EXPECT_EQ(keeper_->sequence(), 6);
    // One more is enough, and nothing was written in between.
    add(10, 1);
    EXPECT_TRUE(comes_to(10));
    EXPECT_EQ(written.lines().size(), 1U);
}

TEST_F(SnapshotKeeperTest, AnEmptyDatabaseIsNotWorthAFile) {
    follow();
    keep(true);
    keeper_->save_and_stop();
    EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(SnapshotKeeperTest, SavesWhatHasChangedWhenItIsStopped) {
    add(1, 2);
    follow();
    keep(false);
    keeper_->save_and_stop();
    EXPECT_EQ(keeper_->sequence(), 2);
    follow();
    keep(false);
    add(3, 1);
    ASSERT_TRUE(follower_->catch_up());
    keeper_->save_and_stop();
    EXPECT_EQ(keeper_->sequence(), 3);
    keeper_->save_and_stop();
    follow();
    EXPECT_EQ(follower_->began_with(), 3);
}

// Nothing else stops for it: it is logged, and tried again.
TEST_F(SnapshotKeeperTest, WhereItCannotWriteItSaysSoAndTheRestGoesOn) {
    add(1, 2);
    follow();
    std::filesystem::create_directories(path() + ".partial/occupied");
    const LogWatch failed("event=snapshot_failed");
    keep(true);
    EXPECT_TRUE(becomes_true([&] { return failed.lines().size() >= 2; }));
    EXPECT_NE(failed.lines()[0].find(".partial: cannot be written"), std::string::npos)
        << failed.lines()[0];
    add(3, 1);
    EXPECT_TRUE(becomes_true([&] { return follower_->snapshot()->stats().images == 3; }));
    std::filesystem::remove_all(path() + ".partial");
    // Of what it had when it began: before the last change or after it.
    ASSERT_TRUE(becomes_true([&] { return keeper_->sequence().has_value(); }));
    const auto kept = keeper_->sequence();
    std::filesystem::create_directories(path() + ".partial/occupied");
    add(4, 1);
    ASSERT_TRUE(follower_->catch_up());
    const std::size_t before = failed.lines().size();
    keeper_->save_and_stop();
    EXPECT_EQ(failed.lines().size(), before + 1);
    EXPECT_EQ(keeper_->sequence(), kept);
}

TEST_F(SnapshotKeeperTest, PicturesThatComeWhileItWritesAreFoundAndLeftOut) {
    add(1, 5);
    follow();
    keep(false);
    bool added = false;
    const auto written = keeper_->write([&](std::uint64_t, std::uint64_t) {
        if (!added) {
            added = true;
            add(6, 1);
            EXPECT_TRUE(follower_->catch_up());
            EXPECT_EQ(follower_->snapshot()->stats().images, 6);
        }
        return true;
    });
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_EQ(written->images, 5);
    EXPECT_EQ(written->sequence, 5);
    follow();
    EXPECT_EQ(follower_->began_with(), 5);
    EXPECT_EQ(follower_->snapshot()->stats().images, 6);
}

TEST_F(SnapshotKeeperTest, BeforeTheCollectionIsLoadedThereIsNothingToWrite) {
    const schema::RawConnection raw(collection_.path());
    schema::run_sql(raw.handle(), "ALTER TABLE changes RENAME TO elsewhere");
    FollowerOptions options;
    options.database_path = collection_.path();
    follower_ = IndexFollower::start(options).value();
    keep(false);
    const auto written = keeper_->write(always);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kUnavailable);
    keeper_->save_and_stop();
    EXPECT_FALSE(std::filesystem::exists(path()));
}

class SnapshotJobTest : public SnapshotKeeperTest {
  protected:
    std::unique_ptr<JobRunner> runner() {
        JobRunnerOptions options;
        options.database_path = collection_.path();
        options.progress_interval = std::chrono::milliseconds(0);
        JobTypes types;
        types["snapshot"] = snapshot_job(*follower_, *keeper_);
        return JobRunner::start(options, std::move(types)).value();
    }
};

TEST_F(SnapshotJobTest, CountsBytesAndTellsWhatTheFileHolds) {
    add(1, 4);
    follow();
    keep(false);
    const auto jobs = runner();
    const schema::Job job = done(*jobs, "snapshot", "{}");
    EXPECT_EQ(job.state, JobState::kDone);
    const auto bytes = std::int64_t(std::filesystem::file_size(path()));
    EXPECT_EQ(job.counts.seen, bytes);
    EXPECT_EQ(job.total, bytes);
    const std::string result = "\"bytes\":" + std::to_string(bytes) + ",\"images\":4";
    EXPECT_NE(job.result.find(result), std::string::npos) << job.result;
    EXPECT_NE(job.result.find("\"sequence\":4"), std::string::npos) << job.result;
}

TEST_F(SnapshotJobTest, AFileThatCannotBeWrittenFailsTheJob) {
    add(1, 1);
    follow();
    keep(false);
    std::filesystem::create_directories(path() + ".partial/occupied");
    const auto jobs = runner();
    const schema::Job job = done(*jobs, "snapshot", "{}");
    EXPECT_EQ(job.state, JobState::kFailed);
    EXPECT_EQ(job.errors.size(), 1U);
}

TEST_F(SnapshotJobTest, CancelledItLeavesTheFileThatWasThere) {
    add(1, 2);
    follow();
    keep(false);
    ASSERT_TRUE(keeper_->write(always));
    const std::string before = bytes_in(path());
    const auto connection = beside(collection_);
    const std::int64_t id = connection->jobs().create("snapshot", "{}")->id;
    const std::atomic<bool> stop{true};
    JobContext context(*connection,
                       connection->jobs().get(id).value(),
                       stop,
                       std::chrono::milliseconds(0));
    EXPECT_TRUE(snapshot_job(*follower_, *keeper_).run(context));
    EXPECT_TRUE(context.was_interrupted());
    EXPECT_EQ(bytes_in(path()), before);
}

TEST_F(SnapshotJobTest, WaitsForTheCollection) {
    add(1, 2);
    const schema::RawConnection raw(collection_.path());
    schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
    schema::run_sql(raw.handle(), "ALTER TABLE changes RENAME TO elsewhere");
    FollowerOptions options;
    options.database_path = collection_.path();
    options.poll_interval = std::chrono::milliseconds(1);
    follower_ = IndexFollower::start(options).value();
    keep(false);
    const auto jobs = runner();
    const std::int64_t id = jobs->create("snapshot", "{}")->id;
    EXPECT_TRUE(becomes_true([&] { return jobs->get(id)->state == JobState::kRunning; }));
    schema::run_sql(raw.handle(), "ALTER TABLE elsewhere RENAME TO changes");
    EXPECT_EQ(finished(*jobs, id).state, JobState::kDone);
    EXPECT_TRUE(std::filesystem::exists(path()));
}

}  // namespace
}  // namespace haarmony::server
