#include "ingest/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace haarmony::ingest {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Arguments = std::vector<std::string>;

TEST(CommandLine, EveryOptionIsUnderstood) {
    const auto line = parse_command_line({"--db",
                                          "a.db",
                                          "x",
                                          "--jobs",
                                          "7",
                                          "--prune",
                                          "--restore",
                                          "--exclude",
                                          "*.a",
                                          "--exclude=b/",
                                          "--progress",
                                          "json",
                                          "--max-file-bytes",
                                          "5000000000",
                                          "y"});
    ASSERT_TRUE(line) << line.error().message;
    EXPECT_EQ(line->database, "a.db");
    EXPECT_THAT(line->pipeline.paths, ElementsAre("x", "y"));
    EXPECT_EQ(line->pipeline.jobs, 7);
    EXPECT_TRUE(line->pipeline.prune);
    EXPECT_TRUE(line->pipeline.restore);
    ASSERT_EQ(line->pipeline.walk.exclude.size(), 2u);
    EXPECT_TRUE(line->pipeline.walk.exclude[0].matches("c.a", false));
    EXPECT_TRUE(line->pipeline.walk.exclude[1].matches("b", true));
    EXPECT_EQ(line->progress, ProgressMode::kJson);
    EXPECT_EQ(line->pipeline.max_file_bytes, 5'000'000'000);
    EXPECT_THAT(line->answer, IsEmpty());
}

TEST(CommandLine, DefaultsAreSafe) {
    const auto line = parse_command_line({"--db", "a.db", "x"});
    ASSERT_TRUE(line);
    EXPECT_GE(line->pipeline.jobs, 1);
    EXPECT_FALSE(line->pipeline.prune);
    EXPECT_FALSE(line->pipeline.restore);
    EXPECT_THAT(line->pipeline.walk.exclude, IsEmpty());
    EXPECT_EQ(line->progress, std::nullopt);
}

TEST(CommandLine, ProgressHasItsFourNames) {
    const std::pair<const char*, std::optional<ProgressMode>> names[] = {
        {"auto", std::nullopt},
        {"plain", ProgressMode::kPlain},
        {"none", ProgressMode::kNone},
        {"json", ProgressMode::kJson}};
    for (const auto& [name, mode] : names) {
        const auto line = parse_command_line({"--db", "d", "x", "--progress", name});
        ASSERT_TRUE(line) << name;
        EXPECT_EQ(line->progress, mode) << name;
    }
}

TEST(CommandLine, WhatIsWrongIsNamed) {
    const std::pair<Arguments, const char*> cases[] = {
        {{"--db", "d"}, "PATH"},
        {{"x"}, "--db"},
        {{"--db", "", "x"}, "--db"},
        {{"--db", "d", "--db", "e", "x"}, "--db"},
        {{"--db", "d", ""}, "PATH"},
        {{"--db", "d", "x", "--jobs", "0"}, "--jobs"},
        {{"--db", "d", "x", "--jobs", "many"}, "many"},
        {{"--db", "d", "x", "--jobs", "1000000"}, "1000000"},
        {{"--db", "d", "x", "--max-file-bytes", "0"}, "--max-file-bytes"},
        {{"--db", "d", "x", "--progress", "loud"}, "loud"},
        {{"--db", "d", "x", "--exclude", ""}, "--exclude"},
        {{"--db", "d", "x", "--exclude"}, "--exclude"},
        {{"--db", "d", "x", "--unheard-of"}, "--unheard-of"}};
    for (const auto& [arguments, named] : cases) {
        const auto line = parse_command_line(arguments);
        ASSERT_FALSE(line) << testing::PrintToString(arguments);
        EXPECT_EQ(line.error().code, ErrorCode::kInvalidArgument);
        EXPECT_THAT(line.error().message, HasSubstr(named));
    }
}

TEST(CommandLine, FilmsAreLookedForWhenAskedForAndHaveALimit) {
    const auto without = parse_command_line({"--db", "d", "x"});
    ASSERT_TRUE(without);
    EXPECT_FALSE(without->pipeline.walk.films);
    EXPECT_EQ(without->most_key_frames, kMostKeyFrames);
    const auto with =
        parse_command_line({"--db", "d", "--videos", "--max-key-frames", "7", "x"});
    ASSERT_TRUE(with) << with.error().message;
    EXPECT_TRUE(with->pipeline.walk.films);
    EXPECT_EQ(with->most_key_frames, 7u);
    const auto none = parse_command_line({"--db", "d", "--max-key-frames", "0", "x"});
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("--max-key-frames"));
}

TEST(CommandLine, WhatIsNotBuiltYetDoesNotExist) {
    for (const char* option :
         {"--urls", "--watch", "--import-iqdb", "--export", "--import"}) {
        const auto line = parse_command_line({"--db", "d", "x", option, "y"});
        ASSERT_FALSE(line) << option;
        EXPECT_THAT(line.error().message, HasSubstr(option));
    }
}

TEST(CommandLine, PathsAndPatternsMayLookLikeListsAndOptions) {
    const auto line = parse_command_line({"--db",
                                          "d",
                                          "[a,b]",
                                          "--exclude",
                                          "[xy]",
                                          "{}",
                                          "--",
                                          "-x",
                                          "--exclude",
                                          "[c,d]"});
    ASSERT_TRUE(line) << line.error().message;
    EXPECT_THAT(line->pipeline.paths,
                ElementsAre("./[a,b]", "{}", "-x", "--exclude", "./[c,d]"));
    ASSERT_EQ(line->pipeline.walk.exclude.size(), 1u);
    EXPECT_TRUE(line->pipeline.walk.exclude[0].matches("y", false));
}

TEST(CommandLine, HelpNamesEveryOptionAndStatus) {
    const auto line = parse_command_line({"--help"});
    ASSERT_TRUE(line);
    for (const char* text : {"PATH",
                             "--db",
                             "--jobs",
                             "--prune",
                             "--restore",
                             "--exclude",
                             "--progress",
                             "--max-file-bytes",
                             "--version",
                             "Exit status",
                             "130"}) {
        EXPECT_THAT(line->answer, HasSubstr(text));
    }
}

TEST(CommandLine, VersionIsNameAndNumber) {
    const auto line = parse_command_line({"--version"});
    ASSERT_TRUE(line);
    EXPECT_THAT(line->answer,
                ContainsRegex("^haarmony-ingest [0-9]+\\.[0-9]+\\.[0-9]+\n$"));
}

}  // namespace
}  // namespace haarmony::ingest
