#include "ingest/glob.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>

namespace haarmony::ingest {
namespace {

// The oracle: the definition, by backtracking, for patterns without sets and escapes.
bool matches_by_definition(std::string_view pattern,
                           std::string_view text,
                           bool at_start) {
    if (pattern.empty()) return text.empty();
    if (at_start && pattern.starts_with("**/")) {
        if (matches_by_definition(pattern.substr(3), text, true)) return true;
        const std::size_t slash = text.find('/');
        return slash != std::string_view::npos &&
               matches_by_definition(pattern, text.substr(slash + 1), true);
    }
    if (pattern[0] == '*') {
        const bool across = pattern.starts_with("**");
        const std::string_view rest = pattern.substr(across ? 2 : 1);
        for (std::size_t taken = 0;; ++taken) {
            if (matches_by_definition(rest, text.substr(taken), false)) return true;
            if (taken == text.size() || (text[taken] == '/' && !across)) return false;
        }
    }
    if (text.empty()) return false;
    if (pattern[0] == '?' ? text[0] == '/' : text[0] != pattern[0]) return false;
    return matches_by_definition(pattern.substr(1), text.substr(1), pattern[0] == '/');
}

TEST(Glob, AgreesWithTheDefinition) {
    std::mt19937 random(11);
    const auto draw = [&random](std::string_view alphabet, int longest) {
        std::string text;
        for (int n = std::uniform_int_distribution<int>(0, longest)(random); n > 0; --n) {
            text += alphabet[random() % alphabet.size()];
        }
        return text;
    };
    int matching = 0;
    for (int i = 0; i < 60'000; ++i) {
        std::string pattern = draw("ab/**?", 7);
        // Three stars in a row have no defined meaning.
        if (pattern.find("***") != std::string::npos) continue;
        const std::string text = draw("ab/", 8);
        const bool expected = matches_by_definition(pattern, text, true);
        matching += expected;
        ASSERT_EQ(glob_matches(pattern, text), expected) << pattern << " on " << text;
    }
    EXPECT_GT(matching, 1000);
}

TEST(Glob, SetsTakeOneByteOfThem) {
    EXPECT_TRUE(glob_matches("IMG_[0-9].jpg", "IMG_7.jpg"));
    EXPECT_FALSE(glob_matches("IMG_[0-9].jpg", "IMG_x.jpg"));
    EXPECT_TRUE(glob_matches("[!a-c]", "d"));
    EXPECT_FALSE(glob_matches("[!a-c]", "b"));
    EXPECT_FALSE(glob_matches("[!a-c]", "/"));
    EXPECT_TRUE(glob_matches("[]x]", "]"));
    EXPECT_TRUE(glob_matches("[a-]", "-"));
    EXPECT_TRUE(glob_matches("[\x80-\xff]", "\xe9"));
}

TEST(Glob, UnclosedBracketAndEscapedStarStandForThemselves) {
    EXPECT_TRUE(glob_matches("a[b", "a[b"));
    EXPECT_TRUE(glob_matches("a[", "a["));
    EXPECT_TRUE(glob_matches("a\\*", "a*"));
    EXPECT_FALSE(glob_matches("a\\*", "ab"));
    EXPECT_TRUE(glob_matches("a\\", "a\\"));
}

TEST(Glob, ManyStarsAreNotSlow) {
    // A backtracking matcher would need more steps than there is time.
    std::string pattern;
    for (int i = 0; i < 60; ++i) pattern += "*a";
    EXPECT_FALSE(glob_matches(pattern + "b", std::string(4000, 'a')));
}

TEST(Exclusion, WithoutSlashMeansTheNameAnywhere) {
    const Exclusion exclusion("*.tmp.png");
    EXPECT_TRUE(exclusion.matches("a.tmp.png", false));
    EXPECT_TRUE(exclusion.matches("x/y/a.tmp.png", false));
    EXPECT_FALSE(exclusion.matches("x.tmp.png/a.png", false));
}

TEST(Exclusion, WithSlashMeansThePathBelowTheRoot) {
    EXPECT_TRUE(Exclusion("drafts/*.png").matches("drafts/a.png", false));
    EXPECT_FALSE(Exclusion("drafts/*.png").matches("x/drafts/a.png", false));
    EXPECT_TRUE(Exclusion("**/drafts").matches("x/y/drafts", true));
    EXPECT_TRUE(Exclusion("/a.png").matches("a.png", false));
    EXPECT_FALSE(Exclusion("/a.png").matches("x/a.png", false));
}

TEST(Exclusion, FinalSlashWantsAFolder) {
    EXPECT_TRUE(Exclusion("cache/").matches("x/cache", true));
    EXPECT_FALSE(Exclusion("cache/").matches("x/cache", false));
}

}  // namespace
}  // namespace haarmony::ingest
