#include "server/app/duplicate_groups.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/schema/pictures.h"
#include "tests/server/app/collection.h"

namespace haarmony::server {
namespace {

using image::DuplicateLevel;
using Ids = std::vector<ImageId>;

class DuplicateGroupsTest : public testing::Test {
  protected:
    DuplicateGroupsTest()
        : other_(beside(collection_)),
          groups_(DuplicateGroups::open(collection_.path()).value()) {}

    // A picture whose file has that content.
    ImageId add(const std::string& content) {
        schema::NewImage row = schema::file_picture(++count_);
        row.stamp.content_hash = content;
        return other_->images().add(row).value();
    }
    void find(const std::vector<schema::DuplicatePair>& pairs) {
        schema::DuplicateStore& store = other_->duplicates();
        const std::int64_t generation = store.begin_generation().value();
        ASSERT_TRUE(store.add(generation, pairs));
        ASSERT_TRUE(store.publish(generation));
    }
    std::vector<Ids> listed(const DuplicateQuery& query = {}) {
        std::vector<Ids> ids;
        const auto page = groups_->list(query);
        EXPECT_TRUE(page);
        for (const FoundGroup& found : page->groups) ids.push_back(found.group.ids);
        return ids;
    }

    Collection collection_;
    std::unique_ptr<Connection> other_;
    std::unique_ptr<DuplicateGroups> groups_;
    int count_ = 0;
};

TEST_F(DuplicateGroupsTest, EqualFilesAreThereBeforeAnySearch) {
    const ImageId a = add("x");
    add("y");
    const ImageId c = add("x");
    const ImageId d = add("x");
    const auto page = groups_->list({});
    ASSERT_TRUE(page);
    ASSERT_EQ(page->groups.size(), 1);
    const FoundGroup& found = page->groups.front();
    EXPECT_EQ(found.group.ids, (Ids{a, c, d}));
    EXPECT_EQ(found.group.level, DuplicateLevel::kExact);
    EXPECT_EQ(found.group.similarity, 1.0);
    ASSERT_EQ(found.images.size(), 3);
    EXPECT_EQ(found.images[1].id, c);
    EXPECT_FALSE(page->more);
}

TEST_F(DuplicateGroupsTest, FoundPairsAndEqualFilesMeetInOneGroup) {
    const ImageId a = add("x");
    const ImageId b = add("x");
    const ImageId c = add("y");
    const ImageId d = add("z");
    find({{b, c, "near", 0.8}, {c, d, "similar", 0.5}});
    EXPECT_EQ(listed(), (std::vector<Ids>{{a, b, c, d}}));
    DuplicateQuery query;
    query.least.min_level = DuplicateLevel::kNear;
    EXPECT_EQ(listed(query), (std::vector<Ids>{{a, b, c}}));
    query.least.min_level = DuplicateLevel::kExact;
    EXPECT_EQ(listed(query), (std::vector<Ids>{{a, b}}));
    query.least = {0.9, DuplicateLevel::kSimilar};
    EXPECT_EQ(listed(query), (std::vector<Ids>{{a, b}}));
}

TEST_F(DuplicateGroupsTest, AnIgnoredPairHoldsNothingTogether) {
    const ImageId a = add("x");
    const ImageId b = add("x");
    ASSERT_TRUE(groups_->ignore(b, a));
    EXPECT_TRUE(listed().empty());
    // Each is still the same as a third one.
    const ImageId c = add("x");
    EXPECT_EQ(listed(), (std::vector<Ids>{{a, b, c}}));
    ASSERT_TRUE(groups_->ignore(a, c));
    EXPECT_EQ(listed(), (std::vector<Ids>{{b, c}}));
    const ImageId d = add("x");
    EXPECT_EQ(listed(), (std::vector<Ids>{{a, b, c, d}}));
    EXPECT_EQ(groups_->ignore(a, ImageId{99}).error().code, ErrorCode::kNotFound);
    EXPECT_EQ(groups_->ignore(a, a).error().code, ErrorCode::kInvalidArgument);
}

TEST_F(DuplicateGroupsTest, PagesFollowOneAnother) {
    std::vector<Ids> expected;
    for (int i = 0; i < 5; ++i) {
        const ImageId a = add("file " + std::to_string(i));
        expected.push_back({a, add("file " + std::to_string(i))});
    }
    std::vector<Ids> found;
    DuplicateQuery query;
    query.limit = 2;
    for (;;) {
        const auto page = groups_->list(query);
        ASSERT_TRUE(page);
        for (const FoundGroup& group : page->groups) found.push_back(group.group.ids);
        if (!page->more) break;
        query.after = found.back().front();
    }
    EXPECT_EQ(found, expected);
}

TEST_F(DuplicateGroupsTest, OfALargeGroupTheFirstPicturesAreDescribed) {
    const std::size_t count = DuplicateGroups::kMaxImages + 5;
    for (std::size_t i = 0; i < count; ++i) add("x");
    const auto page = groups_->list({});
    ASSERT_TRUE(page);
    ASSERT_EQ(page->groups.size(), 1);
    EXPECT_EQ(page->groups[0].group.ids.size(), count);
    EXPECT_EQ(page->groups[0].images.size(), DuplicateGroups::kMaxImages);
}

}  // namespace
}  // namespace haarmony::server
