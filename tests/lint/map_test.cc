// Documents that name files must name files that exist.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/lint/source_files.h"

namespace haarmony::lint {
namespace {

// Words in backquotes that look like a path of the project: a known top-level folder,
// a slash, no blanks and no wildcard. "x.{h,cc}" names two files.
std::set<std::string> paths_named_in(const std::string& text) {
    static const std::regex quoted("`([^`\\s*<>$]+)`");
    static const std::regex path(
        R"(^(engine|schema|ingest|server|web|tests|docker|script|cmake|\.ci)/[\w./{},-]+$)");
    static const std::regex braces(R"(^(.*)\{([\w.]+),([\w.]+)\}$)");
    std::set<std::string> paths;
    for (std::sregex_iterator it(text.begin(), text.end(), quoted), end; it != end;
         ++it) {
        const std::string word = (*it)[1];
        if (!std::regex_match(word, path)) continue;
        std::smatch parts;
        if (std::regex_match(word, parts, braces)) {
            paths.insert(parts[1].str() + parts[2].str());
            paths.insert(parts[1].str() + parts[3].str());
        } else {
            paths.insert(word);
        }
    }
    return paths;
}

TEST(Map, FindsPathsInBackquotes) {
    EXPECT_EQ(
        paths_named_in("`engine/image/haar.{h,cc}` and `script/test`, `a b/c`, `x/y`"),
        (std::set<std::string>{
            "engine/image/haar.cc", "engine/image/haar.h", "script/test"}));
}

TEST(Map, EveryPathInADocumentExists) {
    for (const char* document : {"engine/README.md",
                                 "README.md",
                                 "ARCHITECTURE.md",
                                 "CONTRIBUTING.md",
                                 "schema/README.md"}) {
        const std::string text = read_file(document);
        ASSERT_FALSE(text.empty()) << document;
        for (const std::string& path : paths_named_in(text)) {
            EXPECT_TRUE(std::filesystem::exists(project_root() / path))
                << document << " names " << path;
        }
    }
}

TEST(Map, EngineReadmeNamesEveryFileOfTheEngine) {
    const std::set<std::string> named = paths_named_in(read_file("engine/README.md"));
    ASSERT_FALSE(named.empty());
    for (const std::string& path : source_files({"engine"})) {
        EXPECT_TRUE(named.contains(path)) << path << " is not on the map";
    }
}

}  // namespace
}  // namespace haarmony::lint
