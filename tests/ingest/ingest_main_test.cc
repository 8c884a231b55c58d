// What haarmony-ingest says and how it ends, as its callers see it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/ingest/ingest_fixture.h"

namespace haarmony::ingest {
namespace {

using Json = nlohmann::json;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class IngestMain : public IngestFixture {};

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

TEST_F(IngestMain, WrongUsageIsStatus2AndSaysNothingOnStdout) {
    const Finished finished = ingest({pictures_, "--jobs", "0"});
    EXPECT_EQ(finished.status, 2);
    EXPECT_THAT(finished.out, IsEmpty());
    EXPECT_THAT(finished.err, StartsWith("haarmony-ingest: "));
    EXPECT_THAT(finished.err, HasSubstr("--jobs"));
    EXPECT_FALSE(std::filesystem::exists(database_));
}

TEST_F(IngestMain, HelpIsStatus0OnStdoutAndOpensNothing) {
    const Finished finished = ingest({"--help"});
    EXPECT_EQ(finished.status, 0);
    EXPECT_THAT(finished.out, HasSubstr("--db"));
    EXPECT_THAT(finished.err, IsEmpty());
    EXPECT_FALSE(std::filesystem::exists(database_));
}

TEST_F(IngestMain, PathsMayLookLikeListsAndOptions) {
    const ChildOptions here{.working_folder = pictures_};
    folder_.write("pictures/[a,b]/1.jpg", jpeg_of(1, 32, 32));
    folder_.write("pictures/-x/2.jpg", jpeg_of(2, 32, 32));
    const Finished finished = ingest({"[a,b]", "--", "-x", "[c]"}, here);
    EXPECT_EQ(counts_of(finished.out),
              "seen=2 added=2 updated=0 skipped=0 failed=1 pruned=0")
        << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("failed: " + pictures_ + "/[c]: "));
    EXPECT_TRUE(rows().contains(pictures_ + "/[a,b]/1.jpg"));
    EXPECT_TRUE(rows().contains(pictures_ + "/-x/2.jpg"));
}

TEST_F(IngestMain, AFailedFileIsALineOnStderrAndStatus1AndTheRestIsStored) {
    folder_.write("pictures/good.jpg", jpeg_of(1, 64, 48));
    const std::string whole = jpeg_of(2, 64, 48);
    folder_.write("pictures/cut.jpg", whole.substr(0, whole.size() / 2));
    folder_.write("pictures/text.jpg", "just text");
    folder_.write("pictures/empty.jpg", "");
    folder_.write("pictures/notes.txt", "just text");
    for (const bool again : {false, true}) {
        const Finished finished =
            ingest({"--jobs", "1", "--progress", "none", pictures_});
        EXPECT_EQ(finished.status, 1);
        EXPECT_THAT(lines_of(finished.err),
                    testing::UnorderedElementsAre(
                        StartsWith("failed: " + pictures_ + "/cut.jpg: "),
                        StartsWith("failed: " + pictures_ + "/empty.jpg: "),
                        StartsWith("failed: " + pictures_ + "/text.jpg: ")));
        EXPECT_EQ(counts_of(finished.out),
                  again ? "seen=4 added=0 updated=0 skipped=1 failed=3 pruned=0"
                        : "seen=4 added=1 updated=0 skipped=0 failed=3 pruned=0");
        EXPECT_EQ(lines_of(finished.out).size(), 1u);
    }
    EXPECT_EQ(rows().at(pictures_ + "/good.jpg").width, 64);
    EXPECT_EQ(rows().at(pictures_ + "/good.jpg").media_type, "image/jpeg");
    EXPECT_EQ(rows().at(pictures_ + "/text.jpg").state, schema::ImageState::kFailed);
}

TEST_F(IngestMain, AMissingPathIsStatus1BesideOthersAndStatus3Alone) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const std::string missing = folder_ / "missing";
    const Finished beside = ingest({missing, pictures_});
    EXPECT_EQ(beside.status, 1);
    EXPECT_EQ(counts_of(beside.out),
              "seen=1 added=1 updated=0 skipped=0 failed=1 pruned=0");
    const Finished alone = ingest({missing});
    EXPECT_EQ(alone.status, 3);
    for (const Finished& finished : {beside, alone}) {
        EXPECT_THAT(lines_of(finished.err),
                    ElementsAre("failed: " + missing + ": No such file or directory"));
    }
    EXPECT_EQ(counts_of(alone.out),
              "seen=0 added=0 updated=0 skipped=0 failed=1 pruned=0");
}

TEST_F(IngestMain, AFileThatIsNoDatabaseIsStatus3AndStaysAsItIs) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const std::string content =
        "something precious, and longer than a database's header is";
    folder_.write("haarmony.db", content);
    const Finished finished = ingest({pictures_});
    EXPECT_EQ(finished.status, 3);
    EXPECT_THAT(finished.out, IsEmpty());
    EXPECT_THAT(finished.err, StartsWith("haarmony-ingest: "));
    EXPECT_THAT(finished.err, HasSubstr(database_));
    EXPECT_EQ(bytes_of(database_), content);
    EXPECT_FALSE(std::filesystem::exists(database_ + "-wal"));
}

TEST_F(IngestMain, ADatabaseThatCannotBeMadeIsStatus3) {
    const Finished finished = run_to_end(
        {HAARMONY_INGEST, "--db", folder_ / "no/such/folder.db", pictures_}, {});
    EXPECT_EQ(finished.status, 3);
    EXPECT_THAT(finished.err, HasSubstr("no/such/folder.db"));
}

TEST_F(IngestMain, JsonIsOneObjectALineWithFailuresAndTheCountsAtTheEnd) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const std::string bad = folder_.write("pictures/b\xff.jpg", "text");
    const Finished finished = ingest({"--progress", "json", pictures_});
    EXPECT_EQ(finished.status, 1);
    std::vector<Json> objects;
    for (const std::string& line : lines_of(finished.out)) {
        objects.push_back(Json::parse(line));
        ASSERT_TRUE(objects.back().is_object());
    }
    ASSERT_GE(objects.size(), 2u);
    const Json& done = objects.back();
    EXPECT_EQ(done["event"], "done");
    EXPECT_EQ(done["seen"], 2);
    EXPECT_EQ(done["added"], 1);
    EXPECT_EQ(done["updated"], 0);
    EXPECT_EQ(done["skipped"], 0);
    EXPECT_EQ(done["failed"], 1);
    EXPECT_EQ(done["pruned"], 0);
    EXPECT_GE(done["seconds"], 0);
    const Json& failed = objects[objects.size() - 2];
    EXPECT_EQ(failed["event"], "failed");
    EXPECT_THAT(failed["uri"], EndsWith("/pictures/b%FF.jpg"));
    EXPECT_THAT(finished.err, StartsWith("failed: " + bad + ": "));
}

TEST_F(IngestMain, ThereIsABarOnATerminalOnly) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const Finished on_terminal = ingest({pictures_}, {.terminal = true});
    EXPECT_EQ(on_terminal.status, 0);
    EXPECT_THAT(on_terminal.out, HasSubstr(" files, "));
    EXPECT_THAT(on_terminal.out, HasSubstr("\r\x1b[Kdone: seen=1 added=1 "));
    EXPECT_THAT(ingest({"--progress", "plain", pictures_}, {.terminal = true}).out,
                Not(HasSubstr("\x1b")));
    EXPECT_EQ(lines_of(ingest({pictures_}).out).size(), 1u);
}

TEST_F(IngestMain, AReaderThatGoesAwayDoesNotEndTheRun) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const Finished finished = ingest({pictures_}, {.closed_output = true});
    EXPECT_EQ(finished.status, 0);
    EXPECT_EQ(rows().size(), 1u);
}

TEST_F(IngestMain, ExcludeMayBeGivenSeveralTimes) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    folder_.write("pictures/b.jpg", jpeg_of(2, 32, 32));
    folder_.write("pictures/x/c.jpg", jpeg_of(3, 32, 32));
    const Finished finished =
        ingest({"--exclude", "b.*", "--exclude=x/", pictures_, "--progress=none"});
    EXPECT_EQ(counts_of(finished.out),
              "seen=1 added=1 updated=0 skipped=0 failed=0 pruned=0");
}

TEST_F(IngestMain, ALargerFileThanAllowedIsAFailure) {
    const std::string path = folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const Finished finished = ingest({"--max-file-bytes", "100", pictures_});
    EXPECT_EQ(finished.status, 1);
    EXPECT_THAT(finished.err, StartsWith("failed: " + path + ": "));
    EXPECT_THAT(finished.err, EndsWith(" bytes, more than the limit of 100\n"));
}

TEST_F(IngestMain, ADatabaseNamedAndPlacedLikeAPictureIsNoPicture) {
    folder_.write("pictures/a.jpg", jpeg_of(1, 32, 32));
    const std::string database = pictures_ + "/db.jpg";
    for (int i = 0; i < 2; ++i) {
        const Finished finished =
            run_to_end({HAARMONY_INGEST, "--db", database, pictures_}, {});
        EXPECT_EQ(finished.status, 0) << finished.err;
        EXPECT_THAT(counts_of(finished.out), StartsWith("seen=1 "));
    }
}

}  // namespace
}  // namespace haarmony::ingest
