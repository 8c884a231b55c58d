// A follower that begins with a snapshot file, or rightly does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/image/signature_codec.h"
#include "server/app/snapshot_keeper.h"
#include "tests/schema/raw_sql.h"
#include "tests/server/app/collection.h"
#include "tests/server/app/log_watch.h"
#include "tests/server/app/snapshot_contents.h"

namespace haarmony::server {
namespace {

class SnapshotFollow : public testing::Test {
  protected:
    void add(unsigned first, unsigned count) {
        const auto other = beside(collection_);
        for (unsigned n = first; n < first + count; ++n)
            ASSERT_TRUE(
                other->images().add(file_row(n, "file:///p/" + std::to_string(n))));
    }
    void sql(const std::string& statement) {
        const schema::RawConnection raw(collection_.path());
        schema::run_sql(raw.handle(), "PRAGMA busy_timeout = 5000");
        schema::run_sql(raw.handle(), statement);
    }
    [[nodiscard]] std::string path() const {
        return snapshot_path_of(collection_.path());
    }

    void start(int index_m = 60) {
        follower_.reset();
        FollowerOptions options;
        options.database_path = collection_.path();
        options.index = {index_m, 4};
        options.poll_interval = std::chrono::milliseconds(1);
        options.snapshot_path = path();
        options.threads = 2;
        auto started = IndexFollower::start(options);
        ASSERT_TRUE(started) << started.error().message;
        follower_ = std::move(started).value();
        ASSERT_TRUE(becomes_true([&] { return follower_->ready(); }));
    }
    // A file of what the follower has now; the last change that is in it.
    std::int64_t save() {
        SnapshotKeeperOptions options;
        options.database_path = collection_.path();
        options.look_interval = std::chrono::hours(1);
        SnapshotKeeper keeper(options, *follower_);
        const auto written =
            keeper.write([](std::uint64_t, std::uint64_t) { return true; });
        EXPECT_TRUE(written) << written.error().message;
        return written->sequence;
    }
    // All that a search can say of the collection.
    [[nodiscard]] std::vector<image::Match> matches(
        const std::string& variant = "yiq-standard") const {
        const image::Query query =
            image::make_query(image::make_signature(image::scene(32, 32, 1).view()),
                              *image::built_in_profile("painted"),
                              40);
        const Snapshots snapshots = follower_->snapshots();
        const auto found = snapshots.find(variant);
        return found == snapshots.end() ? std::vector<image::Match>{}
                                        : found->second->search(query, {1000}).matches;
    }
    // Starts anew with the file, which must be refused for the reason; what is found is that
    // of the database nevertheless.
    void expect_ignored(const std::string& reason, int index_m = 60) {
        SCOPED_TRACE(reason);
        const LogWatch log("event=snapshot_ignored");
        start(index_m);
        EXPECT_EQ(follower_->began_with(), std::nullopt);
        ASSERT_EQ(log.lines().size(), 1U);
        EXPECT_NE(log.lines()[0].find(reason), std::string::npos) << log.lines()[0];
        const auto found = matches();
        std::filesystem::rename(path(), path() + ".aside");
        start(index_m);
        EXPECT_EQ(found, matches());
        std::filesystem::rename(path() + ".aside", path());
    }

    Collection collection_;
    std::unique_ptr<IndexFollower> follower_;
};

TEST_F(SnapshotFollow, AnswersAreThoseOfBeforeAndNothingIsReadAnew) {
    add(1, 11);
    {
        const auto other = beside(collection_);
        const schema::SignatureVariant lab{"lab-standard",
                                           image::encode_signature(image::make_signature(
                                               image::scene(96, 64, 1).view()))};
        ASSERT_TRUE(other->images().set_variant(ImageId{2}, lab));
        ASSERT_TRUE(other->images().set_variant(ImageId{5}, lab));
        ASSERT_TRUE(other->images().set_variant(ImageId{6}, {"lab-standard", {1, 2}}));
    }
    start();
    // Tombstones in segments and in the tail.
    ASSERT_TRUE(beside(collection_)->images().remove(ImageId{1}));
    ASSERT_TRUE(beside(collection_)->images().remove(ImageId{11}));
    ASSERT_TRUE(follower_->catch_up());
    const auto before = matches();
    const auto lab = matches("lab-standard");
    ASSERT_EQ(before.size(), 9U);
    ASSERT_EQ(lab.size(), 2U);
    const std::int64_t sequence = save();
    EXPECT_EQ(sequence, follower_->sequence());

    // What the file does not say must come from nowhere.
    const LogWatch log("event=loaded");
    start();
    EXPECT_EQ(follower_->began_with(), sequence);
    EXPECT_EQ(follower_->sequence(), sequence);
    EXPECT_EQ(matches(), before);
    EXPECT_EQ(matches("lab-standard"), lab);
    EXPECT_EQ(follower_->damaged(), 1);
    EXPECT_TRUE(log.lines().empty());
}

TEST_F(SnapshotFollow, OfAnEmptyDatabaseItIsAsGoodAsAnyOther) {
    start();
    save();
    start();
    EXPECT_EQ(follower_->began_with(), 0);
    EXPECT_TRUE(matches().empty());
}

TEST_F(SnapshotFollow, WhatCameAfterTheFileIsReplayed) {
    add(1, 6);
    start();
    const std::int64_t sequence = save();
    follower_.reset();
    add(7, 3);
    {
        const auto other = beside(collection_);
        ASSERT_TRUE(other->images().remove(ImageId{2}));
        ASSERT_TRUE(other->images().update(ImageId{3}, file_row(30, "file:///p/3")));
    }
    start();
    EXPECT_EQ(follower_->began_with(), sequence);
    EXPECT_GT(follower_->sequence(), sequence);
    auto with = matches();
    EXPECT_EQ(with.size(), 8U);
    std::filesystem::remove(path());
    start();
    EXPECT_EQ(follower_->began_with(), std::nullopt);
    EXPECT_EQ(with, matches());
}

TEST_F(SnapshotFollow, WhatIsDamagedIsRepairedLater) {
    add(1, 3);
    sql("UPDATE images SET signature = x'0011' WHERE id = 2");
    start();
    EXPECT_EQ(follower_->damaged(), 1);
    save();
    start();
    ASSERT_TRUE(follower_->began_with());
    EXPECT_EQ(follower_->damaged(), 1);
    ASSERT_TRUE(
        beside(collection_)->images().update(ImageId{2}, file_row(2, "file:///p/2")));
    EXPECT_TRUE(becomes_true([&] { return follower_->damaged() == 0; }));
    EXPECT_EQ(matches().size(), 3U);
}

TEST_F(SnapshotFollow, ADamagedFileIsIgnored) {
    add(1, 5);
    start();
    save();
    const std::string whole = bytes_in(path());
    const auto with = [&](std::size_t place) {
        std::string damaged = whole;
        damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
        return damaged;
    };
    const auto put = [&](const std::string& bytes) {
        follower_.reset();
        put_bytes(path(), bytes);
    };
    put(with(40));
    expect_ignored("the checksum of its header is another");
    put(with(100));
    expect_ignored("the checksum of its table is another");
    put(with(whole.size() / 2));
    expect_ignored("the checksum of its segment is another");
    put(whole.substr(0, whole.size() - 1));
    expect_ignored("bytes of");
    put("");
    expect_ignored("it has only 0 bytes");
    put(with(8));
    expect_ignored("version");
    put("not a snapshot" + std::string(100, ' '));
    expect_ignored("no snapshot");
}

TEST_F(SnapshotFollow, AFileOfAnotherIndexIsIgnored) {
    add(1, 5);
    start();
    save();
    expect_ignored("60 coefficients a channel, not 40", 40);
}

// Another one in the same place, with as many changes.
TEST_F(SnapshotFollow, AFileOfAnotherDatabaseIsIgnored) {
    add(1, 5);
    start();
    const std::int64_t sequence = save();
    follower_.reset();
    for (const char* suffix : {"", "-wal", "-shm"})
        std::filesystem::remove(collection_.path() + suffix);
    add(51, 5);
    ASSERT_EQ(beside(collection_)->images().last_sequence().value(), sequence);
    expect_ignored("does not know the snapshot");
}

// The trap: the older copy reaches the same numbers with other pictures.
TEST_F(SnapshotFollow, AFileOfBeforeAnOlderCopyWasPutBackIsIgnored) {
    add(1, 3);
    start();
    save();
    follower_.reset();
    sql("PRAGMA wal_checkpoint(TRUNCATE)");
    const std::string copy = bytes_in(collection_.path());
    const std::string at_copy = bytes_in(path());

    add(4, 3);
    start();
    const std::int64_t later = save();
    follower_.reset();
    sql("PRAGMA wal_checkpoint(TRUNCATE)");
    put_bytes(collection_.path(), copy);
    add(40, 5);
    ASSERT_GE(beside(collection_)->images().last_sequence().value(), later);
    expect_ignored("does not know the snapshot");
    EXPECT_EQ(matches().size(), 8U);

    // That of the copy's own time is as good as it was.
    follower_.reset();
    put_bytes(path(), at_copy);
    start();
    EXPECT_TRUE(follower_->began_with());
    EXPECT_EQ(matches().size(), 8U);
}

TEST_F(SnapshotFollow, AFileThatIsAheadIsIgnored) {
    add(1, 5);
    start();
    save();
    follower_.reset();
    sql("DELETE FROM images WHERE id = 5; DELETE FROM changes WHERE seq >= 5");
    expect_ignored("the snapshot is ahead: it holds change 5, the database's last is 4");
}

TEST_F(SnapshotFollow, AFileThatIsFarBehindIsIgnored) {
    add(1, 5);
    start();
    save();
    follower_.reset();
    sql("UPDATE sqlite_sequence SET seq = 30000 WHERE name = 'changes'");
    add(6, 1);
    expect_ignored("29996 changes old");
}

TEST_F(SnapshotFollow, WhereThereIsNoneTheDatabaseIsReadWithoutComplaint) {
    add(1, 2);
    const LogWatch none("event=no_snapshot");
    const LogWatch ignored("event=snapshot_ignored");
    start();
    EXPECT_EQ(none.lines().size(), 1U);
    EXPECT_TRUE(ignored.lines().empty());
    EXPECT_EQ(matches().size(), 2U);
}

// A database that cannot be asked is no reason to ignore the file.
TEST_F(SnapshotFollow, WaitsForADatabaseThatFailsAndThenUsesTheFile) {
    add(1, 3);
    start();
    save();
    follower_.reset();
    sql("ALTER TABLE snapshots RENAME TO elsewhere");
    FollowerOptions options;
    options.database_path = collection_.path();
    options.index = {60, 4};
    options.poll_interval = std::chrono::milliseconds(1);
    options.snapshot_path = path();
    const LogWatch failed("event=follow_failed");
    follower_ = IndexFollower::start(options).value();
    EXPECT_TRUE(becomes_true([&] { return failed.lines().size() == 1; }));
    EXPECT_FALSE(follower_->ready());
    EXPECT_FALSE(follower_->state());
    sql("ALTER TABLE elsewhere RENAME TO snapshots");
    EXPECT_TRUE(becomes_true([&] { return follower_->ready(); }));
    EXPECT_TRUE(follower_->began_with());
    EXPECT_EQ(matches().size(), 3U);
}

TEST_F(SnapshotFollow, SearchesGoOnWhenTheFileIsDeletedOrReplaced) {
    add(1, 6);
    start();
    save();
    start();
    ASSERT_TRUE(follower_->began_with());
    const auto before = matches();
    std::filesystem::remove(path());
    EXPECT_EQ(matches(), before);
    save();
    EXPECT_EQ(matches(), before);
    // Its segments are merged with new ones.
    add(7, 40);
    EXPECT_TRUE(becomes_true([&] { return matches().size() == 46; }));
    EXPECT_TRUE(becomes_true([&] {
        const image::IndexStats stats = follower_->snapshot()->stats();
        return stats.segments + stats.tail < 10;
    }));
    EXPECT_EQ(matches().size(), 46U);
}

}  // namespace
}  // namespace haarmony::server
