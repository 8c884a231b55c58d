// Files that grew: whatever becomes of an append, the file is the old clip or the new one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "engine/video/append.h"
#include "engine/video/build.h"
#include "engine/video/mrv_format.h"
#include "engine/video/mrv_writer.h"
#include "tests/engine/video/appended_clip.h"
#include "tests/engine/video/random_links.h"
#include "tests/engine/video/raw_source.h"

namespace haarmony::video::testing {
namespace {

RawClip frames(std::size_t first, std::size_t end) {
    return part(random_clip(5, 4, 12, 20), first, end);
}

// How many frames a file has, all of them readable; 0: it is refused.
std::int64_t whole_frames(const std::vector<std::byte>& file) {
    const std::unique_ptr<MrvClip> clip = opened(file);
    if (clip == nullptr || !clip->verify()) return 0;
    return clip->shape().frames();
}

// The files that a machine may be left with when it stops during the appends: all writes that
// a sync followed, and of those behind it any, each whole, or its first or its last bytes.
TEST(MrvAppend, AtEveryMomentTheFileIsTheOldClipOrTheNewOne) {
    const std::vector<std::byte> two = appended_bytes(frames(0, 5), {3, 2});
    for (const std::vector<std::byte>& before : {built_bytes(frames(0, 5)), two}) {
        GrowingBytes grown(before);
        ASSERT_TRUE(append_to(grown, frames(5, 7)).has_value());
        const auto& writes = grown.writes();
        // Segment and chunks, a sync, the slot, a sync.
        ASSERT_GT(writes.size(), 4U);
        ASSERT_EQ(writes[writes.size() - 2].bytes.size(), kMrvSlotBytes);
        ASSERT_TRUE(writes[writes.size() - 3].bytes.empty());
        ASSERT_TRUE(writes[writes.size() - 1].bytes.empty());
        std::vector<std::byte> file = before;
        const auto put = [&file](std::uint64_t offset, std::span<const std::byte> bytes) {
            std::vector<std::byte> after = file;
            after.resize(std::max<std::size_t>(after.size(), offset + bytes.size()));
            std::copy(bytes.begin(),
                      bytes.end(),
                      after.begin() + static_cast<std::ptrdiff_t>(offset));
            return after;
        };
        for (const GrowingBytes::Write& write : writes) {
            const bool commits = write.offset < kMrvHeaderBytes;
            const std::size_t step = commits ? 1 : write.bytes.size() / 3 + 1;
            for (std::size_t n = 0; n < write.bytes.size(); n += step) {
                const std::span bytes(write.bytes);
                EXPECT_EQ(whole_frames(put(write.offset, bytes.first(n))), 5);
                EXPECT_EQ(whole_frames(put(write.offset + n, bytes.subspan(n))),
                          commits && n == 0 ? 7 : 5);
            }
            if (!write.bytes.empty()) file = put(write.offset, write.bytes);
        }
        EXPECT_EQ(whole_frames(file), 7);
    }
}

TEST(MrvAppend, AFailureOfTheFileAtAnyStepLeavesTheOldClipUntilTheSlotIsWritten) {
    const std::vector<std::byte> before = built_bytes(frames(0, 3));
    for (int step = 0;; ++step) {
        ASSERT_LT(step, 100);
        GrowingBytes file(before);
        file.fail_at(step);
        const Result<void> appended = append_to(file, frames(3, 4));
        const bool committed = !file.writes().empty() &&
                               file.writes().back().offset == kMrvSlotsAt + kMrvSlotBytes;
        EXPECT_EQ(whole_frames(file.bytes()), appended || committed ? 4 : 3) << step;
        if (appended) {
            EXPECT_GT(step, 4);
            break;
        }
        EXPECT_EQ(appended.error().code, ErrorCode::kIo);
    }
}

TEST(MrvAppend, AnAppendAfterOneThatFailedWritesWhereThatOneDid) {
    const std::vector<std::byte> before = built_bytes(frames(0, 3));
    GrowingBytes failed(before);
    failed.fail_at(3);
    ASSERT_FALSE(append_to(failed, frames(3, 9)).has_value());
    GrowingBytes again(failed.bytes());
    ASSERT_TRUE(append_to(again, frames(3, 5)).has_value());
    GrowingBytes clean(before);
    ASSERT_TRUE(append_to(clean, frames(3, 5)).has_value());
    ASSERT_GE(again.bytes().size(), clean.bytes().size());
    EXPECT_TRUE(
        std::equal(clean.bytes().begin(), clean.bytes().end(), again.bytes().begin()));
}

TEST(MrvAppend, AReaderOfTheOldClipKeepsIt) {
    GrowingBytes file(built_bytes(frames(0, 6)));
    // As a mapping would be: the bytes under the reader change.
    std::vector<std::byte> mapped = file.bytes();
    const std::unique_ptr<MrvClip> reader = opened(mapped);
    ASSERT_NE(reader, nullptr);
    const std::uint64_t revision = reader->revision();
    ASSERT_TRUE(append_to(file, frames(6, 8)).has_value());
    std::copy_n(file.bytes().begin(), mapped.size(), mapped.begin());
    EXPECT_TRUE(reader->verify().has_value());
    EXPECT_EQ(reader->shape().frames(), 6);
    EXPECT_EQ(reader->revision(), revision);
    EXPECT_NE(opened(file.bytes())->revision(), revision);
}

TEST(MrvAppend, MemoryIsThatOfAllGenerations) {
    const RawClip raw = random_clip(20, 12, 7, 21);
    GrowingBytes file(built_bytes(part(raw, 0, 5)));
    const std::vector<std::byte> before = file.bytes();
    ASSERT_TRUE(append_to(file, part(raw, 5, 7)).has_value());
    const std::unique_ptr<MrvClip> old = opened(before);
    const std::unique_ptr<MrvClip> grown = opened(file.bytes());
    // The newest generation's siblings are found at their own addresses.
    std::uint64_t bytes = *old->memory_bytes();
    const MrvIndex& index = grown->front().index;
    for (std::size_t i = 0; i < index.siblings(); ++i) {
        const SiblingAddress& at = index.address(i);
        bytes += sizeof(TimeNode) * static_cast<std::size_t>((*grown->nodes(at))->count);
        for (int level = kBrickLevel; level <= 5; ++level)
            bytes += (*grown->layer(at, level))->memory_bytes();
    }
    EXPECT_EQ(*grown->memory_bytes(), bytes);
    MemorySpool spool;
    MemoryClip::Sink sink;
    RawSource source(raw);
    ASSERT_TRUE(build(source, spool, sink).has_value());
    EXPECT_EQ(*opened(built_bytes(raw))->memory_bytes(), sink.take()->memory_bytes());
}

TEST(MrvAppend, EveryTruncationOfAGrownFileIsNoticed) {
    const std::vector<std::byte> file = appended_bytes(frames(0, 6), {2, 3, 1});
    ASSERT_EQ(whole_frames(file), 6);
    for (std::size_t length = 0; length < file.size(); length += length < 400 ? 1 : 5) {
        EXPECT_EQ(whole_frames(
                      {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length)}),
                  0)
            << length;
    }
}

TEST(MrvAppend, EveryFlippedByteOfAGrownFileIsNoticed) {
    std::vector<std::byte> file = appended_bytes(frames(0, 6), {4, 2});
    const std::size_t tables[] = {kMrvHeaderBytes, kMrvHeaderBytes + kMrvRecordBytes};
    for (std::size_t i = 0; i < file.size(); ++i) {
        // The table that the newest one replaces.
        if (i >= tables[0] && i < tables[1]) continue;
        if (i > 400 && i % 5 != 0) continue;
        file[i] ^= std::byte{1} << i % 8;
        // Without the newest slot the file is the clip that it was before.
        const bool in_newest = i >= kMrvSlotsAt + kMrvSlotBytes && i < kMrvHeaderBytes;
        const bool in_other = i >= kMrvSlotsAt && i < kMrvSlotsAt + kMrvSlotBytes;
        EXPECT_EQ(whole_frames(file), in_newest ? 4 : in_other ? 6 : 0) << i;
        file[i] ^= std::byte{1} << i % 8;
    }
}

template <typename T>
void expect_refused(std::vector<std::byte> file,
                    std::size_t at,
                    T value,
                    const std::string& what) {
    std::memcpy(file.data() + at, &value, sizeof value);
    seal_front(file);
    const Result<MrvFront> read = decode_front(file);
    ASSERT_FALSE(read.has_value()) << what;
    EXPECT_EQ(read.error().code, ErrorCode::kUndecodable);
    EXPECT_NE(read.error().message.find(what), std::string::npos) << read.error().message;
}

TEST(MrvAppend, GenerationsThatContradictEachOtherAreRefused) {
    const std::vector<std::byte> file = appended_bytes(frames(0, 7), {3, 2, 2});
    const Result<MrvFront> front = decode_front(file);
    ASSERT_TRUE(front.has_value());
    ASSERT_EQ((*front).older.size(), 2U);
    const std::uint64_t table = (*front).older[1].end;
    const std::size_t second = table + kMrvRecordBytes;
    // Three generations: the first slot. Another number of them is that of the other slot.
    expect_refused(file, 28, std::uint32_t{5}, "generations are 3");
    expect_refused(file, kMrvSlotsAt, std::uint64_t{4097}, "generations are 4097");
    expect_refused(file, second, std::int64_t{3}, "generation 1: frames are 3");
    expect_refused(file, second, std::int64_t{8}, "generation 2: frames are 7");
    expect_refused(
        file, second + 16, std::uint64_t{1} << 50, "generation 1: index cut off");
    expect_refused(file, second + 24, (*front).older[0].end, "generation 1: end is");
    expect_refused(file, table + 24, table, "generation 0: index: chunks end at byte");
    // With more old frames, siblings of the second would be below what these complete.
    expect_refused(file,
                   table,
                   std::int64_t{4},
                   "generation 1: index: siblings 0 of time level 2, which an older "
                   "generation has");
}

TEST(MrvAppend, ASlotInTheOthersPlaceIsNone) {
    std::vector<std::byte> file = appended_bytes(frames(0, 7), {3, 2, 2});
    const std::uint64_t generations = 4;
    std::memcpy(file.data() + kMrvSlotsAt, &generations, sizeof generations);
    seal_front(file);
    EXPECT_EQ(whole_frames(file), 5);
}

TEST(MrvAppend, SiblingsOfAnOlderGenerationAreRefused) {
    // The second generation, a build of all its frames, has the siblings of the first, too.
    const RawClip raw = frames(0, 5);
    GrowingBytes file(built_bytes(part(raw, 0, 4)));
    const std::vector<std::byte> before = file.bytes();
    const std::unique_ptr<MrvClip> clip = opened(before);
    const std::vector<std::byte> whole = built_bytes(raw);
    const std::unique_ptr<MrvClip> built = opened(whole);
    MemorySpool waiting;
    MrvWriter writer(clip->front(), waiting, file);
    ASSERT_TRUE(writer.begin(built->shape(), 0).has_value());
    const auto add = [&](const SiblingAddress& at) {
        Siblings siblings{at, **built->nodes(at), {}};
        for (int level = kBrickLevel; level <= kBrickLevel; ++level)
            siblings.layers.push_back(**built->layer(at, level));
        ASSERT_TRUE(writer.add(std::move(siblings)).has_value());
    };
    add({0, 0});
    add({1, 0});
    add({2, 0});
    ASSERT_TRUE(writer.finish().has_value());
    const Result<MrvFront> read = decode_front(file.bytes());
    ASSERT_FALSE(read.has_value());
    EXPECT_NE(
        read.error().message.find("generation 1: index: siblings 0 of time level 2, "
                                  "which an older generation has"),
        std::string::npos)
        << read.error().message;
}

TEST(MrvAppend, AClipOfTheMostGenerationsTakesNoMore) {
    const std::vector<std::byte> file = built_bytes(frames(0, 2));
    MrvFront front = opened(file)->front();
    front.older.resize(kMostGenerations - 1,
                       {.shape = front.shape,
                        .index = {},
                        .index_bytes = 0,
                        .index_checksum = 0,
                        .end = 0});
    MemorySpool waiting;
    GrowingBytes grown(file);
    MrvWriter writer(front, waiting, grown);
    const Result<void> begun = writer.begin(*ClipShape::make(front.shape.format(), 3), 0);
    ASSERT_FALSE(begun.has_value());
    EXPECT_EQ(begun.error().code, ErrorCode::kConflict);
    EXPECT_NE(begun.error().message.find("4095 times"), std::string::npos);
}

}  // namespace
}  // namespace haarmony::video::testing
