// Snapshot files written and read: what comes back, and what must not.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "server/app/file_descriptor.h"
#include "server/app/snapshot_reader.h"
#include "server/app/snapshot_writer.h"
#include "server/app/thread_executor.h"
#include "tests/schema/scratch_folder.h"
#include "tests/server/app/snapshot_contents.h"

namespace haarmony::server {
namespace {

using testing::HasSubstr;

class SnapshotFile : public testing::Test {
  protected:
    void write(const SnapshotContents& contents) {
        const auto bytes = write_some(contents, path_);
        ASSERT_TRUE(bytes) << bytes.error().message;
        EXPECT_EQ(*bytes, std::filesystem::file_size(path_));
        EXPECT_FALSE(std::filesystem::exists(path_ + ".partial"));
    }
    void expect_refused(const std::string& named) {
        const auto read = read_some(path_);
        ASSERT_FALSE(read) << named;
        EXPECT_THAT(read.error().message, HasSubstr(named));
    }

    schema::ScratchFolder folder_;
    const std::string path_ = folder_.file("x.snapshot");
};

TEST_F(SnapshotFile, AnswersAreThoseOfBefore) {
    const SnapshotContents contents = some_contents();
    // Otherwise the test says little.
    ASSERT_GT(contents.segments.at("yiq-standard").size(), 1U);
    ASSERT_NE(contents.segments.at("yiq-standard")[0].removed, nullptr);
    const Answers before = answers_of(contents.segments);
    ASSERT_EQ(before.at("yiq-standard").size(), 3U * 160);
    write(contents);
    for (const int threads : {0, 3}) {
        ThreadExecutor executor(threads);
        const auto read = read_snapshot(
            path_,
            kSnapshotIndexM,
            [](const SnapshotTable& table) {
                EXPECT_EQ(table.token, kSomeToken);
                EXPECT_EQ(table.sequence, 1234);
                return Result<void>();
            },
            executor);
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->sequence, contents.sequence);
        EXPECT_EQ(read->index_m, contents.index_m);
        EXPECT_EQ(read->damaged, contents.damaged);
        EXPECT_EQ(answers_of(read->segments), before);
    }
}

TEST_F(SnapshotFile, NothingComesBackAsNothing) {
    SnapshotContents nothing;
    nothing.index_m = kSnapshotIndexM;
    write(nothing);
    const auto read = read_some(path_);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(read->segments.empty());
    EXPECT_EQ(read->sequence, 0);
}

TEST_F(SnapshotFile, SegmentsOfWhichAllIsGoneAreLeftOut) {
    SnapshotContents contents = some_contents();
    const auto removed = std::make_shared<image::Tombstones>(
        contents.segments.at("lab-standard")[0].segment->size());
    for (int slot = 0; slot < contents.segments.at("lab-standard")[0].segment->size();
         ++slot)
        removed->set(slot);
    contents.segments.at("lab-standard")[0].removed = removed;
    write(contents);
    const auto read = read_some(path_);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->segments.at("lab-standard").size(),
              contents.segments.at("lab-standard").size() - 1);
}

TEST_F(SnapshotFile, StaysReadableWhenItIsReplacedOrDeleted) {
    const SnapshotContents contents = some_contents();
    const Answers before = answers_of(contents.segments);
    write(contents);
    const auto read = read_some(path_);
    ASSERT_TRUE(read) << read.error().message;
    SnapshotContents nothing;
    nothing.index_m = kSnapshotIndexM;
    write(nothing);
    EXPECT_EQ(answers_of(read->segments), before);
    std::filesystem::remove(path_);
    EXPECT_EQ(answers_of(read->segments), before);
}

TEST_F(SnapshotFile, OfAnotherIndexIsRefused) {
    write(some_contents());
    const auto read = read_some(path_, 60);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kConflict);
    EXPECT_THAT(read.error().message, HasSubstr("45 coefficients a channel, not 60"));
}

TEST_F(SnapshotFile, OfAnotherDatabaseIsRefusedForItsReason) {
    write(some_contents());
    InlineExecutor executor;
    const auto read = read_snapshot(
        path_,
        kSnapshotIndexM,
        [](const SnapshotTable&) -> Result<void> {
            return Error{ErrorCode::kConflict, "of somebody else"};
        },
        executor);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().message, "of somebody else");
}

TEST_F(SnapshotFile, ThatIsNotThereIsNotFound) {
    const auto read = read_some(path_);
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::kNotFound);
    EXPECT_THAT(read.error().message, HasSubstr(path_));
    std::filesystem::create_directory(path_);
    expect_refused("is no file");
}

TEST_F(SnapshotFile, AnyBitOfItCounts) {
    write(some_contents());
    const std::string whole = bytes_in(path_);
    // Header and table have a test that flips every bit of theirs.
    for (std::size_t place = 0; place < whole.size(); place += 4093) {
        std::string damaged = whole;
        damaged[place] = static_cast<char>(damaged[place] ^ (1 << (place % 8)));
        put_bytes(path_, damaged);
        ASSERT_FALSE(read_some(path_)) << place;
    }
    // The zeros behind the last part as well.
    std::string damaged = whole;
    damaged.back() = 1;
    put_bytes(path_, damaged);
    expect_refused("checksum");
}

TEST_F(SnapshotFile, CutOffAnywhereItIsRefused) {
    write(some_contents());
    const std::string whole = bytes_in(path_);
    for (std::size_t size = 0; size < whole.size(); size += 20'011) {
        put_bytes(path_, whole.substr(0, size));
        ASSERT_FALSE(read_some(path_)) << size;
    }
    put_bytes(path_, whole + "x");
    expect_refused("it has " + std::to_string(whole.size() + 1) + " bytes");
}

// What checksums do not tell, because they are right.
TEST_F(SnapshotFile, PartsThatNoWriterWritesAreRefused) {
    write(some_contents());
    const std::string whole = bytes_in(path_);
    const auto bytes = std::as_bytes(std::span(whole));
    SnapshotTable table = decode_table(bytes).value();
    const auto with = [&](std::string changed) {
        const std::vector<std::byte> begin = encode_table(table);
        std::memcpy(changed.data(), begin.data(), begin.size());
        put_bytes(path_, changed);
    };
    std::size_t begin = table.parts_begin();
    std::size_t number = 0;
    for (; !table.parts.at(number).has_removed; ++number)
        begin += table.parts[number].extent();
    SnapshotPart& part = table.parts[number];
    const SnapshotPart sound = part;
    const std::string name = "part " + std::to_string(number);
    part.counts.dense_postings += 1000;
    with(whole);
    expect_refused(name + ": a segment of the index is damaged: its size is");
    part = sound;
    part.counts.slots = 0;
    part.has_removed = false;
    part.segment_bytes += aligned_in_snapshot(sound.removed_bytes());
    part.segment_checksum = snapshot_checksum(bytes.subspan(begin, part.extent()));
    with(whole);
    expect_refused(name + ": a segment of the index is damaged: its counts are");
    part = sound;
    part.segment_bytes -= 1;
    with(whole);
    expect_refused(name + ": a segment of the index is damaged: its size is");
    part = sound;

    std::string removals = whole;
    begin += aligned_in_snapshot(part.segment_bytes);
    removals[begin + part.removed_bytes() - 1] = '\x80';
    part.removed_checksum = snapshot_checksum(
        std::as_bytes(std::span(removals)).subspan(begin, kSnapshotAlignment));
    with(removals);
    expect_refused("is removed");
}

// Each thing that may go wrong while writing.
TEST_F(SnapshotFile, WhatCannotBeWrittenLeavesTheOldFileAndNoOther) {
    write(some_contents());
    const std::string before = bytes_in(path_);
    const SnapshotContents contents = some_contents();
    InlineExecutor executor;
    SnapshotWriting writing;
    writing.path = path_;
    writing.token = [] { return Result<schema::SnapshotToken>(kSomeToken); };
    const auto expect_left_alone = [&](const std::string& named) {
        const auto written = write_snapshot(contents, writing, executor);
        ASSERT_FALSE(written) << named;
        EXPECT_THAT(written.error().message, HasSubstr(named));
        EXPECT_EQ(bytes_in(path_), before);
        EXPECT_FALSE(std::filesystem::exists(path_ + ".partial")) << named;
    };
    // Stopped at every place where it asks.
    for (int allowed = 0;; ++allowed) {
        int asked = 0;
        writing.go_on = [&](std::uint64_t bytes, std::uint64_t total) {
            EXPECT_LT(bytes, total);
            return asked++ < allowed;
        };
        if (write_snapshot(contents, writing, executor)) break;
        expect_left_alone("was stopped");
        ASSERT_LT(allowed, 100);
    }
    write(contents);
    writing.go_on = [](std::uint64_t, std::uint64_t) { return true; };
    writing.token = [] {
        return Result<schema::SnapshotToken>(Error{ErrorCode::kIo, "no token today"});
    };
    expect_left_alone("no token today");
}

TEST_F(SnapshotFile, InAFolderThatIsNotThereIsAnError) {
    const auto written = write_some(some_contents(), folder_.file("gone/x.snapshot"));
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr("gone/x.snapshot.partial"));
}

TEST_F(SnapshotFile, OnlyOneProcessWritesIt) {
    const FileDescriptor other(
        ::open((path_ + ".partial").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    ASSERT_EQ(::flock(other.get(), LOCK_EX), 0);
    const auto written = write_some(some_contents(), path_);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().code, ErrorCode::kUnavailable);
    EXPECT_FALSE(std::filesystem::exists(path_));
    EXPECT_TRUE(std::filesystem::exists(path_ + ".partial"));
}

TEST_F(SnapshotFile, WhatAKilledProcessLeftIsOverwritten) {
    put_bytes(path_ + ".partial", std::string(50'000'000, 'x'));
    write(some_contents());
    EXPECT_TRUE(read_some(path_));
}

TEST_F(SnapshotFile, ThatCannotBePublishedIsAnError) {
    std::filesystem::create_directories(path_ + "/occupied");
    const auto written = write_some(some_contents(), path_);
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr("renamed"));
    EXPECT_FALSE(std::filesystem::exists(path_ + ".partial"));
}

// The complete check, which the reader leaves out: ids in another order are no danger.
TEST_F(SnapshotFile, OfADamagedSegmentIsNeverPublished) {
    SnapshotContents contents = some_contents();
    const image::Segment& sound = *contents.segments.at("lab-standard")[0].segment;
    const auto copy = std::make_shared<image::Copy>(sound);
    std::swap(copy->spans().slots_by_id[0], copy->spans().slots_by_id[1]);
    const auto view = image::view_known_segment(copy->counts, copy->bytes());
    ASSERT_TRUE(view);
    contents.segments.at("lab-standard")[0].segment =
        image::Segment::from_view(view.value(), copy);
    const auto written = write_some(contents, path_);
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().message, HasSubstr("id in order"));
    EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace haarmony::server
