#include "ingest/gallery/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace haarmony::gallery {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;

class CommandLine : public testing::Test {
  protected:
    CommandLine() {
        std::string pattern = (fs::temp_directory_path() / "gallery-XXXXXX").string();
        root_ = ::mkdtemp(pattern.data());
    }
    ~CommandLine() override { fs::remove_all(root_); }

    int call(const std::vector<std::string>& arguments) {
        out_.str("");
        err_.str("");
        return run(arguments, out_, err_);
    }

    fs::path root_;
    std::ostringstream out_;
    std::ostringstream err_;
};

TEST_F(CommandLine, SaysInOneLineWhatItWrote) {
    const std::string folder = (root_ / "new").string();
    const std::vector<std::string> arguments{
        "--out", folder, "--count", "2", "--jobs", "1", "--side", "40"};
    EXPECT_EQ(call(arguments), 0);
    EXPECT_EQ(out_.str(), "wrote 2 pictures to " + folder + "\n");
    EXPECT_THAT(err_.str(), IsEmpty());
    EXPECT_EQ(call(arguments), 0);
    EXPECT_EQ(out_.str(), "wrote 0 pictures to " + folder + " (2 were there already)\n");
}

TEST_F(CommandLine, AnotherSeedMakesOtherFiles) {
    const std::string folder = (root_ / "seeds").string();
    EXPECT_EQ(call({"--out",
                    folder,
                    "--side",
                    "40",
                    "--count",
                    "1",
                    "--seed",
                    "18446744073709551615"}),
              0);
    EXPECT_EQ(call({"--out", folder, "--side", "40", "--count", "1", "--seed", "2"}), 0);
    EXPECT_EQ(out_.str(), "wrote 1 pictures to " + folder + "\n");
}

TEST_F(CommandLine, HelpIsNoError) {
    EXPECT_EQ(call({"--help"}), 0);
    EXPECT_THAT(out_.str(), HasSubstr("--count"));
    EXPECT_THAT(err_.str(), IsEmpty());
}

TEST_F(CommandLine, BadValuesAreNamedWithExitCodeTwo) {
    const std::string folder = (root_ / "never").string();
    const std::vector<std::vector<std::string>> bad = {
        {"--out", folder, "--count", "0"},
        {"--out", folder, "--count", "-7"},
        {"--out", folder, "--count", "100001"},
        {"--out", folder, "--count", "many"},
        {"--out", folder, "--jobs", "0"},
        {"--out", folder, "--jobs", "257"},
        {"--out", folder, "--side", "15"},
        {"--out", folder, "--side", "4097"},
        {"--out", folder, "--side", "wide"},
        {"--out", folder, "--seed", "-1"},
        {"--out", folder, "--seed", "red"},
        {"--out", folder, "surplus"},
        {"--out", folder, "--shape"},
    };
    for (const auto& arguments : bad) {
        SCOPED_TRACE(arguments[arguments.size() - 2] + " " + arguments.back());
        EXPECT_EQ(call(arguments), 2) << arguments.back();
        EXPECT_THAT(err_.str(), HasSubstr(arguments.back()));
        EXPECT_THAT(out_.str(), IsEmpty());
        EXPECT_FALSE(fs::exists(folder)) << arguments.back();
    }
}

TEST_F(CommandLine, TheFolderMustBeNamed) {
    EXPECT_EQ(call({"--count", "3"}), 2);
    EXPECT_THAT(err_.str(), HasSubstr("--out"));
    EXPECT_EQ(call({"--out", ""}), 2);
    EXPECT_THAT(err_.str(), HasSubstr("--out"));
}

TEST_F(CommandLine, AFolderThatCannotBeMadeIsExitCodeThree) {
    std::ofstream(root_ / "file") << "in the way";
    const std::string folder = (root_ / "file" / "gallery").string();
    EXPECT_EQ(call({"--out", folder, "--count", "1", "--side", "40"}), 3);
    EXPECT_THAT(err_.str(), HasSubstr(folder));
    const std::string said = err_.str();
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
    EXPECT_THAT(out_.str(), IsEmpty());
}

}  // namespace
}  // namespace haarmony::gallery
