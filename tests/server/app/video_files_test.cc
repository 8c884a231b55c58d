#include "server/app/video_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/schema/scratch_folder.h"

namespace haarmony::server {
namespace {

namespace fs = std::filesystem;

class VideoFilesTest : public testing::Test {
  protected:
    VideoFilesTest() : files_(folder_.file("x.db")) {
        const auto prepared = files_.prepare();
        EXPECT_TRUE(prepared) << prepared.error().message;
    }
    [[nodiscard]] std::set<std::string> names() const {
        std::set<std::string> found;
        for (const auto& entry : fs::directory_iterator(files_.folder()))
            found.insert(entry.path().filename());
        return found;
    }
    [[nodiscard]] static schema::Video video(std::int64_t id,
                                             const std::string& revision) {
        schema::Video made;
        made.id = id;
        made.revision = revision;
        return made;
    }
    std::string input(const std::string& text) {
        const auto name = files_.take_input(std::as_bytes(std::span(text)));
        EXPECT_TRUE(name) << name.error().message;
        return name ? *name : "";
    }

    schema::ScratchFolder folder_;
    VideoFiles files_;
};

TEST_F(VideoFilesTest, InputsAreKeptUnderNamesOfTheirOwnUntilTheyAreRemoved) {
    const std::string one = input("one");
    // Another run of the daemon counts from 0 again.
    VideoFiles again(folder_.file("x.db"));
    const std::string text = "two";
    const auto two = again.take_input(std::as_bytes(std::span(text)));
    ASSERT_TRUE(two);
    EXPECT_NE(one, *two);
    EXPECT_TRUE(is_input_name(one));
    EXPECT_EQ(schema::read_bytes(files_.input_path(one)), "one");
    EXPECT_EQ(schema::read_bytes(files_.input_path(*two)), "two");
    files_.remove_input(one);
    files_.remove_input(one);
    EXPECT_EQ(names(), std::set<std::string>{*two});
}

TEST_F(VideoFilesTest, AClipGetsItsNameFromItsRow) {
    schema::write_bytes(files_.building_path(5), "clip");
    const schema::Video row = video(7, "00000000deadbeef");
    const auto published = files_.publish(files_.building_path(5), row);
    ASSERT_TRUE(published) << published.error().message;
    EXPECT_EQ(names(), std::set<std::string>{"7-00000000deadbeef.mrv"});
    EXPECT_EQ(schema::read_bytes(files_.clip_path(7, row.revision)), "clip");
    const auto gone = files_.publish(files_.building_path(5), video(8, "0"));
    ASSERT_FALSE(gone);
    files_.remove_clip(row);
    EXPECT_TRUE(names().empty());
}

TEST_F(VideoFilesTest, ASweepRemovesWhatBelongsToNobodyAndNothingElse) {
    const std::string wanted = input("wanted");
    const std::string orphan = input("orphan");
    schema::write_bytes(files_.clip_path(1, "00000000deadbeef"), "kept");
    schema::write_bytes(files_.clip_path(1, "00000000deadbeee"), "another revision");
    schema::write_bytes(files_.clip_path(2, "00000000deadbeef"), "no row");
    schema::write_bytes(files_.building_path(3), "half");
    schema::write_bytes(files_.folder() + "/spool-XuEHoP", "died as it was made");
    schema::write_bytes(files_.folder() + "/README", "somebody else's");
    const std::vector<schema::Video> rows{video(1, "00000000deadbeef")};
    const auto removed =
        files_.sweep(rows, [&](std::string_view name) { return name == wanted; });
    ASSERT_TRUE(removed) << removed.error().message;
    EXPECT_EQ(*removed, 5);
    EXPECT_EQ(names(),
              (std::set<std::string>{"README", "1-00000000deadbeef.mrv", wanted}));
}

TEST_F(VideoFilesTest, AFolderThatIsGoneIsAnErrorOfEveryStep) {
    fs::remove_all(files_.folder());
    const std::string text = "x";
    EXPECT_FALSE(files_.take_input(std::as_bytes(std::span(text))));
    EXPECT_FALSE(files_.sweep({}, [](std::string_view) { return true; }));
    EXPECT_FALSE(files_.publish(files_.building_path(1), video(1, "0")));
    EXPECT_FALSE(VideoFiles(folder_.file("none/x.db")).prepare());
}

TEST(InputName, IsNothingThatLeadsElsewhere) {
    EXPECT_TRUE(is_input_name("input-0"));
    for (const char* name :
         {"", "input-", "input-1/..", "../input-1", "input-x", "1-0.mrv", "INPUT-1"})
        EXPECT_FALSE(is_input_name(name)) << name;
}

}  // namespace
}  // namespace haarmony::server
