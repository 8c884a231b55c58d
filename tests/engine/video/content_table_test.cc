#include "engine/video/content_table.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace haarmony::video {
namespace {

// Contents are numbers; a table of them, and all that it was told, in a row.
class Contents {
  public:
    explicit Contents(std::uint64_t hashes) : hashes_(hashes) {}

    // The place of `content` of a kind, new or found.
    std::uint32_t find_or_make(std::uint64_t content, std::uint32_t kind) {
        const Ref ref = table.find_or_make(
            content % hashes_,
            kind,
            [&](Ref known) {
                ++compared;
                return contents[index_of(known)] == content;
            },
            [&] {
                contents.push_back(content);
                return make_ref(0, static_cast<std::uint32_t>(contents.size() - 1));
            });
        return index_of(ref);
    }

    ContentTable table;
    std::vector<std::uint64_t> contents;
    std::size_t compared = 0;

  private:
    std::uint64_t hashes_;
};

TEST(ContentTable, FindsWhatItHasAndNothingElse) {
    Contents contents(1U << 20);
    for (std::uint64_t i = 0; i < 3000; ++i) {
        EXPECT_EQ(contents.find_or_make(i * 7919, 0), i);
    }
    for (std::uint64_t i = 0; i < 3000; ++i) {
        EXPECT_EQ(contents.find_or_make(i * 7919, 0), i);
    }
    EXPECT_EQ(contents.table.size(), 3000U);
}

TEST(ContentTable, KindsAreApart) {
    Contents contents(1U << 20);
    EXPECT_EQ(contents.find_or_make(5, 0), 0U);
    EXPECT_EQ(contents.find_or_make(5, 1), 1U);
    EXPECT_EQ(contents.find_or_make(5, 0), 0U);
    EXPECT_EQ(contents.find_or_make(5, 1), 1U);
}

TEST(ContentTable, EqualHashesAreNotEqualContents) {
    Contents contents(1);
    for (std::uint64_t i = 0; i < 20; ++i) EXPECT_EQ(contents.find_or_make(i, 0), i);
    for (std::uint64_t i = 0; i < 20; ++i) EXPECT_EQ(contents.find_or_make(i, 0), i);
}

TEST(ContentTable, ContentsMadeToCollideCostNoMoreThanTheProbes) {
    Contents contents(1);
    for (std::uint64_t i = 0; i < 1000; ++i) (void)contents.find_or_make(i, 0);
    EXPECT_EQ(contents.table.size(), ContentTable::kMaxProbes);
    contents.compared = 0;
    EXPECT_EQ(contents.find_or_make(2000, 0), 1000U);
    EXPECT_EQ(contents.compared, ContentTable::kMaxProbes);
    // The first ones are still found.
    EXPECT_EQ(contents.find_or_make(3, 0), 3U);
}

TEST(ContentTable, ForgetsTheLastFirst) {
    // Against a plain list: at every step what is found, and what is made again.
    std::mt19937 random(5);
    Contents contents(40);  // many collisions, never more than the probes allow
    std::vector<std::uint64_t> known;
    std::vector<std::uint32_t> places;
    for (int round = 0; round < 2000; ++round) {
        if (random() % 8 == 0) {
            const std::size_t keep = known.empty() ? 0 : random() % (known.size() + 1);
            contents.table.shrink(keep);
            known.resize(keep);
            places.resize(keep);
            continue;
        }
        const std::uint64_t content = random() % 300;
        const auto found = std::find(known.begin(), known.end(), content);
        const std::uint32_t place = contents.find_or_make(content, 0);
        if (found != known.end()) {
            EXPECT_EQ(place, places[static_cast<std::size_t>(found - known.begin())]);
        } else {
            EXPECT_EQ(place, contents.contents.size() - 1);
            known.push_back(content);
            places.push_back(place);
        }
        ASSERT_EQ(contents.table.size(), known.size());
    }
}

TEST(ContentTable, WhatIsNotMadeIsNotRemembered) {
    ContentTable table;
    const auto never = [](Ref) { return true; };
    EXPECT_EQ(table.find_or_make(1, 0, never, [] { return kNoDetailRef; }), kNoDetailRef);
    EXPECT_EQ(table.size(), 0U);
    EXPECT_EQ(table.find_or_make(1, 0, never, [] { return make_ref(2, 3); }),
              make_ref(2, 3));
}

}  // namespace
}  // namespace haarmony::video
