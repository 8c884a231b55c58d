#include "engine/video/accounting.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "engine/video/build.h"
#include "engine/video/memory_clip.h"
#include "tests/engine/video/raw_source.h"

namespace haarmony::video {
namespace {

using testing::exact_picture;
using testing::plain_clip;
using testing::random_clip;
using testing::RawClip;
using testing::RawSource;

std::unique_ptr<MemoryClip> built(const RawClip& clip) {
    RawSource source(clip);
    MemorySpool spool;
    MemoryClip::Sink sink;
    EXPECT_TRUE(build(source, spool, sink, {}).has_value());
    return sink.take();
}

// The padded pictures of a time node, by level.
using Pyramid = std::vector<Picture>;

Rgba pixel(const Pyramid& pyramid, int level, int x, int y) {
    const Picture& picture = pyramid[static_cast<std::size_t>(level)];
    return x < picture.width && y < picture.height ? picture.at(x, y) : kClear;
}

// Whether all finest pixels below a square look the same.
bool flat(const Pyramid& pyramid, int level, int x, int y) {
    const int finest = static_cast<int>(pyramid.size()) - 1;
    const int side = 1 << (finest - level);
    for (int v = y * side; v < (y + 1) * side; ++v) {
        for (int u = x * side; u < (x + 1) * side; ++u) {
            if (!(pixel(pyramid, finest, u, v) ==
                  pixel(pyramid, finest, x * side, y * side))) {
                return false;
            }
        }
    }
    return true;
}

bool alike(const Pyramid& a, const Pyramid& b, int level, int x, int y) {
    if (!(pixel(a, level, x, y) == pixel(b, level, x, y))) return false;
    if (level + 1 == static_cast<int>(a.size())) return true;
    for (int q = 0; q < 4; ++q) {
        if (!alike(a, b, level + 1, 2 * x + (q & 1), 2 * y + (q >> 1))) return false;
    }
    return true;
}

// Figure 5.7 at delta 0, literally.
void walk(const Pyramid& node,
          const Pyramid* parent,
          bool linked,
          int level,
          int x,
          int y,
          StorageCounts& counts) {
    if (level + 1 == static_cast<int>(node.size()) || flat(node, level, x, y)) return;
    ++counts.pruned_subtrees;
    if (!linked && parent != nullptr && alike(node, *parent, level, x, y)) {
        linked = true;
        ++counts.uplinks;
    }
    if (!linked) ++counts.own_subtrees;
    for (int q = 0; q < 4; ++q) {
        walk(node, parent, linked, level + 1, 2 * x + (q & 1), 2 * y + (q >> 1), counts);
    }
}

StorageCounts plain_counts(const RawClip& clip) {
    const ClipShape shape = shape_of(clip);
    const auto pyramid_of = [&](const NodeAddress& at) {
        Pyramid pyramid;
        for (int level = 0; level <= shape.space_levels(); ++level) {
            pyramid.push_back(exact_picture(clip, at, level, Edge::kPad));
        }
        return pyramid;
    };
    StorageCounts counts;
    std::vector<Pyramid> above;
    for (int k = 0; k <= shape.time_levels(); ++k) {
        std::vector<Pyramid> here;
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            here.push_back(pyramid_of({k, i}));
            walk(here.back(),
                 k == 0 ? nullptr : &above[static_cast<std::size_t>(i / 2)],
                 false,
                 0,
                 0,
                 0,
                 counts);
            ++counts.time_nodes;
            for (int level = 0; level < shape.space_levels(); ++level) {
                counts.complete_subtrees += std::uint64_t{1} << (2 * level);
            }
        }
        above = std::move(here);
    }
    counts.paper_bytes = 24 * counts.own_subtrees + 12 * counts.time_nodes;
    counts.complete_bytes = 24 * counts.complete_subtrees + 12 * counts.time_nodes;
    counts.pruned_bytes = 24 * counts.pruned_subtrees + 12 * counts.time_nodes;
    return counts;
}

// Flat squares of several sizes, some of which move or change.
RawClip blocks(int width, int height, int frames) {
    RawClip clip;
    clip.format = {width, height, {25, 1}};
    for (int t = 0; t < frames; ++t) {
        Picture frame(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const int size = x < width / 2 ? 4 : 1 + y % 3;
                const int shift = y < height / 2 ? t / 2 : 0;
                const auto value =
                    static_cast<std::uint8_t>(((x + shift) / size + y / 4) % 3 * 80);
                if (value == 0 && x % 5 < 3) continue;
                frame.at(x, y) = {value, 10, 20, 255};
            }
        }
        clip.frames.push_back(frame);
    }
    return clip;
}

void expect_equal(const StorageCounts& got, const StorageCounts& want) {
    EXPECT_EQ(got.time_nodes, want.time_nodes);
    EXPECT_EQ(got.complete_subtrees, want.complete_subtrees);
    EXPECT_EQ(got.pruned_subtrees, want.pruned_subtrees);
    EXPECT_EQ(got.own_subtrees, want.own_subtrees);
    EXPECT_EQ(got.uplinks, want.uplinks);
    EXPECT_EQ(got, want);
}

TEST(Accounting, CountsWhatTheDissertationsTreeHas) {
    std::vector<RawClip> clips = {blocks(32, 32, 8),
                                  blocks(21, 37, 5),
                                  blocks(40, 9, 1),
                                  random_clip(16, 16, 6, 1, true),
                                  random_clip(19, 16, 3, 2)};
    for (const auto& [width, height] :
         std::vector<std::pair<int, int>>{{1, 1}, {2, 1}, {3, 4}, {5, 8}}) {
        clips.push_back(blocks(width, height, 5));
        clips.push_back(random_clip(width, height, 3, 3, true));
    }
    for (const RawClip& clip : clips) {
        SCOPED_TRACE(std::to_string(clip.format.width) + "x" +
                     std::to_string(clip.format.height));
        const Result<StorageCounts> counts = count_storage(*built(clip));
        ASSERT_TRUE(counts.has_value());
        expect_equal(*counts, plain_counts(clip));
    }
}

TEST(Accounting, HowAClipIsStoredMakesNoDifference) {
    // The same pictures without any sharing or pruning.
    for (const RawClip& clip : {blocks(32, 20, 5), random_clip(16, 16, 4, 4, true)}) {
        const Result<StorageCounts> counts = count_storage(*plain_clip(clip));
        ASSERT_TRUE(counts.has_value());
        expect_equal(*counts, plain_counts(clip));
    }
}

TEST(Accounting, FramesThatAreNotStoredCountAsLinkedOnes) {
    RawClip clip = blocks(16, 16, 3);
    clip.frames = {clip.frames[0],
                   clip.frames[0],
                   clip.frames[0],
                   clip.frames[0],
                   clip.frames[2],
                   clip.frames[2],
                   clip.frames[2]};
    const std::unique_ptr<MemoryClip> memory = built(clip);
    ASSERT_FALSE(memory->stored({2, 0}));
    const Result<StorageCounts> counts = count_storage(*memory);
    ASSERT_TRUE(counts.has_value());
    expect_equal(*counts, plain_counts(clip));
}

TEST(Accounting, ACompleteTreeIsWhatTable51Says) {
    // Wind stress, 64 x 64 and 2000 days stored as 2048: 134,201 Kb.
    RawClip clip;
    clip.format = {64, 64, {25, 1}};
    clip.frames.emplace_back(64, 64);
    RawSource source(clip);
    source.set_repeats({2048});
    MemorySpool spool;
    MemoryClip::Sink sink;
    ASSERT_TRUE(build(source, spool, sink, {}).has_value());
    const Result<StorageCounts> counts = count_storage(*sink.take());
    ASSERT_TRUE(counts.has_value());
    EXPECT_EQ((*counts).complete_bytes, 134'201'340U);
    EXPECT_EQ((*counts).own_subtrees, 0U);
    EXPECT_EQ((*counts).paper_bytes, 12U * 4095);
}

// A clip whose storage fails at the call that it is told to.
class FaultyClip final : public TimeTree {
  public:
    FaultyClip(const TimeTree& clip, int fail_at)
        : TimeTree(clip.shape(), clip.delta()), clip_(clip), fail_at_(fail_at) {}
    [[nodiscard]] bool stored(const SiblingAddress& address) const override {
        return clip_.stored(address);
    }
    [[nodiscard]] Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const override {
        if (calls_++ == fail_at_) return Error{ErrorCode::kIo, "read"};
        return clip_.nodes(address);
    }
    [[nodiscard]] Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                int space_level) const override {
        if (calls_++ == fail_at_) return Error{ErrorCode::kIo, "read"};
        return clip_.layer(address, space_level);
    }
    [[nodiscard]] int calls() const { return calls_; }

  private:
    const TimeTree& clip_;
    int fail_at_;
    mutable int calls_ = 0;
};

TEST(Accounting, PassesOnWhatTheStorageMeetsAtEveryCall) {
    const std::unique_ptr<MemoryClip> memory = built(random_clip(16, 16, 3, 5));
    const FaultyClip sound(*memory, -1);
    ASSERT_TRUE(count_storage(sound).has_value());
    ASSERT_GT(sound.calls(), 10);
    for (int call = 0; call < sound.calls(); ++call) {
        const FaultyClip faulty(*memory, call);
        const Result<StorageCounts> counts = count_storage(faulty);
        ASSERT_FALSE(counts.has_value()) << call;
        EXPECT_EQ(counts.error().code, ErrorCode::kIo);
    }
}

}  // namespace
}  // namespace haarmony::video
