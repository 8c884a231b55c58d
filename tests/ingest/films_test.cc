// Films in a run of ingest: which rows they leave, and when.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "ingest/file_uri.h"
#include "ingest/film_rows.h"
#include "ingest/media_fragment.h"
#include "ingest/pipeline.h"
#include "tests/ingest/memory_catalogue.h"
#include "tests/ingest/pretended_films.h"
#include "tests/ingest/scratch_folder.h"

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using testing::ElementsAre;
using testing::IsEmpty;

class FilmsTest : public testing::Test {
  protected:
    FilmsTest() { options_.walk.films = true; }

    Tally ingest() {
        options_.paths = {folder_.path()};
        const Report report = run(options_, catalogue_, films_.steps(), observer_, stop_);
        EXPECT_TRUE(report.outcome);
        return report.tally;
    }
    // The ids of the film's rows by what is behind '#'.
    std::map<std::string, std::int64_t> ids(const std::string& name) const {
        const std::string film = file_uri(folder_ / name);
        std::map<std::string, std::int64_t> ids;
        for (const auto& [uri, row] : catalogue_.rows())
            if (without_fragment(uri) == film)
                ids[uri.substr(film.size())] = to_int(row.known.id);
        return ids;
    }
    MemoryCatalogue::Row row(const std::string& name) const {
        return catalogue_.rows().at(file_uri(folder_ / "") + name);
    }
    // As a picture that was deleted through the interface.
    void remove(const std::string& name) {
        MemoryCatalogue::Row gone = row(name);
        gone.known.state = ImageState::kDeleted;
        catalogue_.put(file_uri(folder_ / "") + name, gone);
    }
    void change(const std::string& name, const std::string& times) {
        folder_.write(name, film_of(times), kLongAgoNs + ++changes_);
    }

    const ScratchFolder folder_;
    MemoryCatalogue catalogue_;
    PretendedFilms films_;
    RecordingObserver observer_;
    PipelineOptions options_{.jobs = 2};
    std::atomic<bool> stop_ = false;
    std::int64_t changes_ = 0;
};

TEST_F(FilmsTest, EveryKeyFrameIsARowThatTellsWhereItIs) {
    const std::string path = folder_.write("a b.mkv", film_of("0 2000 4171"));
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 3}));
    const MemoryCatalogue::Row added = row("a%20b.mkv#t=4.171");
    EXPECT_EQ(added.image.origin, schema::ImageOrigin::kFile);
    EXPECT_EQ(added.image.media_type, "video/x-flv");
    EXPECT_EQ(added.image.metadata,
              R"({"video":")" + file_uri(path) + R"(","time":4.171,"frame":104})");
    EXPECT_EQ(added.known.stamp.size,
              static_cast<std::int64_t>(film_of("0 2000 4171").size()));
    EXPECT_EQ(added.known.stamp.mtime_ns, kLongAgoNs);
    std::set<std::string> hashes;
    for (const auto& [uri, row] : catalogue_.rows())
        hashes.insert(row.known.stamp.content_hash);
    EXPECT_EQ(hashes.size(), 3u) << "no two frames are the same file";
}

TEST_F(FilmsTest, WithoutTheOptionTheyAreNoCandidates) {
    folder_.write("a.mkv", film_of("0"));
    options_.walk.films = false;
    EXPECT_EQ(ingest(), Tally{});
    EXPECT_EQ(films_.described, 0);
}

TEST_F(FilmsTest, PicturesBesideThemAreAsEver) {
    folder_.write("a.png", "picture");
    folder_.write("b.mkv", film_of("0 40"));
    folder_.write("no film.mkv", "bad");
    EXPECT_EQ(ingest(), (Tally{.seen = 3, .added = 3, .failed = 1}));
    EXPECT_EQ(row("a.png").image.signature.size(), 7u);
    EXPECT_THAT(observer_.failures,
                ElementsAre(folder_ / "no film.mkv" + ": damaged: bad"));
}

TEST_F(FilmsTest, AnUnchangedOneIsNotRead) {
    folder_.write("a.mkv", film_of("0 2000"));
    ingest();
    films_.described = films_.hashed = 0;
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(films_.hashed, 0);
}

TEST_F(FilmsTest, OneThatIsOnlyNewerIsComparedAndNotDecoded) {
    const std::string path = folder_.write("a.mkv", film_of("0 2000"));
    ingest();
    ScratchFolder::set_mtime(path, kLongAgoNs + 5);
    films_.described = 0;
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(films_.described, 0);
    EXPECT_EQ(row("a.mkv#t=2.000").known.stamp.mtime_ns, kLongAgoNs + 5);
    films_.hashed = 0;
    ingest();
    EXPECT_EQ(films_.hashed, 0) << "the new time is recorded";
}

TEST_F(FilmsTest, AChangedOneKeepsTheIdsOfTheTimesItStillHas) {
    folder_.write("a.mkv", film_of("0 2000 4000"));
    ingest();
    const auto before = ids("a.mkv");
    change("a.mkv", "0 2500 4000 6000");
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 2, .updated = 2, .pruned = 1}));
    const auto now = ids("a.mkv");
    EXPECT_EQ(now.size(), 4u);
    EXPECT_EQ(now.at("#t=0.000"), before.at("#t=0.000"));
    EXPECT_EQ(now.at("#t=4.000"), before.at("#t=4.000"));
    EXPECT_FALSE(now.contains("#t=2.000"));
}

TEST_F(FilmsTest, WhatWasDeletedStaysDeletedUntilTheFilmChangesOrIsRestored) {
    const std::string path = folder_.write("a.mkv", film_of("0 2000"));
    ingest();
    remove("a.mkv#t=2.000");
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .skipped = 1}));
    ScratchFolder::set_mtime(path, kLongAgoNs + 5);
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(row("a.mkv#t=2.000").known.state, ImageState::kDeleted);
    options_.restore = true;
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .updated = 1}));
    EXPECT_EQ(row("a.mkv#t=2.000").known.state, ImageState::kIndexed);
    options_.restore = false;
    remove("a.mkv#t=2.000");
    change("a.mkv", "0 2000 9000");
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 1, .updated = 2}));
    EXPECT_EQ(row("a.mkv#t=2.000").known.state, ImageState::kIndexed);
}

TEST_F(FilmsTest, ADamagedOneKeepsItsIdsAsFailedRowsAndIsTriedAgain) {
    folder_.write("a.mkv", film_of("0 2000"));
    ingest();
    const auto before = ids("a.mkv");
    change("a.mkv", "0 2000 nonsense");
    for (int run = 0; run < 2; ++run) {
        EXPECT_EQ(ingest(), (Tally{.seen = 1, .failed = 1}));
        EXPECT_EQ(ids("a.mkv"), before);
        EXPECT_EQ(row("a.mkv#t=2.000").known.state, ImageState::kFailed);
        EXPECT_EQ(row("a.mkv#t=2.000").failure, "damaged: nonsense");
    }
    EXPECT_THAT(observer_.failures,
                ElementsAre(folder_ / "a.mkv" + ": damaged: nonsense",
                            folder_ / "a.mkv" + ": damaged: nonsense"));
    change("a.mkv", "0 2000");
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .updated = 2}));
    EXPECT_EQ(ids("a.mkv"), before);
}

TEST_F(FilmsTest, OneThatNeverWasReadableHasARowUntilItIs) {
    folder_.write("a.mkv", film_of("nonsense"));
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .failed = 1}));
    EXPECT_EQ(row("a.mkv").known.state, ImageState::kFailed);
    change("a.mkv", "0");
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 1}));
    EXPECT_EQ(ids("a.mkv").size(), 1u);
    EXPECT_TRUE(ids("a.mkv").contains("#t=0.000"));
}

TEST_F(FilmsTest, WhatIsNotTheFilmsFaultLeavesItsRowsAlone) {
    folder_.write("a.mkv", film_of("0 2000"));
    ingest();
    const auto before = catalogue_.rows();
    for (const char* trouble : {"no child", "unreadable"}) {
        change("a.mkv", trouble);
        EXPECT_EQ(ingest(), (Tally{.seen = 1, .failed = 1})) << trouble;
        EXPECT_EQ(ids("a.mkv").size(), before.size());
        EXPECT_EQ(row("a.mkv#t=0.000").known.state, ImageState::kIndexed) << trouble;
    }
    folder_.write("new.mkv", film_of("unreadable"));
    ingest();
    EXPECT_EQ(row("new.mkv").known.state, ImageState::kFailed);
    EXPECT_EQ(row("new.mkv").failure, "forced failure of reading");
}

TEST_F(FilmsTest, OneThatChangesWhileItIsReadIsLeftForTheNextRun) {
    const std::string path = folder_.write("a.mkv", film_of("0"));
    films_.while_describing = [&](const std::string&) { change("a.mkv", "0 2000"); };
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .failed = 1}));
    EXPECT_THAT(observer_.failures, ElementsAre(path + ": changes while it is read"));
    films_.while_describing = [](const std::string&) {};
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 2}));
}

TEST_F(FilmsTest, AFilmIsOneTransactionOrNothing) {
    std::string times;
    constexpr int kFrames = static_cast<int>(kBatchRows) + 20;
    for (int i = 0; i < kFrames; ++i) times += std::to_string(i) + ' ';
    folder_.write("a.mkv", film_of(times));
    catalogue_.failing_transaction = 1;
    options_.paths = {folder_.path()};
    EXPECT_FALSE(run(options_, catalogue_, films_.steps(), observer_, stop_).outcome);
    EXPECT_THAT(catalogue_.rows(), IsEmpty());
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = kFrames}));
    EXPECT_THAT(catalogue_.operations_per_transaction, ElementsAre(kFrames));
}

TEST_F(FilmsTest, WhenTheRunIsStoppedAFilmThatIsBeingReadIsNotRecorded) {
    folder_.write("a.mkv", film_of("0 2000"));
    films_.while_describing = [&](const std::string&) { stop_ = true; };
    EXPECT_EQ(ingest(), Tally{});
    EXPECT_THAT(catalogue_.rows(), IsEmpty());
    EXPECT_THAT(observer_.failures, IsEmpty());
}

TEST_F(FilmsTest, AFilmAndAPictureMayTakeEachOthersPlace) {
    folder_.write("a.png", "picture");
    ingest();
    change("a.png", "0 2000");
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 2}));
    EXPECT_EQ(ids("a.png").size(), 2u);
    folder_.write("a.png", "picture again", kLongAgoNs + 100);
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .added = 1}));
    EXPECT_EQ(ids("a.png").size(), 1u);
    EXPECT_TRUE(ids("a.png").contains(""));
}

TEST_F(FilmsTest, PruningDropsAllRowsOfAFilmThatIsGoneAndNoneOfOneThatIsThere) {
    const std::string gone = folder_.write("gone.mkv", film_of("0 2000"));
    folder_.write("stays.mkv", film_of("0 2000"));
    ingest();
    std::filesystem::remove(gone);
    options_.prune = true;
    EXPECT_EQ(ingest(), (Tally{.seen = 1, .skipped = 1, .pruned = 2}));
    EXPECT_THAT(ids("gone.mkv"), IsEmpty());
    EXPECT_EQ(ids("stays.mkv").size(), 2u);
}

TEST_F(FilmsTest, ALookupThatFailsEndsTheRun) {
    folder_.write("a.mkv", film_of("0"));
    catalogue_.failing_key_frame_lookup = 1;
    options_.paths = {folder_.path()};
    const Report report = run(options_, catalogue_, films_.steps(), observer_, stop_);
    ASSERT_FALSE(report.outcome);
    EXPECT_EQ(report.outcome.error().message, "forced failure of a lookup of key frames");
}

// Another process wrote the rows while this one read the film.
TEST_F(FilmsTest, SettlesByTheRowsAtTheTimeOfWriting) {
    const std::string path = folder_.write("a.mkv", film_of("0 2000"));
    ingest();
    const MemoryCatalogue::Rows rows = catalogue_.rows();
    const schema::FileStamp film{9, 9, film_of("0 2000")};
    const auto tally = write_film(catalogue_, file_uri(path), SameContent{film}, false);
    ASSERT_TRUE(tally);
    EXPECT_EQ(*tally, (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(row("a.mkv#t=0.000").known.stamp.mtime_ns, 9);
    remove("a.mkv#t=0.000");
    const auto other = write_film(
        catalogue_, file_uri(path), SameContent{{8, 8, "another content"}}, false);
    ASSERT_TRUE(other);
    EXPECT_EQ(*other, (Tally{.seen = 1, .skipped = 1}));
    EXPECT_EQ(row("a.mkv#t=0.000").known.stamp.mtime_ns, 9)
        << "not the film that was read";
    const auto sound = write_film(
        catalogue_, file_uri(path), Undecodable{film, "out of memory, perhaps"}, false);
    ASSERT_TRUE(sound);
    EXPECT_EQ(*sound, (Tally{.seen = 1, .skipped = 1})) << "it was decoded before";
    EXPECT_EQ(row("a.mkv#t=2.000").known.state, ImageState::kIndexed);
}

}  // namespace
}  // namespace haarmony::ingest
