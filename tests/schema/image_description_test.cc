#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ImageDescriptions : public testing::Test {
  protected:
    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
    ImageId upload_ = expect(store_.add(upload_picture(1)));
    ImageId file_ = expect(store_.add(file_picture(2)));
};

TEST_F(ImageDescriptions, WhatIsGivenIsReplacedAndTheRestStays) {
    const Image before = expect(store_.get(upload_));
    expect(store_.describe(upload_, {.uri = "new uri", .tags = {}, .metadata = {}}));
    Image now = expect(store_.get(upload_));
    EXPECT_EQ(now.uri, "new uri");
    EXPECT_EQ(now.tags, before.tags);
    EXPECT_EQ(now.metadata, before.metadata);
    EXPECT_EQ(now.revision, before.revision + 1);

    expect(store_.describe(
        upload_,
        {.uri = {}, .tags = std::vector<std::string>{"b", "all", "b"}, .metadata = {}}));
    now = expect(store_.get(upload_));
    EXPECT_THAT(now.tags, ElementsAre("all", "b"));
    EXPECT_EQ(now.uri, "new uri");

    expect(store_.describe(file_, {.uri = {}, .tags = {}, .metadata = R"({"a":1})"}));
    EXPECT_EQ(expect(store_.get(file_)).metadata, R"({"a":1})");
    expect(store_.describe(
        file_, {.uri = {}, .tags = std::vector<std::string>{}, .metadata = {}}));
    EXPECT_THAT(expect(store_.get(file_)).tags, IsEmpty());
    EXPECT_EQ(expect(store_.get(file_)).revision, 3);
}

TEST_F(ImageDescriptions, ANewOneIsFoundAtOnceAndIsNoChangeToFollow) {
    const auto sequence = expect(store_.changes_after(0, 10)).back().sequence;
    expect(store_.describe(upload_,
                           {.uri = "walrus.png",
                            .tags = std::vector<std::string>{"ice"},
                            .metadata = R"({"t":"polar"})"}));
    EXPECT_THAT(expect(store_.matching({.text = "walrus ice polar", .tags = {"ice"}})),
                ElementsAre(upload_));
    EXPECT_THAT(expect(store_.changes_after(sequence, 10)), IsEmpty());
}

TEST_F(ImageDescriptions, AFilesUriIsKeptAndNothingElseChanges) {
    const auto refused = store_.describe(
        file_, {.uri = "other", .tags = std::vector<std::string>{"x"}, .metadata = "{}"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kConflict);
    EXPECT_EQ(refused.error().param, "uri");
    EXPECT_NE(refused.error().message.find("\"other\""), std::string::npos);
    EXPECT_EQ(expect(store_.get(file_)).uri, file_picture(2).uri);
    EXPECT_EQ(expect(store_.get(file_)).metadata, file_picture(2).metadata);
    EXPECT_EQ(expect(store_.get(file_)).revision, 1);
}

TEST_F(ImageDescriptions, BadMetadataLeavesAllAsItWas) {
    const auto refused = store_.describe(
        upload_, {.uri = "x", .tags = std::vector<std::string>{"x"}, .metadata = "[]"});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(refused.error().message.find("metadata_is_a_json_object"),
              std::string::npos);
    EXPECT_EQ(expect(store_.get(upload_)).uri, upload_picture(1).uri);
    EXPECT_EQ(expect(store_.get(upload_)).revision, 1);
}

TEST_F(ImageDescriptions, OnlyWhatCanBeSeenIsDescribed) {
    expect(store_.remove(file_));
    for (const ImageId id : {file_, ImageId{99}}) {
        const auto refused =
            store_.describe(id, {.uri = {}, .tags = {}, .metadata = "{}"});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::kNotFound);
        EXPECT_EQ(refused.error().message, "no image " + std::to_string(to_int(id)));
    }
    // A failed one can be seen by its id.
    const ImageId failed = expect(store_.mark_failed("file:///f", {}, "cut"));
    expect(store_.describe(
        failed, {.uri = {}, .tags = std::vector<std::string>{"bad"}, .metadata = {}}));
    EXPECT_THAT(expect(store_.get(failed)).tags, ElementsAre("bad"));
    EXPECT_THAT(expect(store_.matching({.text = "bad", .tags = {}})), IsEmpty());
}

}  // namespace
}  // namespace haarmony::schema
