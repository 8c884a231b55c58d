#include "ingest/change.h"

#include <gtest/gtest.h>

namespace haarmony::ingest {
namespace {

using schema::ImageState;
using schema::KnownFile;

constexpr FileLook kLook{100, 5'000'000'000};

std::optional<KnownFile> row(ImageState state, FileLook look, std::string hash) {
    return KnownFile{ImageId{1}, state, {look.size, look.mtime_ns, std::move(hash)}};
}

TEST(FirstNeed, OnlySameSizeAndTimeIsUnchanged) {
    for (const ImageState state : {ImageState::kIndexed, ImageState::kDeleted}) {
        EXPECT_EQ(first_need(row(state, kLook, "h"), kLook, false), Need::kNothing);
        EXPECT_EQ(first_need(row(state, kLook, "h"), {101, kLook.mtime_ns}, false),
                  Need::kCompare);
        // Older counts as different as well: files are restored from backups.
        for (const std::int64_t step : {-1, 1}) {
            EXPECT_EQ(
                first_need(row(state, kLook, "h"), {100, kLook.mtime_ns + step}, false),
                Need::kCompare);
        }
    }
}

TEST(FirstNeed, AnUnsettledStampIsNeverUnchanged) {
    const FileLook look{100, kUnsettledMtime};
    EXPECT_EQ(first_need(row(ImageState::kIndexed, look, "h"), look, false),
              Need::kCompare);
}

TEST(FirstNeed, UnknownFailedAndRestoredFilesAreDecoded) {
    EXPECT_EQ(first_need(std::nullopt, kLook, false), Need::kDecode);
    EXPECT_EQ(first_need(row(ImageState::kFailed, kLook, "h"), kLook, false),
              Need::kDecode);
    EXPECT_EQ(first_need(row(ImageState::kDeleted, kLook, "h"), kLook, true),
              Need::kDecode);
}

TEST(StampOf, IsUnsettledWhileTheClockOfTheFileMayStandStill) {
    const std::int64_t mtime = kLook.mtime_ns;
    EXPECT_EQ(stamp_of(kLook, mtime, "h").mtime_ns, kUnsettledMtime);
    EXPECT_EQ(stamp_of(kLook, mtime + kRacyNs - 1, "h").mtime_ns, kUnsettledMtime);
    EXPECT_EQ(stamp_of(kLook, mtime + kRacyNs, "h").mtime_ns, mtime);
    EXPECT_EQ(stamp_of(kLook, mtime + kRacyNs, "h").size, kLook.size);
    EXPECT_EQ(stamp_of(kLook, mtime + kRacyNs, "h").content_hash, "h");
}

TEST(StampOf, AFileFromTheFutureIsUnsettledAndOneFromLongAgoIsNot) {
    constexpr std::int64_t kNow = 1'700'000'000'000'000'000;
    EXPECT_EQ(stamp_of({1, kNow + kRacyNs}, kNow, "").mtime_ns, kUnsettledMtime);
    EXPECT_EQ(stamp_of({1, std::numeric_limits<std::int64_t>::max()}, kNow, "").mtime_ns,
              kUnsettledMtime);
    EXPECT_EQ(stamp_of({1, kUnsettledMtime + 1}, kNow, "").mtime_ns, kUnsettledMtime + 1);
}

// What only two processes at once can bring about: the row is not the one looked up.
TEST(Settle, LeavesARowThatAnotherProcessHasBroughtUpToDate) {
    const schema::FileStamp stamp{1, 2, "new"};
    schema::NewImage image;
    image.stamp = stamp;
    const Settlement touched{RowOperation::kTouch, CountedAs::kSkipped};
    const auto indexed = row(ImageState::kIndexed, kLook, "new");
    const auto deleted = row(ImageState::kDeleted, kLook, "new");
    EXPECT_EQ(settle(indexed, Described{image}, false), touched);
    EXPECT_EQ(settle(deleted, Described{image}, false), touched);
    EXPECT_EQ(settle(indexed, Undecodable{stamp, "bad"}, false), touched);
    const Settlement updated{RowOperation::kUpdate, CountedAs::kUpdated};
    EXPECT_EQ(settle(deleted, Described{image}, true), updated);
}

TEST(Settle, ALostOrChangedRowIsLeftForTheNextRun) {
    const SameContent same{{1, 2, "h"}};
    const Settlement nothing{RowOperation::kNone, CountedAs::kSkipped};
    EXPECT_EQ(settle(std::nullopt, same, false), nothing);
    EXPECT_EQ(settle(row(ImageState::kIndexed, kLook, "other"), same, false), nothing);
    EXPECT_EQ(settle(row(ImageState::kFailed, kLook, "h"), same, false), nothing);
}

TEST(Settle, AnEmptyHashIsEqualToNone) {
    schema::NewImage image;
    const Settlement updated{RowOperation::kUpdate, CountedAs::kUpdated};
    EXPECT_EQ(settle(row(ImageState::kDeleted, kLook, ""), Described{image}, false),
              updated);
}

}  // namespace
}  // namespace haarmony::ingest
