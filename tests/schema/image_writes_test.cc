#include <gtest/gtest.h>
#include <sqlite3.h>

#include <regex>

#include "schema/image_store.h"
#include "tests/schema/pictures.h"
#include "tests/schema/raw_sql.h"
#include "tests/schema/scratch_folder.h"

namespace haarmony::schema {
namespace {

class ImageWrites : public testing::Test {
  protected:
    [[nodiscard]] sqlite3* handle() const { return database_.handle(); }
    void expect_not_found(const Result<void>& result, std::int64_t id) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kNotFound);
        EXPECT_EQ(result.error().message, "no image " + std::to_string(id));
    }

    ScratchFolder folder_;
    Database database_ = open_database(folder_.file("x.db"));
    ImageStore store_{database_};
};

TEST_F(ImageWrites, AnAddedPictureComesBackWhole) {
    NewImage want = file_picture(3);
    want.tags = {"zebra", "\xc3\xa9t\xc3\xa9", "a,b \"c\"", "zebra", ""};
    const ImageId id = expect(store_.add(want));
    const Image image = expect(store_.get(id));
    EXPECT_EQ(image.id, id);
    EXPECT_EQ(image.state, ImageState::kIndexed);
    EXPECT_EQ(image.origin, ImageOrigin::kFile);
    EXPECT_EQ(image.uri, want.uri);
    EXPECT_EQ(image.stamp.size, want.stamp.size);
    EXPECT_EQ(image.stamp.mtime_ns, want.stamp.mtime_ns);
    EXPECT_EQ(image.stamp.content_hash, want.stamp.content_hash);
    EXPECT_EQ(image.width, want.width);
    EXPECT_EQ(image.height, want.height);
    EXPECT_EQ(image.media_type, want.media_type);
    EXPECT_EQ(image.metadata, want.metadata);
    EXPECT_TRUE(image.low_information);
    EXPECT_EQ(image.failure, "");
    EXPECT_EQ(image.revision, 1);
    EXPECT_EQ(image.added_at, image.updated_at);
    const std::regex rfc3339(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)");
    EXPECT_TRUE(std::regex_match(image.added_at, rfc3339)) << image.added_at;
    EXPECT_EQ(image.tags,
              (std::vector<std::string>{"", "a,b \"c\"", "zebra", "\xc3\xa9t\xc3\xa9"}));
    EXPECT_EQ(expect(store_.signature(id)), want.signature);
    EXPECT_EQ(expect(store_.thumbnail(id)).media_type, want.thumbnail.media_type);
    EXPECT_EQ(expect(store_.thumbnail(id)).bytes, want.thumbnail.bytes);
}

TEST_F(ImageWrites, AddingIsAlwaysANewRowForUploads) {
    const ImageId first = expect(store_.add(upload_picture(1)));
    const ImageId second = expect(store_.add(upload_picture(1)));
    EXPECT_NE(first, second);
    EXPECT_EQ(expect(store_.get(first)).origin, ImageOrigin::kUpload);
}

TEST_F(ImageWrites, AFileUriIsOneRow) {
    expect(store_.add(file_picture(1)));
    const auto again = store_.add(file_picture(1));
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::kConflict);
    EXPECT_NE(again.error().message.find(file_picture(1).uri), std::string::npos)
        << again.error().message;
    // An upload may claim the same uri.
    NewImage upload = file_picture(1);
    upload.origin = ImageOrigin::kUpload;
    EXPECT_TRUE(store_.add(upload));
}

TEST_F(ImageWrites, IdsAreNeverReused) {
    const ImageId first = expect(store_.add(upload_picture(1)));
    const ImageId second = expect(store_.add(file_picture(2)));
    expect(store_.remove(first));
    expect(store_.purge(second));
    EXPECT_GT(to_int(expect(store_.add(file_picture(2)))), to_int(second));
}

struct BadValue {
    const char* constraint;
    void (*spoil)(NewImage&);
};

class ImageBadValues : public ImageWrites,
                       public testing::WithParamInterface<BadValue> {};

TEST_P(ImageBadValues, AreRefusedByNameAndLeaveNothing) {
    NewImage image = file_picture(1);
    GetParam().spoil(image);
    const auto result = store_.add(image);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(result.error().message.find(GetParam().constraint), std::string::npos)
        << result.error().message;
    EXPECT_NE(result.error().message.find(image.uri), std::string::npos);
    for (const std::string table : {"images", "thumbnails", "image_tags", "changes"}) {
        EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM " + table), 0) << table;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Each,
    ImageBadValues,
    testing::Values(
        BadValue{"signature_is_not_empty", [](NewImage& i) { i.signature.clear(); }},
        BadValue{"metadata_is_a_json_object", [](NewImage& i) { i.metadata = "{"; }},
        BadValue{"metadata_is_a_json_object", [](NewImage& i) { i.metadata = "[1]"; }},
        BadValue{"size_is_not_negative", [](NewImage& i) { i.stamp.size = -1; }},
        BadValue{"width_is_a_count", [](NewImage& i) { i.width = -1; }},
        BadValue{"height_is_a_count", [](NewImage& i) { i.height = -1; }},
        BadValue{"thumbnail_has_a_type",
                 [](NewImage& i) { i.thumbnail.media_type.clear(); }}));

TEST_F(ImageWrites, AFailedAddInsideATransactionLeavesTheOthers) {
    NewImage bad = file_picture(2);
    bad.thumbnail.media_type.clear();  // fails after the row itself went in
    expect(store_.transaction([&]() -> Result<void> {
        expect(store_.add(file_picture(1)));
        EXPECT_FALSE(store_.add(bad));
        expect(store_.add(file_picture(3)));
        return {};
    }));
    EXPECT_EQ(expect(store_.counts()).indexed, 2);
    EXPECT_FALSE(expect(store_.known_file(bad.uri)).has_value());
    EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM changes"), 2);
}

TEST_F(ImageWrites, UpdateReplacesThePixelsAndKeepsTheRest) {
    const ImageId id = expect(store_.add(file_picture(1)));
    NewImage now = file_picture(8);
    now.origin = ImageOrigin::kUpload;
    expect(store_.update(id, now));
    const Image image = expect(store_.get(id));
    EXPECT_EQ(image.uri, file_picture(1).uri);
    EXPECT_EQ(image.origin, ImageOrigin::kFile);
    EXPECT_EQ(image.tags, (std::vector<std::string>{"all", "tag1"}));
    EXPECT_EQ(image.metadata, file_picture(1).metadata);
    EXPECT_EQ(image.stamp.size, now.stamp.size);
    EXPECT_EQ(image.stamp.content_hash, now.stamp.content_hash);
    EXPECT_EQ(image.width, now.width);
    EXPECT_FALSE(image.low_information);
    EXPECT_EQ(image.revision, 2);
    EXPECT_EQ(expect(store_.signature(id)), now.signature);
    EXPECT_EQ(expect(store_.thumbnail(id)).bytes, now.thumbnail.bytes);

    now.thumbnail = {};
    expect(store_.update(id, now));
    EXPECT_EQ(store_.thumbnail(id).error().code, ErrorCode::kNotFound);
}

TEST_F(ImageWrites, AFailedUpdateChangesNothing) {
    const ImageId id = expect(store_.add(file_picture(1)));
    NewImage bad = file_picture(8);
    bad.thumbnail.media_type.clear();
    const auto result = store_.update(id, bad);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(result.error().message.find("image 1"), std::string::npos);
    EXPECT_EQ(expect(store_.get(id)).revision, 1);
    EXPECT_EQ(expect(store_.signature(id)), file_picture(1).signature);
}

TEST_F(ImageWrites, UpdateRevivesAFailedAndADeletedRow) {
    const ImageId failed = expect(
        store_.mark_failed(file_picture(1).uri, file_picture(1).stamp, "no image"));
    const ImageId deleted = expect(store_.add(file_picture(2)));
    expect(store_.remove(deleted));
    for (const ImageId id : {failed, deleted}) {
        expect(store_.update(id, file_picture(9)));
        EXPECT_EQ(expect(store_.get(id)).state, ImageState::kIndexed);
        EXPECT_EQ(expect(store_.get(id)).failure, "");
        EXPECT_EQ(expect(store_.signature(id)), file_picture(9).signature);
    }
}

TEST_F(ImageWrites, TouchChangesTheStampAndTheRevision) {
    const ImageId id = expect(store_.add(file_picture(1)));
    expect(store_.touch(id, {77, 88, "newhash"}));
    const Image image = expect(store_.get(id));
    EXPECT_EQ(image.stamp.size, 77);
    EXPECT_EQ(image.stamp.mtime_ns, 88);
    EXPECT_EQ(image.stamp.content_hash, "newhash");
    EXPECT_EQ(image.revision, 2);
    EXPECT_EQ(expect(store_.signature(id)), file_picture(1).signature);
    EXPECT_EQ(store_.touch(id, {-1, 0, ""}).error().code, ErrorCode::kInvalidArgument);
}

TEST_F(ImageWrites, MarkFailedMakesARowOrTakesTheSignatureOfOne) {
    const ImageId fresh =
        expect(store_.mark_failed("file:///new", {5, 6, "h"}, "truncated"));
    EXPECT_EQ(expect(store_.get(fresh)).state, ImageState::kFailed);
    EXPECT_EQ(expect(store_.get(fresh)).failure, "truncated");
    EXPECT_EQ(expect(store_.get(fresh)).stamp.mtime_ns, 6);

    const ImageId known = expect(store_.add(file_picture(1)));
    EXPECT_EQ(expect(store_.mark_failed(file_picture(1).uri, {7, 8, "i"}, "cut")), known);
    const Image image = expect(store_.get(known));
    EXPECT_EQ(image.failure, "cut");
    EXPECT_EQ(image.stamp.size, 7);
    EXPECT_EQ(image.tags.size(), 2u);
    EXPECT_EQ(image.metadata, file_picture(1).metadata);
    EXPECT_EQ(image.width, 0);
    EXPECT_EQ(store_.signature(known).error().code, ErrorCode::kNotFound);
    EXPECT_EQ(store_.thumbnail(known).error().code, ErrorCode::kNotFound);
    EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM thumbnails"), 0);
}

TEST_F(ImageWrites, MarkFailedLeavesAnUploadOfTheSameUriAlone) {
    NewImage upload = upload_picture(1);
    upload.uri = "file:///same";
    const ImageId id = expect(store_.add(upload));
    EXPECT_NE(expect(store_.mark_failed("file:///same", {1, 1, ""}, "cut")), id);
    EXPECT_EQ(expect(store_.get(id)).state, ImageState::kIndexed);
}

TEST_F(ImageWrites, AFailureNeedsAReason) {
    const auto result = store_.mark_failed("file:///x", {}, "");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
    EXPECT_NE(result.error().message.find("file:///x"), std::string::npos);
}

TEST_F(ImageWrites, RemoveTakesAnUploadsRowAndKeepsAFilesStamp) {
    const ImageId upload = expect(store_.add(upload_picture(1)));
    const ImageId file = expect(store_.add(file_picture(2)));
    for (const ImageId id : {upload, file}) {
        expect(store_.remove(id));
        EXPECT_EQ(store_.get(id).error().code, ErrorCode::kNotFound);
        EXPECT_EQ(store_.signature(id).error().code, ErrorCode::kNotFound);
        EXPECT_EQ(store_.thumbnail(id).error().code, ErrorCode::kNotFound);
        expect_not_found(store_.remove(id), to_int(id));
    }
    EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM images"), 1);
    EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM thumbnails"), 0);
    const auto known = expect(store_.known_file(file_picture(2).uri));
    ASSERT_TRUE(known.has_value());
    EXPECT_EQ(known->state, ImageState::kDeleted);
    EXPECT_EQ(known->stamp.content_hash, file_picture(2).stamp.content_hash);
}

TEST_F(ImageWrites, AFailedFileCanBeRemoved) {
    const ImageId id = expect(store_.mark_failed("file:///x", {1, 2, "h"}, "cut"));
    expect(store_.remove(id));
    EXPECT_EQ(expect(store_.known_file("file:///x"))->state, ImageState::kDeleted);
    EXPECT_EQ(expect(store_.counts()).failed, 0);
}

TEST_F(ImageWrites, PurgeTakesTheRowAndAllThatHangsOnIt) {
    const ImageId id = expect(store_.add(file_picture(1)));
    const ImageId deleted = expect(store_.add(file_picture(2)));
    expect(store_.remove(deleted));
    expect(store_.purge(id));
    expect(store_.purge(deleted));
    for (const std::string table : {"images", "thumbnails", "image_tags"}) {
        EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM " + table), 0) << table;
    }
    expect_not_found(store_.purge(id), to_int(id));
}

TEST_F(ImageWrites, AnUnknownIdIsNamedByEveryFunction) {
    expect_not_found(store_.update(ImageId{41}, file_picture(1)), 41);
    expect_not_found(store_.touch(ImageId{42}, {}), 42);
    expect_not_found(store_.remove(ImageId{43}), 43);
    expect_not_found(store_.purge(ImageId{44}), 44);
}

TEST_F(ImageWrites, ATransactionThatFailsOrThrowsLeavesNothing) {
    const auto failed = store_.transaction([&]() -> Result<void> {
        expect(store_.add(file_picture(1)));
        return Error{ErrorCode::kConflict, "the caller's reason"};
    });
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message, "the caller's reason");
    EXPECT_THROW(static_cast<void>(store_.transaction([&]() -> Result<void> {
                     expect(store_.add(file_picture(1)));
                     throw std::length_error("thrown");
                 })),
                 std::length_error);
    EXPECT_EQ(expect(store_.counts()).indexed, 0);
    EXPECT_EQ(sql_integer(handle(), "SELECT count(*) FROM changes"), 0);
    expect(store_.transaction([&]() -> Result<void> {
        expect(store_.add(file_picture(1)));
        return {};
    }));
    EXPECT_EQ(expect(store_.counts()).indexed, 1);
}

TEST_F(ImageWrites, AnotherConnectionSeesATransactionAtItsEndAndAtOnce) {
    Database other = open_database(folder_.file("x.db"));
    ImageStore view(other);
    expect(store_.transaction([&]() -> Result<void> {
        for (int i = 0; i < 10; ++i) {
            expect(store_.add(file_picture(i)));
            EXPECT_EQ(expect(view.counts()).indexed, 0);
        }
        return {};
    }));
    EXPECT_EQ(expect(view.counts()).indexed, 10);
}

TEST_F(ImageWrites, ALockedDatabaseIsUnavailableAndUsableAfterwards) {
    Database other = open_database(folder_.file("x.db"));
    run_sql(other.handle(), "BEGIN IMMEDIATE; DELETE FROM thumbnails");
    sqlite3_busy_timeout(handle(), 1);
    const auto added = store_.add(file_picture(1));
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().code, ErrorCode::kUnavailable) << added.error().message;
    bool worked = false;
    const auto batch = store_.transaction([&]() -> Result<void> {
        worked = true;
        return {};
    });
    ASSERT_FALSE(batch);
    EXPECT_EQ(batch.error().code, ErrorCode::kUnavailable);
    EXPECT_FALSE(worked);
    for (const auto& result : {store_.update(ImageId{1}, file_picture(1)),
                               store_.touch(ImageId{1}, {}),
                               store_.remove(ImageId{1}),
                               store_.purge(ImageId{1})}) {
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().code, ErrorCode::kUnavailable);
    }
    EXPECT_EQ(store_.mark_failed("file:///x", {}, "cut").error().code,
              ErrorCode::kUnavailable);
    run_sql(other.handle(), "ROLLBACK");
    EXPECT_TRUE(store_.add(file_picture(1)));
}

#ifndef NDEBUG
TEST_F(ImageWrites, ATransactionInsideAnotherIsACallersBug) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_DEATH(static_cast<void>(store_.transaction([&] {
                     return store_.transaction([]() -> Result<void> { return {}; });
                 })),
                 "in_transaction");
}
#endif

}  // namespace
}  // namespace haarmony::schema
