#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class ImageReads : public testing::Test {
  protected:
    [[nodiscard]] ImageId add_tagged(int number, std::vector<std::string> tags) {
        NewImage image = file_picture(number);
        image.tags = std::move(tags);
        return expect(store_.add(image));
    }
    [[nodiscard]] ImageId add_uri(const std::string& uri) {
        NewImage image = file_picture(++number_);
        image.uri = uri;
        return expect(store_.add(image));
    }
    [[nodiscard]] std::vector<ImageId> listed(ListOptions options) {
        std::vector<ImageId> ids;
        for (const Image& image : expect(store_.list(options))) ids.push_back(image.id);
        return ids;
    }
    [[nodiscard]] std::vector<std::string> below(const std::string& prefix) {
        std::vector<std::string> uris;
        expect(store_.for_each_file(
            prefix,
            [&](const KnownFile&, const std::string& uri) { uris.push_back(uri); }));
        return uris;
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
    int number_ = 0;
};

TEST_F(ImageReads, GetManyKeepsTheOrderAndLeavesOutWhatCannotBeSeen) {
    const ImageId a = expect(store_.add(file_picture(1)));
    const ImageId b = expect(store_.add(file_picture(2)));
    const ImageId untagged = add_tagged(3, {});
    const ImageId failed = expect(store_.mark_failed("file:///f", {}, "cut"));
    const ImageId deleted = expect(store_.add(file_picture(4)));
    expect(store_.remove(deleted));

    const std::vector<ImageId> wanted = {
        untagged, b, ImageId{999}, failed, a, deleted, b, ImageId{-5}};
    const auto images = expect(store_.get_many(wanted));
    std::vector<ImageId> ids;
    for (const Image& image : images) ids.push_back(image.id);
    EXPECT_THAT(ids, ElementsAre(untagged, b, a, b));
    for (const Image& image : images) {
        const Image alone = expect(store_.get(image.id));
        EXPECT_EQ(image.tags, alone.tags);
        EXPECT_EQ(image.uri, alone.uri);
        EXPECT_EQ(image.metadata, alone.metadata);
    }
    EXPECT_THAT(expect(store_.get_many({})), IsEmpty());
}

TEST_F(ImageReads, GetManyIsOneStatementForAnyNumberOfIds) {
    std::vector<ImageId> ids;
    for (int i = 0; i < 50; ++i) ids.push_back(expect(store_.add(file_picture(i))));
    int statements = 0;
    sqlite3_trace_v2(
        database_.handle(),
        SQLITE_TRACE_STMT,
        [](unsigned, void* count, void*, void* sql) {
            // A line of a trigger or a view starts with "--".
            if (*static_cast<const char*>(sql) != '-') ++*static_cast<int*>(count);
            return 0;
        },
        &statements);
    EXPECT_EQ(expect(store_.get_many(ids)).size(), ids.size());
    EXPECT_EQ(statements, 1);
}

TEST_F(ImageReads, AFailedPictureIsSeenOnlyByItsId) {
    const ImageId id = expect(store_.mark_failed("file:///f", {}, "cut"));
    EXPECT_EQ(expect(store_.get(id)).failure, "cut");
    EXPECT_THAT(listed({}), IsEmpty());
    EXPECT_THAT(expect(store_.get_many(std::vector{id})), IsEmpty());
}

TEST_F(ImageReads, ListGoesThroughAllPagesWithoutGapOrRepetition) {
    std::vector<ImageId> all;
    for (int i = 0; i < 23; ++i) all.push_back(expect(store_.add(file_picture(i))));
    std::vector<ImageId> seen;
    ListOptions page{.limit = 5, .after = std::nullopt, .tags = {}};
    for (auto ids = listed(page); !ids.empty(); ids = listed(page)) {
        EXPECT_LE(ids.size(), 5u);
        seen.insert(seen.end(), ids.begin(), ids.end());
        page.after = ids.back();
    }
    EXPECT_EQ(seen, all);
}

TEST_F(ImageReads, ListByTagsWantsAllOfThemAsWholeWords) {
    const ImageId ab = add_tagged(1, {"a", "b"});
    const ImageId abc = add_tagged(2, {"c", "a", "b"});
    const ImageId a = add_tagged(3, {"a", "ab", "B"});
    const auto with = [&](std::vector<std::string> tags, int limit = 100) {
        return listed({.limit = limit, .after = std::nullopt, .tags = std::move(tags)});
    };
    EXPECT_THAT(with({"a"}), ElementsAre(ab, abc, a));
    EXPECT_THAT(with({"b", "a"}), ElementsAre(ab, abc));
    EXPECT_THAT(with({"a", "b", "a", "b"}), ElementsAre(ab, abc));
    EXPECT_THAT(with({"a", "b", "c"}), ElementsAre(abc));
    EXPECT_THAT(with({"a"}, 2), ElementsAre(ab, abc));
    EXPECT_THAT(with({"b", "absent"}), IsEmpty());
    EXPECT_THAT(with({"%"}), IsEmpty());
    EXPECT_THAT(listed({.limit = 9, .after = ab, .tags = {"a"}}), ElementsAre(abc, a));
    // The whole row comes, not only the tags that were asked for.
    EXPECT_THAT(
        expect(store_.list({.limit = 1, .after = ab, .tags = {"c"}})).front().tags,
        ElementsAre("a", "b", "c"));
    expect(store_.remove(abc));
    EXPECT_THAT(with({"a", "b"}), ElementsAre(ab));
}

TEST_F(ImageReads, AsManyTagsAsAllowedWorkAndOneMoreIsNamed) {
    std::vector<std::string> tags;
    for (std::size_t i = 0; i < kMaxListTags; ++i)
        tags.push_back("t" + std::to_string(i));
    const ImageId id = add_tagged(1, tags);
    EXPECT_THAT(listed({.limit = 5, .after = std::nullopt, .tags = tags}),
                ElementsAre(id));
    tags.emplace_back("more");
    const auto refused = store_.list({.limit = 5, .after = std::nullopt, .tags = tags});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(refused.error().param, "tags");
    EXPECT_NE(refused.error().message.find(std::to_string(tags.size())),
              std::string::npos);
}

TEST_F(ImageReads, ARareTagIsFoundThroughItsIndexAndNotByReadingEveryPicture) {
    expect(store_.transaction([&]() -> Result<void> {
        for (int i = 0; i < 2000; ++i) static_cast<void>(add_tagged(i, {"all"}));
        return {};
    }));
    const ImageId rare = add_tagged(5000, {"all", "rare"});
    sqlite3_stmt* statement = nullptr;
    EXPECT_THAT(listed({.limit = 5, .after = std::nullopt, .tags = {"rare", "all"}}),
                ElementsAre(rare));
    // The steps of SQLite's machine that the statement took, full scans among them.
    int scanned = 0;
    while ((statement = sqlite3_next_stmt(database_.handle(), statement)) != nullptr) {
        if (std::string_view(sqlite3_sql(statement)).find("leading") !=
            std::string_view::npos) {
            scanned = sqlite3_stmt_status(statement, SQLITE_STMTSTATUS_VM_STEP, 0);
        }
    }
    EXPECT_GT(scanned, 0);
    EXPECT_LT(scanned, 1000);
}

TEST_F(ImageReads, PrefixesAreRangesAndNotPatterns) {
    for (const std::string uri : {"file:///a%20b/1.jpg",
                                  "file:///a_b/2.jpg",
                                  "file:///aXb/3.jpg",
                                  "file:///a/4.jpg",
                                  "file:///a/b/5.jpg",
                                  "file:///A/6.jpg",
                                  "file:///a",
                                  "file:///a0/7.jpg"}) {
        static_cast<void>(add_uri(uri));
    }
    EXPECT_THAT(below("file:///a_b/"), ElementsAre("file:///a_b/2.jpg"));
    EXPECT_THAT(below("file:///a%20"), ElementsAre("file:///a%20b/1.jpg"));
    EXPECT_THAT(below("file:///a%"), ElementsAre("file:///a%20b/1.jpg"));
    EXPECT_THAT(below("file:///a/"), ElementsAre("file:///a/4.jpg", "file:///a/b/5.jpg"));
    EXPECT_EQ(below("").size(), 8u);
    EXPECT_THAT(below("file:///b"), IsEmpty());
}

TEST_F(ImageReads, APrefixAtTheEndOfTheByteRangeStillHasAnEnd) {
    const std::string last = "file:///\x7f\xff\xff";
    static_cast<void>(add_uri(last));
    static_cast<void>(add_uri("\xff\xff"));
    static_cast<void>(add_uri("file:///\x80"));
    EXPECT_THAT(below("file:///\x7f\xff"), ElementsAre(last));
    EXPECT_THAT(below("\xff"), ElementsAre("\xff\xff"));
    EXPECT_THAT(below("file:///\x7f"), ElementsAre(last));
}

TEST_F(ImageReads, ForEachFileShowsEveryStateAndNoUploads) {
    const ImageId indexed = expect(store_.add(file_picture(1)));
    const ImageId deleted = expect(store_.add(file_picture(2)));
    expect(store_.remove(deleted));
    const ImageId failed =
        expect(store_.mark_failed("file:///photos/3", {3, 4, "h"}, "cut"));
    NewImage upload = upload_picture(1);
    upload.uri = "file:///photos/upload.jpg";
    expect(store_.add(upload));
    std::vector<std::pair<ImageId, ImageState>> seen;
    expect(store_.for_each_file("file:///photos/",
                                [&](const KnownFile& file, const std::string& uri) {
                                    seen.emplace_back(file.id, file.state);
                                    const auto known = expect(store_.known_file(uri));
                                    ASSERT_TRUE(known.has_value());
                                    EXPECT_EQ(known->id, file.id);
                                    EXPECT_EQ(known->stamp.size, file.stamp.size);
                                }));
    EXPECT_THAT(seen,
                ElementsAre(std::pair(indexed, ImageState::kIndexed),
                            std::pair(deleted, ImageState::kDeleted),
                            std::pair(failed, ImageState::kFailed)));
    EXPECT_FALSE(expect(store_.known_file("file:///photos/upload.jpg")).has_value());
}

TEST_F(ImageReads, AVisitorThatThrowsLeavesTheStoreUsable) {
    expect(store_.add(file_picture(1)));
    expect(store_.add(file_picture(2)));
    EXPECT_THROW(static_cast<void>(store_.for_each_file(
                     "", [](const KnownFile&, const std::string&) { throw 1; })),
                 int);
    EXPECT_THROW(static_cast<void>(
                     store_.for_each_searchable([](const SearchableImage&) { throw 1; })),
                 int);
    EXPECT_TRUE(store_.add(file_picture(3)));
    EXPECT_EQ(below("").size(), 3u);
}

TEST_F(ImageReads, UnknownIdsAreNamed) {
    EXPECT_EQ(store_.get(ImageId{5}).error().message, "no image 5");
    EXPECT_EQ(store_.signature(ImageId{6}).error().message, "no image 6");
    EXPECT_EQ(store_.thumbnail(ImageId{7}).error().message, "no thumbnail of image 7");
}

}  // namespace
}  // namespace haarmony::schema
