// Frames appended: the clip is, byte for byte, what a build of all frames at once makes.
#include "engine/video/append.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "engine/video/accounting.h"
#include "engine/video/build.h"
#include "engine/video/incremental_display.h"
#include "engine/video/mrv_format.h"
#include "engine/video/ops/clip_frames.h"
#include "engine/video/timeline.h"
#include "tests/engine/video/appended_clip.h"
#include "tests/engine/video/failing_clip.h"
#include "tests/engine/video/faulty_spool.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_draw.h"
#include "tests/engine/video/raw_source.h"

namespace haarmony::video::testing {
namespace {

using Counts = std::vector<std::size_t>;

// Every time node at every space level and edge, against the definition.
void expect_exact(const RawClip& raw, const TimeTree& clip) {
    const ClipShape& shape = clip.shape();
    ASSERT_EQ(shape, shape_of(raw));
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const Result<Frame> frame = clip.frame({k, i}, shape.space_levels());
            ASSERT_TRUE(frame.has_value()) << k << " " << i << frame.error().message;
            for (int level = 0; level <= shape.space_levels(); ++level) {
                for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
                    ASSERT_EQ(shown_picture(*frame, level, edge),
                              exact_picture(raw, {k, i}, level, edge))
                        << "time node " << k << "/" << i << ", space level " << level;
                }
            }
        }
    }
}

// Which siblings there are is told by the frames alone, however they came.
void expect_same_tree(const TimeTree& built, const TimeTree& appended) {
    const ClipShape& shape = built.shape();
    for (int k = 0; k <= shape.time_levels(); ++k) {
        const std::int64_t groups = k == 0 ? 1 : shape.nodes_at(k - 1);
        for (std::int64_t i = 0; i < groups; ++i)
            EXPECT_EQ(appended.stored({k, i}), built.stored({k, i})) << k << " " << i;
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            EXPECT_EQ((*appended.frame({k, i}, 0)).stored(),
                      (*built.frame({k, i}, 0)).stored());
        }
    }
}

void expect_as_built(const RawClip& raw, const Counts& counts) {
    SCOPED_TRACE(::testing::PrintToString(counts));
    const std::vector<std::byte> file = appended_bytes(raw, counts);
    const std::unique_ptr<MrvClip> clip = opened(file);
    ASSERT_NE(clip, nullptr);
    EXPECT_EQ(clip->front().older.size() + 1, counts.size());
    EXPECT_TRUE(clip->verify().has_value());
    expect_exact(raw, *clip);
    const std::vector<std::byte> at_once = built_bytes(raw);
    const std::unique_ptr<MrvClip> built = opened(at_once);
    expect_same_tree(*built, *clip);
    const Result<StorageCounts> counted = count_storage(*clip);
    ASSERT_TRUE(counted.has_value());
    EXPECT_EQ(*counted, *count_storage(*built));
}

TEST(Append, EverySplitOfAShortClipIsWhatABuildMakes) {
    const RawClip raw = moving_clip(11, 9, 9, 1);
    for (std::size_t n = 1; n < 9; ++n) {
        for (std::size_t m = 1; n + m <= 9; ++m)
            expect_as_built(part(raw, 0, n + m), {n, m});
    }
}

TEST(Append, SeveralInARowAreWhatABuildMakes) {
    const RawClip raw = moving_clip(12, 17, 16, 2);
    expect_as_built(raw, Counts(16, 1));
    expect_as_built(raw, {3, 2, 1, 5, 4, 1});
    expect_as_built(raw, {8, 8});
    expect_as_built(raw, {1, 15});
    expect_as_built(raw, {15, 1});
    std::mt19937 random(3);
    for (int round = 0; round < 4; ++round) {
        Counts counts;
        for (std::size_t left = 16; left > 0;) {
            counts.push_back(1 + random() % std::min<std::size_t>(left, 6));
            left -= counts.back();
        }
        expect_as_built(raw, counts);
    }
}

TEST(Append, NoiseWithAlphaAndTinyPicturesAreWhatABuildMakes) {
    expect_as_built(random_clip(35, 18, 5, 4), {2, 3});
    expect_as_built(random_clip(9, 40, 7, 5), {4, 2, 1});
    expect_as_built(random_clip(1, 1, 6, 6), {1, 2, 3});
    expect_as_built(random_clip(3, 5, 6, 7), {3, 3});
    expect_as_built(random_clip(20, 20, 11, 8, true), {5, 1, 5});
}

// Frames 0 .. n of one picture, then of another: what is all the same has no siblings below.
TEST(Append, WhatStaysTheSameIsWhatABuildMakes) {
    const RawClip two = random_clip(12, 10, 2, 9);
    for (const std::size_t same : {1U, 2U, 3U, 4U, 6U, 8U}) {
        RawClip raw{two.format, std::vector<Picture>(same, two.frames[0])};
        raw.frames.resize(12, two.frames[1]);
        for (const std::size_t n : {1U, 2U, 4U, 5U, 8U, 11U})
            expect_as_built(raw, {n, 12 - n});
        expect_as_built(raw, {3, 3, 3, 3});
    }
    expect_as_built({two.format, std::vector<Picture>(7, two.frames[0])}, {3, 1, 3});
}

TEST(Append, TheTimelineAndChangesDrawnAreThoseOfABuild) {
    const RawClip raw = moving_clip(24, 24, 13, 10);
    const std::vector<std::byte> file = appended_bytes(raw, {5, 2, 6});
    const std::vector<std::byte> at_once = built_bytes(raw);
    const std::unique_ptr<MrvClip> clip = opened(file);
    const std::unique_ptr<MrvClip> built = opened(at_once);
    const Result<Timeline> found = timeline(*clip, 13, 5);
    const Result<Timeline> wanted = timeline(*built, 13, 5);
    ASSERT_TRUE(found.has_value() && wanted.has_value());
    EXPECT_EQ((*found).nodes_visited, (*wanted).nodes_visited);
    for (std::size_t b = 0; b < 13; ++b) {
        EXPECT_EQ((*found).buckets[b].changed, (*wanted).buckets[b].changed) << b;
        EXPECT_EQ((*found).buckets[b].squares, (*wanted).buckets[b].squares) << b;
    }
    // From one generation's frames to another's and back.
    IncrementalDisplay display(5, Edge::kPad, {0, 0, 24, 24});
    const int leaf = clip->shape().time_levels();
    for (const std::int64_t t : {0, 5, 4, 6, 12, 3, 7, 1, 0, 11, 2}) {
        (void)display.show(*clip->frame({leaf, t}, 5));
        EXPECT_EQ(display.picture(), exact_picture(raw, {leaf, t}, 5, Edge::kPad)) << t;
    }
}

TEST(Append, OldBytesStayAndFewTimeNodesAreWritten) {
    const RawClip raw = random_clip(16, 16, 33, 11);
    GrowingBytes file(built_bytes(part(raw, 0, 32)));
    const std::vector<std::byte> before = file.bytes();
    ASSERT_TRUE(append_to(file, part(raw, 32, 33)).has_value());
    EXPECT_TRUE(std::equal(before.begin() + kMrvHeaderBytes,
                           before.end(),
                           file.bytes().begin() + kMrvHeaderBytes));
    // The root and its halves, and the way to the one frame: one pair a level.
    const std::unique_ptr<MrvClip> clip = opened(file.bytes());
    EXPECT_EQ(clip->front().index.siblings(), 2U);
    ASSERT_TRUE(append_to(file, part(raw, 0, 1)).has_value());
    EXPECT_EQ(opened(file.bytes())->front().index.siblings(), 7U);
}

TEST(Append, AnAppendedClipBuiltAnewIsTheClipThatABuildMakes) {
    const RawClip raw = moving_clip(18, 18, 11, 12);
    const std::vector<std::byte> file = appended_bytes(raw, {3, 4, 4});
    const std::unique_ptr<MrvClip> clip = opened(file);
    const auto frames = range_frames(*clip, {0, 11});
    ASSERT_TRUE(frames.has_value());
    MemorySpool spool;
    MemoryClip::Sink sink;
    ASSERT_TRUE(build(**frames, spool, sink).has_value());
    expect_exact(raw, *sink.take());
}

TEST(Append, FramesOfAnotherFormatAreRefusedNamingBoth) {
    const RawClip raw = random_clip(16, 12, 2, 13);
    GrowingBytes file(built_bytes(raw));
    const auto refused = [&](RawClip more, const char* param, const char* text) {
        const Result<void> appended = append_to(file, more);
        ASSERT_FALSE(appended.has_value());
        EXPECT_EQ(appended.error().code, ErrorCode::kInvalidArgument);
        EXPECT_EQ(appended.error().param, param);
        EXPECT_EQ(appended.error().message, text);
    };
    refused(
        random_clip(17, 12, 1, 1), "width", "width of the frames is 17, of the clip 16");
    refused(random_clip(16, 11, 1, 1),
            "height",
            "height of the frames is 11, of the clip 12");
    RawClip faster = random_clip(16, 12, 1, 1);
    faster.format.rate = {30, 1};
    refused(faster, "rate", "rate of the frames is 30/1, of the clip 25/1");
    refused({raw.format, {}}, "frames", "the source has 0 frames");
    EXPECT_EQ(file.bytes(), built_bytes(raw));
    // The same pace in other words.
    faster.format.rate = {50, 2};
    EXPECT_TRUE(append_to(file, faster).has_value());
}

TEST(Append, AClipOfALossyBuildIsRefused) {
    const RawClip raw = random_clip(16, 16, 3, 14);
    RawSource source(raw);
    MemorySpool spool;
    MemoryClip::Sink sink;
    BuildOptions options;
    options.delta = kDifferenceOne * 5 / 2;
    ASSERT_TRUE(build(source, spool, sink, options).has_value());
    const std::unique_ptr<MemoryClip> lossy = sink.take();
    RawSource more(raw);
    const Result<ClipShape> appended = append(*lossy, more, spool, sink);
    ASSERT_FALSE(appended.has_value());
    EXPECT_EQ(appended.error().code, ErrorCode::kConflict);
    EXPECT_NE(appended.error().message.find("delta is 2.5,"), std::string::npos);
}

TEST(Append, ProgressCountsOldFramesAndCanStopAtEveryStep) {
    const RawClip raw = random_clip(10, 10, 7, 15);
    const std::vector<std::byte> file = built_bytes(part(raw, 0, 5));
    const std::unique_ptr<MrvClip> clip = opened(file);
    std::vector<std::pair<std::int64_t, std::int64_t>> told;
    const auto run = [&](std::size_t stop_at) {
        told.clear();
        RawSource more(raw);
        MemorySpool spool;
        MemoryClip::Sink sink;
        AppendOptions options;
        options.max_frames = 2;
        options.progress = [&](std::int64_t frames, std::int64_t nodes) {
            told.emplace_back(frames, nodes);
            return told.size() != stop_at;
        };
        return append(*clip, more, spool, sink, options);
    };
    const Result<ClipShape> shape = run(0);
    ASSERT_TRUE(shape.has_value());
    EXPECT_EQ((*shape).frames(), 7);
    EXPECT_EQ(told.front(), (std::pair<std::int64_t, std::int64_t>{1, 0}));
    const std::size_t steps = told.size();
    // The root, its halves, those of the second half, and frames 4 and 5.
    EXPECT_EQ(told.back(), (std::pair<std::int64_t, std::int64_t>{7, 1 + 2 + 2 + 2}));
    for (std::size_t stop = 1; stop <= steps; ++stop) {
        const Result<ClipShape> stopped = run(stop);
        ASSERT_FALSE(stopped.has_value()) << stop;
        EXPECT_EQ(stopped.error().code, ErrorCode::kUnavailable);
        EXPECT_EQ(told.size(), stop);
    }
}

TEST(Append, WhatTheOldClipTheSourceAndTheSpoolMeetIsPassedOn) {
    const RawClip raw = random_clip(10, 10, 5, 16);
    const std::vector<std::byte> file = built_bytes(part(raw, 0, 3));
    const std::unique_ptr<MrvClip> clip = opened(file);
    EXPECT_TRUE(passes_on_every_failure(*clip, [&](const TimeTree& old) {
        RawSource more(raw);
        MemorySpool spool;
        MemoryClip::Sink sink;
        return append(old, more, spool, sink);
    }));
    for (std::size_t call = 0; call <= 5; ++call) {
        RawSource more(raw);
        more.fail_at(call);
        MemorySpool spool;
        MemoryClip::Sink sink;
        const Result<ClipShape> failed = append(*clip, more, spool, sink);
        ASSERT_FALSE(failed.has_value());
        EXPECT_EQ(failed.error().code, ErrorCode::kUndecodable);
    }
    FaultySpool counting;
    RawSource more(raw);
    MemoryClip::Sink sink;
    ASSERT_TRUE(append(*clip, more, counting, sink).has_value());
    for (std::int64_t call = 0; call < counting.calls(); ++call) {
        FaultySpool faulty;
        faulty.fail_at(call);
        RawSource again(raw);
        const Result<ClipShape> failed = append(*clip, again, faulty, sink);
        ASSERT_FALSE(failed.has_value()) << call;
        EXPECT_EQ(failed.error().code, ErrorCode::kIo);
    }
}

}  // namespace
}  // namespace haarmony::video::testing
