#include "ingest/pipeline.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>

#include "ingest/file_uri.h"
#include "tests/ingest/memory_catalogue.h"
#include "tests/ingest/pretended_pictures.h"
#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

class PipelineTest : public testing::Test {
  protected:
    Report ingest() {
        if (options_.paths.empty()) options_.paths = {folder_.path()};
        return run(options_, catalogue_, pictures_.steps(), observer_, stop_);
    }
    MemoryCatalogue::Row row(std::string_view name) const {
        return catalogue_.rows().at(file_uri(folder_ / name));
    }

    const ScratchFolder folder_;
    MemoryCatalogue catalogue_;
    PretendedPictures pictures_;
    RecordingObserver observer_;
    PipelineOptions options_{.jobs = 3};
    std::atomic<bool> stop_ = false;
};

TEST_F(PipelineTest, RecordsEveryFileWithAllThatIsKnownOfIt) {
    const std::string path = folder_.write("a b.png", "content");
    const Report report = ingest();
    ASSERT_TRUE(report.outcome);
    EXPECT_EQ(report.tally, (Tally{.seen = 1, .added = 1}));
    EXPECT_EQ(report.paths_reached, 1u);
    const MemoryCatalogue::Row added = row("a b.png");
    EXPECT_EQ(added.image.origin, schema::ImageOrigin::kFile);
    EXPECT_EQ(added.image.uri, file_uri(path));
    EXPECT_EQ(added.image.width, 7);
    EXPECT_EQ(added.known.stamp.size, 7);
    EXPECT_EQ(added.known.stamp.mtime_ns, kLongAgoNs);
    EXPECT_EQ(added.known.stamp.content_hash, "content");
}

TEST_F(PipelineTest, EqualFilesAreTwoRows) {
    folder_.write("a.png", "same");
    folder_.write("b.png", "same");
    EXPECT_EQ(ingest().tally.added, 2);
    EXPECT_NE(row("a.png").known.id, row("b.png").known.id);
}

TEST_F(PipelineTest, ManyFilesAreEachDescribedOnceByAnyNumberOfWorkers) {
    constexpr int kFiles = 350;
    for (int i = 0; i < kFiles; ++i) {
        const std::string number = std::to_string(i);
        folder_.write(std::to_string(i % 7) + '/' + number + ".png",
                      (i % 10 == 0 ? "bad" : "") + number);
    }
    for (const int jobs : {1, 2, 8}) {
        MemoryCatalogue fresh;
        PretendedPictures pictures;
        RecordingObserver observer;
        options_.paths = {folder_.path()};
        options_.jobs = jobs;
        options_.file_bytes = 10;  // most workers wait for their share most of the time
        const Report report = run(options_, fresh, pictures.steps(), observer, stop_);
        ASSERT_TRUE(report.outcome);
        EXPECT_EQ(report.tally, (Tally{.seen = 350, .added = 315, .failed = 35}));
        EXPECT_EQ(pictures.described, kFiles);
        EXPECT_EQ(observer.failures.size(), 35u);
        EXPECT_EQ(fresh.rows().size(), static_cast<std::size_t>(kFiles));
        for (const int rows : fresh.operations_per_transaction) {
            EXPECT_LE(rows, static_cast<int>(kBatchRows));
        }
    }
}

TEST_F(PipelineTest, UnchangedFilesAreNotRead) {
    folder_.write("a.png", "a");
    folder_.write("b.png", "b");
    ASSERT_TRUE(ingest().outcome);
    const MemoryCatalogue::Rows before = catalogue_.rows();
    const std::size_t transactions = catalogue_.operations_per_transaction.size();
    pictures_.described = pictures_.hashed = 0;
    EXPECT_EQ(ingest().tally, (Tally{.seen = 2, .skipped = 2}));
    EXPECT_EQ(pictures_.described, 0);
    EXPECT_EQ(pictures_.hashed, 0);
    EXPECT_EQ(catalogue_.operations_per_transaction.size(), transactions);
}

TEST_F(PipelineTest, AChangeWithinTheSameClockTickIsSeen) {
    const std::int64_t now = std::chrono::duration_cast<std::chrono::nanoseconds>(
                                 std::chrono::system_clock::now().time_since_epoch())
                                 .count();
    folder_.write("a.png", "old", now);
    EXPECT_EQ(ingest().tally.added, 1);
    folder_.write("a.png", "new", now);  // same size, same time
    EXPECT_EQ(ingest().tally, (Tally{.seen = 1, .updated = 1}));
    EXPECT_EQ(row("a.png").known.stamp.content_hash, "new");
}

TEST_F(PipelineTest, AFreshFileIsComparedOnceMoreAndThenSettled) {
    folder_.write("a.png", "same");
    ASSERT_EQ(ingest().tally.added, 1);
    MemoryCatalogue::Row fresh = row("a.png");
    fresh.known.stamp.mtime_ns = kUnsettledMtime;
    catalogue_.put(file_uri(folder_ / "a.png"), fresh);
    EXPECT_EQ(ingest().tally, (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(row("a.png").known.stamp.mtime_ns, kLongAgoNs);
    EXPECT_EQ(pictures_.described, 1);
    EXPECT_EQ(catalogue_.touches, 1);
}

// The state machine of change detection, over every combination of what the database may
// know, what the file may be and what reading it may give.
enum class Known { kNone, kIndexed, kFailed, kDeleted };
enum class File { kUntouched, kTouched, kOtherContent, kOtherSize };
enum class Reads { kWell, kUndecodable, kTooLarge };

struct Combination {
    Known known;
    File file;
    Reads reads;
    bool restore;

    friend std::ostream& operator<<(std::ostream& out, const Combination& c) {
        return out << "known " << static_cast<int>(c.known) << " file "
                   << static_cast<int>(c.file) << " reads " << static_cast<int>(c.reads)
                   << " restore " << c.restore;
    }
};

struct Expected {
    std::optional<ImageState> state;
    Tally tally;
    bool described;
    bool keeps_old_stamp;
};

// The oracle: the contract's sentences in the order in which they overrule each other.
Expected expected_of(const Combination& c) {
    const Tally skipped{.seen = 1, .skipped = 1};
    const Tally failed{.seen = 1, .failed = 1};
    const bool settled =
        c.known == Known::kIndexed || (c.known == Known::kDeleted && !c.restore);
    const ImageState before =
        c.known == Known::kDeleted ? ImageState::kDeleted : ImageState::kIndexed;
    // "It skips files that are unchanged (size, mtime ..."
    if (settled && c.file == File::kUntouched) return {before, skipped, false, true};
    // A failure to read says nothing about the picture that is recorded.
    if (c.reads == Reads::kTooLarge) {
        const bool recorded = c.known == Known::kIndexed || c.known == Known::kDeleted;
        return {recorded ? before : ImageState::kFailed, failed, false, recorded};
    }
    // "... then content hash)"
    if (settled && c.file == File::kTouched) return {before, skipped, false, false};
    // "reports each failed file": a new one, a changed one, one that failed before.
    if (c.reads == Reads::kUndecodable) return {ImageState::kFailed, failed, true, false};
    if (c.known == Known::kNone) {
        return {ImageState::kIndexed, {.seen = 1, .added = 1}, true, false};
    }
    return {ImageState::kIndexed, {.seen = 1, .updated = 1}, true, false};
}

TEST_F(PipelineTest, EveryCombinationOfRowAndFileEndsAsTheContractSays) {
    int combinations = 0;
    for (const Known known :
         {Known::kNone, Known::kIndexed, Known::kFailed, Known::kDeleted})
        for (const File file :
             {File::kUntouched, File::kTouched, File::kOtherContent, File::kOtherSize})
            for (const Reads reads :
                 {Reads::kWell, Reads::kUndecodable, Reads::kTooLarge})
                for (const bool restore : {false, true}) {
                    const Combination c{known, file, reads, restore};
                    SCOPED_TRACE(c);
                    ++combinations;
                    MemoryCatalogue catalogue;
                    PretendedPictures pictures;
                    RecordingObserver observer;
                    const std::string now =
                        reads == Reads::kUndecodable ? "bad-new" : "new-new";
                    const std::string then = file == File::kOtherContent ? "an--old"
                                             : file == File::kOtherSize  ? "oldest"
                                                                         : now;
                    const std::string path = folder_.write("a.png", now);
                    const bool same_time = file == File::kUntouched;
                    constexpr ImageState kStates[] = {{},
                                                      ImageState::kIndexed,
                                                      ImageState::kFailed,
                                                      ImageState::kDeleted};
                    const schema::FileStamp stamp{static_cast<std::int64_t>(then.size()),
                                                  kLongAgoNs - (same_time ? 0 : 1),
                                                  then};
                    if (known != Known::kNone) {
                        catalogue.put(
                            file_uri(path),
                            {{ImageId{42}, kStates[static_cast<int>(known)], stamp},
                             {},
                             "old"});
                    }
                    options_.paths = {folder_.path()};
                    options_.restore = restore;
                    options_.max_file_bytes = reads == Reads::kTooLarge ? 1 : 1 << 20;
                    const Report report =
                        run(options_, catalogue, pictures.steps(), observer, stop_);

                    const Expected expected = expected_of(c);
                    ASSERT_TRUE(report.outcome);
                    EXPECT_EQ(report.tally, expected.tally);
                    EXPECT_EQ(pictures.described, expected.described ? 1 : 0);
                    EXPECT_EQ(observer.failures.size(),
                              static_cast<std::size_t>(expected.tally.failed));
                    const MemoryCatalogue::Rows rows = catalogue.rows();
                    ASSERT_EQ(rows.size(), 1u);
                    const MemoryCatalogue::Row& row = rows.begin()->second;
                    EXPECT_EQ(row.known.state, expected.state);
                    if (known != Known::kNone) {
                        EXPECT_EQ(row.known.id, ImageId{42});
                    }
                    EXPECT_EQ(row.known.stamp.mtime_ns,
                              expected.keeps_old_stamp ? stamp.mtime_ns : kLongAgoNs);
                    const bool bytes_known = reads != Reads::kTooLarge;
                    if (!expected.keeps_old_stamp) {
                        EXPECT_EQ(row.known.stamp.content_hash, bytes_known ? now : "");
                        EXPECT_EQ(row.known.stamp.size,
                                  static_cast<std::int64_t>(now.size()));
                    }
                }
    EXPECT_EQ(combinations, 4 * 4 * 3 * 2);
}

TEST_F(PipelineTest, FailuresNameThePathAndTheReasonEveryTime) {
    const std::string bad = folder_.write("bad.png", "bad bytes");
    for (int i = 0; i < 2; ++i) {
        observer_.failures.clear();
        EXPECT_EQ(ingest().tally, (Tally{.seen = 1, .failed = 1}));
        EXPECT_THAT(observer_.failures, ElementsAre(bad + ": damaged: bad bytes"));
        EXPECT_EQ(row("bad.png").failure, "damaged: bad bytes");
        EXPECT_EQ(row("bad.png").known.id, ImageId{1});
    }
    folder_.write("bad.png", "good");
    EXPECT_EQ(ingest().tally, (Tally{.seen = 1, .updated = 1}));
    EXPECT_EQ(row("bad.png").known.id, ImageId{1});
}

TEST_F(PipelineTest, AFailureWithoutAReasonIsGivenOne) {
    const std::string bad = folder_.write("bad.png", "bad and silent");
    ASSERT_TRUE(ingest().outcome);
    EXPECT_THAT(observer_.failures, ElementsAre(bad + ": cannot be decoded"));
    EXPECT_EQ(row("bad.png").failure, "cannot be decoded");
}

TEST_F(PipelineTest, APathThatIsMissingIsAFailureBesideTheOthers) {
    folder_.write("a.png", "a");
    options_.paths = {folder_ / "gone", folder_.path()};
    const Report report = ingest();
    EXPECT_EQ(report.tally, (Tally{.seen = 1, .added = 1, .failed = 1}));
    EXPECT_EQ(report.paths_reached, 1u);
    EXPECT_THAT(observer_.failures,
                ElementsAre(folder_ / "gone" + ": No such file or directory"));
}

TEST_F(PipelineTest, NoPathThatCanBeUsedIsNoneReached) {
    options_.paths = {folder_ / "gone"};
    EXPECT_EQ(ingest().paths_reached, 0u);
}

// While the one worker describes the first file, the second is found and waits.
TEST_F(PipelineTest, AFileThatVanishesOrChangesKindAfterItWasFoundIsPassedOver) {
    options_.jobs = 1;
    const std::string first = folder_.write("a.png", "first");
    const std::vector<std::function<void(const std::string&)>> replacements = {
        [](const std::string&) {},
        [](const std::string& path) { ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0); },
        [](const std::string& path) { std::filesystem::create_directory(path); },
        [](const std::string& path) { ASSERT_EQ(::symlink("nowhere", path.c_str()), 0); },
    };
    for (const auto& replacement : replacements) {
        MemoryCatalogue catalogue;
        const std::string second = folder_.write("b.png", "second");
        folder_.write("c.png", "third");
        pictures_.while_describing = [&](const std::string& content) {
            if (content != "first") return;
            catalogue.wait_for_lookups(3);
            std::filesystem::remove_all(second);
            replacement(second);
        };
        options_.paths = {folder_.path()};
        const Report report =
            run(options_, catalogue, pictures_.steps(), observer_, stop_);
        EXPECT_EQ(report.tally, (Tally{.seen = 2, .added = 2}));
        EXPECT_FALSE(catalogue.rows().contains(file_uri(second)));
        std::filesystem::remove_all(second);
    }
    EXPECT_THAT(observer_.failures, IsEmpty());
}

TEST_F(PipelineTest, ADeletionDuringTheRunIsRespected) {
    const std::string path = folder_.write("a.png", "a");
    catalogue_.before_transaction = [&] {
        catalogue_.put(
            file_uri(path),
            {{ImageId{7}, ImageState::kDeleted, {1, kLongAgoNs, "a"}}, {}, {}});
    };
    EXPECT_EQ(ingest().tally, (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(row("a.png").known.state, ImageState::kDeleted);
}

TEST_F(PipelineTest,
       AFailureOfAnyTransactionKeepsWhatWasCommittedAndTheNextRunDoesTheRest) {
    constexpr int kFiles = 2 * static_cast<int>(kBatchRows) + 8;
    for (int i = 0; i < kFiles; ++i) folder_.write(std::to_string(i) + ".png", "x");
    for (int failing = 1; failing <= 3; ++failing) {
        MemoryCatalogue catalogue;
        catalogue.failing_transaction = failing;
        options_.paths = {folder_.path()};
        const Report broken =
            run(options_, catalogue, pictures_.steps(), observer_, stop_);
        ASSERT_FALSE(broken.outcome);
        EXPECT_EQ(broken.outcome.error().message, "forced failure of a transaction");
        const auto committed = static_cast<std::int64_t>(catalogue.rows().size());
        EXPECT_EQ(broken.tally, (Tally{.seen = committed, .added = committed}));
        EXPECT_EQ(catalogue.operations_per_transaction.size(),
                  static_cast<std::size_t>(failing - 1));
        catalogue.failing_transaction = 0;
        const Report rest = run(options_, catalogue, pictures_.steps(), observer_, stop_);
        EXPECT_EQ(
            rest.tally,
            (Tally{.seen = kFiles, .added = kFiles - committed, .skipped = committed}));
    }
}

TEST_F(PipelineTest, AFailureOfAnyLookupEndsTheRunWithItsReason) {
    constexpr int kFiles = 5;
    for (int i = 0; i < kFiles; ++i) folder_.write(std::to_string(i) + ".png", "x");
    for (int failing = 1; failing <= kFiles; ++failing) {
        MemoryCatalogue catalogue;
        catalogue.failing_lookup = failing;
        options_.paths = {folder_.path()};
        const Report report =
            run(options_, catalogue, pictures_.steps(), observer_, stop_);
        ASSERT_FALSE(report.outcome);
        EXPECT_EQ(report.outcome.error().message, "forced failure of a lookup");
        EXPECT_EQ(report.tally.added, static_cast<std::int64_t>(catalogue.rows().size()));
    }
}

TEST_F(PipelineTest, StoppingCommitsWhatIsDescribedAndTakesNoMore) {
    constexpr int kFiles = 300;
    for (int i = 0; i < kFiles; ++i) folder_.write(std::to_string(i) + ".png", "x");
    constexpr int kEnough = 10;
    pictures_.while_describing = [&](const std::string&) {
        if (pictures_.described == kEnough) stop_ = true;
    };
    options_.prune = true;
    catalogue_.put(file_uri(folder_ / "gone.png"),
                   {{ImageId{1}, ImageState::kIndexed, {}}, {}, {}});
    const Report report = ingest();
    ASSERT_TRUE(report.outcome);
    EXPECT_TRUE(report.stopped);
    // Each worker may have been in the middle of one more.
    EXPECT_GE(report.tally.added, kEnough);
    EXPECT_LE(report.tally.added, kEnough + options_.jobs);
    EXPECT_EQ(catalogue_.rows().size(), static_cast<std::size_t>(report.tally.added) + 1);
    EXPECT_EQ(report.tally.pruned, 0);
}

TEST_F(PipelineTest, WhatFailsToDecodeWhileStoppingIsLeftForTheNextRun) {
    folder_.write("a.png", "bad");
    pictures_.while_describing = [this](const std::string&) { stop_ = true; };
    EXPECT_EQ(ingest().tally, Tally{});
    EXPECT_THAT(catalogue_.rows(), IsEmpty());
    EXPECT_THAT(observer_.failures, IsEmpty());
}

TEST_F(PipelineTest, TheObserverLearnsTheTotal) {
    for (int i = 0; i < 20; ++i) folder_.write(std::to_string(i) + ".png", "x");
    options_.count_ahead = true;
    options_.jobs = 1;
    // The last file is held up until the observer has heard of all of them.
    std::mutex mutex;
    std::condition_variable heard;
    bool knows_total = false;
    struct WaitingObserver final : Observer {
        std::function<void(std::int64_t)> on_total;
        void failed(const std::string&, const std::string&) override {}
        void progress(const Tally&, std::int64_t total) override { on_total(total); }
    } observer;
    observer.on_total = [&](std::int64_t total) {
        if (total != 20) return;
        const std::lock_guard lock(mutex);
        knows_total = true;
        heard.notify_all();
    };
    pictures_.while_describing = [&](const std::string&) {
        std::unique_lock lock(mutex);
        EXPECT_TRUE(
            heard.wait_for(lock, std::chrono::seconds(60), [&] { return knows_total; }));
    };
    options_.paths = {folder_.path()};
    EXPECT_EQ(run(options_, catalogue_, pictures_.steps(), observer, stop_).tally.added,
              20);
}

}  // namespace
}  // namespace haarmony::ingest
