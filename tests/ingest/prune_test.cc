#include "ingest/prune.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/fsuid.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "ingest/file_uri.h"
#include "ingest/pipeline.h"
#include "tests/ingest/memory_catalogue.h"
#include "tests/ingest/pretended_pictures.h"
#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using testing::UnorderedElementsAre;

class PruneTest : public testing::Test {
  protected:
    void put(const std::string& path, ImageState state = ImageState::kIndexed) {
        catalogue_.put(file_uri(path), {{ImageId{++last_id_}, state, {}}, {}, {}});
    }
    Report ingest(const std::vector<std::string>& paths,
                  const std::vector<std::string>& exclude = {}) {
        PipelineOptions options{.paths = paths, .prune = true};
        for (const std::string& glob : exclude) options.walk.exclude.emplace_back(glob);
        return run(options, catalogue_, pictures_.steps(), observer_, stop_);
    }
    std::vector<std::string> paths_left() const {
        std::vector<std::string> paths;
        for (const auto& [uri, row] : catalogue_.rows()) {
            paths.push_back(*path_from_file_uri(uri));
        }
        return paths;
    }

    const ScratchFolder folder_;
    MemoryCatalogue catalogue_;
    PretendedPictures pictures_;
    RecordingObserver observer_;
    std::atomic<bool> stop_ = false;
    std::int64_t last_id_ = 0;
};

TEST_F(PruneTest, DropsRowsOfFilesThatAreGoneInEveryState) {
    const std::string kept = folder_.write("a/kept.png", "x");
    put(folder_ / "a/1.png");
    put(folder_ / "a/2.png", ImageState::kFailed);
    put(folder_ / "a/3.png", ImageState::kDeleted);
    put(folder_ / "no/such/folder.png");
    put(kept + "/below_a_file.png");
    EXPECT_EQ(ingest({folder_.path()}).tally,
              (Tally{.seen = 1, .added = 1, .pruned = 5}));
    EXPECT_THAT(paths_left(), UnorderedElementsAre(kept));
}

TEST_F(PruneTest, TouchesOnlyRowsBelowTheGivenPaths) {
    folder_.make_folder("a");
    put(folder_ / "a/1.png");
    put(folder_ / "ab/2.png");
    put(folder_ / "a.png");
    put(folder_ / "3.png");
    EXPECT_EQ(ingest({folder_ / "a"}).tally.pruned, 1);
    EXPECT_THAT(
        paths_left(),
        UnorderedElementsAre(folder_ / "ab/2.png", folder_ / "a.png", folder_ / "3.png"));
}

TEST_F(PruneTest, APathThatIsMissingItselfIsNotPruned) {
    put(folder_ / "disk/1.png");
    const Report report = ingest({folder_ / "disk"});
    EXPECT_EQ(report.tally, (Tally{.failed = 1}));
    EXPECT_THAT(paths_left(), UnorderedElementsAre(folder_ / "disk/1.png"));
}

TEST_F(PruneTest, WithoutTheOptionNothingGoes) {
    put(folder_ / "1.png");
    PipelineOptions options{.paths = {folder_.path()}};
    EXPECT_EQ(run(options, catalogue_, pictures_.steps(), observer_, stop_).tally.pruned,
              0);
    EXPECT_EQ(catalogue_.rows().size(), 1u);
}

TEST_F(PruneTest, WhatExistsStaysThoughItIsExcludedOrNoCandidate) {
    const std::string excluded = folder_.write("cache/a.png", "x");
    const std::string text = folder_.write("notes.txt", "text");
    put(excluded);
    put(text);
    EXPECT_EQ(ingest({folder_.path()}, {"cache"}).tally.pruned, 0);
    EXPECT_THAT(paths_left(), UnorderedElementsAre(excluded, text));
}

TEST_F(PruneTest, WhatIsNoRegularFileAnyMoreIsGone) {
    folder_.make_folder("folder.png");
    ASSERT_EQ(::mkfifo((folder_ / "fifo.png").c_str(), 0600), 0);
    put(folder_ / "folder.png");
    put(folder_ / "fifo.png");
    EXPECT_EQ(ingest({folder_.path()}).tally.pruned, 2);
}

TEST_F(PruneTest, WhatCannotBeLookedAtStays) {
    const std::string closed = folder_.make_folder("closed");
    ASSERT_EQ(::chmod(folder_.path().c_str(), 0755), 0);
    ASSERT_EQ(::chmod(closed.c_str(), 0), 0);
    put(closed + "/perhaps.png");
    // Root sees everything: look with another user's eyes.
    const int before = ::setfsuid(65534);
    const Pruned pruned = prune_below(catalogue_, folder_.path(), [] { return true; });
    ::setfsuid(static_cast<uid_t>(before));
    ASSERT_EQ(::chmod(closed.c_str(), 0700), 0);
    ASSERT_TRUE(pruned.outcome);
    EXPECT_EQ(pruned.rows, 0);
    EXPECT_EQ(catalogue_.rows().size(), 1u);
}

TEST_F(PruneTest, GoesInBatchesAndAFailureKeepsTheEarlierOnes) {
    const int batch = static_cast<int>(kBatchRows);
    for (int i = 0; i < 2 * batch + 3; ++i) put(folder_ / std::to_string(i));
    catalogue_.failing_transaction = 2;
    const Report broken = ingest({folder_.path()});
    ASSERT_FALSE(broken.outcome);
    EXPECT_EQ(broken.tally.pruned, batch);
    EXPECT_EQ(catalogue_.rows().size(), kBatchRows + 3);
    const Report rest = ingest({folder_.path()});
    ASSERT_TRUE(rest.outcome);
    EXPECT_EQ(rest.tally.pruned, batch + 3);
}

TEST_F(PruneTest, ReachesRowsBelowTheRootOfTheFileSystem) {
    put("/no/such/file.png");
    const Pruned pruned = prune_below(catalogue_, "/", [] { return true; });
    EXPECT_EQ(pruned.rows, 1);
}

}  // namespace
}  // namespace haarmony::ingest
