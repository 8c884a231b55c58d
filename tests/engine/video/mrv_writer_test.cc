// Files written: their order, their revision, and what happens when the storage fails.
#include "engine/video/mrv_writer.h"

#include <gtest/gtest.h>

#include "engine/video/layer_coder.h"
#include "engine/video/mrv_format.h"
#include "tests/engine/video/random_links.h"

namespace haarmony::video::testing {
namespace {

TEST(MrvWriter, CoarseLevelsComeFirstWithoutGaps) {
    const LinkedClip clip = linked_clip(60, 40, 6, 1);
    const std::vector<std::byte> file = mrv_bytes(clip);
    const Result<MrvFront> front = decode_front(file);
    ASSERT_TRUE(front.has_value());
    const MrvIndex& index = (*front).index;
    std::uint64_t next = index.chunk(0, 0).offset;
    for (int row = 0; row < index.rows(); ++row) {
        for (std::size_t i = 0; i < index.siblings(); ++i) {
            const MrvChunk& chunk = index.chunk(row, i);
            if (chunk.bytes == 0) continue;
            EXPECT_EQ(chunk.offset, next);
            next = chunk.offset + chunk.bytes;
        }
    }
    EXPECT_EQ(next, file.size());
    EXPECT_EQ(index.siblings(), clip.siblings.size());
}

TEST(MrvWriter, EqualClipsAreEqualBytes) {
    const auto one = mrv_bytes(linked_clip(30, 30, 5, 2));
    EXPECT_EQ(one, mrv_bytes(linked_clip(30, 30, 5, 2)));
    EXPECT_NE(one, mrv_bytes(linked_clip(30, 30, 5, 3)));
}

void change_first(Bricks& bricks) {
    Bricks changed;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
        Brick brick = bricks[i];
        if (i == 0) brick[63] = {static_cast<std::uint8_t>(brick[63].r + 1), 0, 0, 255};
        changed.push_back(brick);
    }
    bricks = changed;
}

TEST(MrvWriter, TheRevisionFollowsTheContent) {
    const auto revision = [](const LinkedClip& clip) {
        return (*decode_front(mrv_bytes(clip))).revision;
    };
    LinkedClip clip = linked_clip(30, 30, 5, 2);
    const std::uint64_t first = revision(clip);
    EXPECT_EQ(first, revision(linked_clip(30, 30, 5, 2)));
    ++clip.delta;
    EXPECT_NE(first, revision(clip));
    --clip.delta;
    change_first(clip.siblings.front().layers.back().bricks);
    EXPECT_NE(first, revision(clip));
}

TEST(MrvWriter, AFlatLayerKeepsWithinTheExpansionThatAReaderAllows) {
    LinkedClip clip = linked_clip(16, 16, 1, 4);
    Layer& layer = clip.siblings[0].layers[1];
    const Brick brick = layer.bricks[0];
    layer.bricks.clear();
    for (int i = 0; i < 4'000; ++i) layer.bricks.push_back(brick);
    const auto file = mrv_bytes(clip);
    const Result<MrvFront> front = decode_front(file);
    ASSERT_TRUE(front.has_value());
    const MrvChunk& chunk = (*front).index.chunk(mrv_row_of(4), 0);
    EXPECT_GE(chunk.bytes * kMostExpansion, chunk.size.memory_bytes());
    EXPECT_LT(chunk.bytes * kMostExpansion, chunk.size.memory_bytes() * 2);
}

// Fails at the n-th call.
class FailingSpool final : public Spool {
  public:
    explicit FailingSpool(int calls) : calls_(calls) {}
    Result<std::uint64_t> append(std::span<const std::byte> bytes) override {
        if (calls_-- == 0) return Error{ErrorCode::kIo, "disk full"};
        return kept_.append(bytes);
    }
    Result<void> read(std::uint64_t offset, std::span<std::byte> bytes) override {
        if (calls_-- == 0) return Error{ErrorCode::kIo, "disk gone"};
        return kept_.read(offset, bytes);
    }

  private:
    int calls_;
    MemorySpool kept_;
};

Result<void> write(const LinkedClip& clip, Spool& waiting, Spool& file) {
    MrvWriter writer(waiting, file);
    if (Result<void> begun = writer.begin(clip.shape, clip.delta); !begun) return begun;
    for (const Siblings& siblings : clip.siblings) {
        if (Result<void> added = writer.add(siblings); !added) return added;
    }
    return writer.finish();
}

TEST(MrvWriter, AFailureOfTheStorageAtAnyStepIsPassedOn) {
    const LinkedClip clip = linked_clip(12, 12, 2, 5);
    for (const bool waiting_fails : {false, true}) {
        int steps = 0;
        for (;; ++steps) {
            ASSERT_LT(steps, 200);
            FailingSpool failing(steps);
            MemorySpool good;
            const Result<void> written =
                waiting_fails ? write(clip, failing, good) : write(clip, good, failing);
            if (written) break;
            EXPECT_EQ(written.error().code, ErrorCode::kIo) << steps;
        }
        EXPECT_GT(steps, 3);
    }
}

TEST(MrvWriter, AWriterBeginsAnew) {
    const LinkedClip clip = linked_clip(12, 12, 2, 6);
    MemorySpool waiting;
    MemorySpool file;
    MrvWriter writer(waiting, file);
    ASSERT_TRUE(writer.begin(clip.shape, 5).has_value());
    ASSERT_TRUE(writer.add(clip.siblings.front()).has_value());
    ASSERT_TRUE(writer.begin(clip.shape, clip.delta).has_value());
    for (const Siblings& siblings : clip.siblings)
        ASSERT_TRUE(writer.add(siblings).has_value());
    ASSERT_TRUE(writer.finish().has_value());
    std::vector<std::byte> bytes(writer.file_bytes());
    ASSERT_TRUE(file.read(0, bytes).has_value());
    EXPECT_EQ(bytes, mrv_bytes(clip));
    EXPECT_EQ(writer.revision(), (*decode_front(bytes)).revision);
}

}  // namespace
}  // namespace haarmony::video::testing
