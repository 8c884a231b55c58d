#include "engine/video/build.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/video/memory_clip.h"
#include "tests/engine/video/faulty_spool.h"
#include "tests/engine/video/plain_draw.h"
#include "tests/engine/video/raw_source.h"

namespace haarmony::video {
namespace {

using testing::exact_picture;
using testing::FaultySpool;
using testing::random_clip;
using testing::RawClip;
using testing::RawSource;
using testing::shown_picture;

std::unique_ptr<MemoryClip> built(const RawClip& clip, const BuildOptions& options = {}) {
    RawSource source(clip);
    MemorySpool spool;
    MemoryClip::Sink sink;
    EXPECT_TRUE(build(source, spool, sink, options).has_value());
    return sink.take();
}

// Every picture of every address is what the definition says.
void expect_exact(const RawClip& raw, const TimeTree& clip) {
    const ClipShape& shape = clip.shape();
    ASSERT_EQ(shape, shape_of(raw));
    for (int k = 0; k <= shape.time_levels(); ++k) {
        for (std::int64_t i = 0; i < shape.nodes_at(k); ++i) {
            const Result<Frame> frame = clip.frame({k, i}, shape.space_levels());
            ASSERT_TRUE(frame.has_value());
            for (int level = 0; level <= shape.space_levels(); ++level) {
                for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
                    ASSERT_EQ(shown_picture(*frame, level, edge),
                              exact_picture(raw, {k, i}, level, edge))
                        << raw.format.width << "x" << raw.format.height << " node " << k
                        << "/" << i << " level " << level;
                }
            }
        }
    }
}

std::size_t own_bricks(const MemoryClip& clip) {
    std::size_t bricks = 0;
    for (int k = 0; k <= clip.shape().time_levels(); ++k) {
        for (std::int64_t i = 0; i < (k == 0 ? 1 : clip.shape().nodes_at(k - 1)); ++i) {
            if (!clip.stored({k, i})) continue;
            for (int level = kBrickLevel; level <= clip.shape().space_levels(); ++level) {
                bricks += (*clip.layer({k, i}, level))->bricks.size();
            }
        }
    }
    return bricks;
}

TEST(Build, EveryPictureIsExact) {
    std::uint32_t seed = 1;
    for (const auto& [width, height] : std::vector<std::pair<int, int>>{
             {1, 1}, {2, 3}, {5, 4}, {8, 8}, {9, 3}, {16, 16}, {21, 37}}) {
        for (const bool coherent : {false, true}) {
            for (int frames = 1; frames <= 9; ++frames) {
                if (width > 16 && frames > 6) continue;
                const RawClip raw = random_clip(width, height, frames, ++seed, coherent);
                expect_exact(raw, *built(raw));
            }
        }
    }
}

TEST(Build, WhatDoesNotChangeIsStoredOnce) {
    const RawClip coherent = random_clip(32, 32, 8, 50, true);
    const RawClip incoherent = random_clip(32, 32, 8, 50, false);
    // All fifteen time nodes of noise are different: 21 bricks each. A corner of 8 x 8 is a
    // brick, and one above it, at each level.
    EXPECT_EQ(own_bricks(*built(incoherent)), 15U * 21);
    EXPECT_EQ(own_bricks(*built(coherent)), 21U + 14 * 3);
}

TEST(Build, FramesThatStayHaveNothingFinerInTime) {
    RawClip raw = random_clip(16, 16, 2, 51);
    raw.frames = {raw.frames[0],
                  raw.frames[0],
                  raw.frames[0],
                  raw.frames[0],
                  raw.frames[1],
                  raw.frames[0],
                  raw.frames[1],
                  raw.frames[1]};
    const std::unique_ptr<MemoryClip> clip = built(raw);
    expect_exact(raw, *clip);
    EXPECT_TRUE(clip->finer_in_time({0, 0}));
    EXPECT_FALSE(clip->finer_in_time({1, 0}));
    EXPECT_TRUE(clip->finer_in_time({1, 1}));
    EXPECT_TRUE(clip->finer_in_time({2, 2}));
    EXPECT_FALSE(clip->finer_in_time({2, 3}));
    EXPECT_FALSE(clip->stored({2, 0}));
    EXPECT_FALSE(clip->stored({3, 3}));
}

TEST(Build, RepeatsAreFrames) {
    RawClip raw = random_clip(13, 9, 3, 52);
    RawSource source(raw);
    source.set_repeats({3, 1, 5});
    MemorySpool spool;
    MemoryClip::Sink sink;
    const Result<ClipShape> shape = build(source, spool, sink, {});
    ASSERT_TRUE(shape.has_value());
    EXPECT_EQ((*shape).frames(), 9);
    const std::vector<Picture> three = raw.frames;
    raw.frames = {three[0],
                  three[0],
                  three[0],
                  three[1],
                  three[2],
                  three[2],
                  three[2],
                  three[2],
                  three[2]};
    expect_exact(raw, *sink.take());
}

TEST(Build, NoMoreThanMaxFramesAreRead) {
    RawClip raw = random_clip(8, 8, 6, 53);
    for (const std::int64_t most : {1, 4, 6, 9}) {
        BuildOptions options;
        options.max_frames = most;
        RawClip first = raw;
        first.frames.resize(static_cast<std::size_t>(std::min<std::int64_t>(most, 6)));
        expect_exact(first, *built(raw, options));
    }
    // Also in the middle of a frame that stays.
    RawSource source(raw);
    source.set_repeats({2, 1000, 1, 1, 1, 1});
    MemorySpool spool;
    MemoryClip::Sink sink;
    BuildOptions options;
    options.max_frames = 5;
    ASSERT_TRUE(build(source, spool, sink, options).has_value());
    const std::vector<Picture> all = raw.frames;
    raw.frames = {all[0], all[0], all[1], all[1], all[1]};
    expect_exact(raw, *sink.take());
}

TEST(Build, TheSameSourceGivesTheSameClip) {
    const RawClip raw = random_clip(21, 37, 7, 54, true);
    for (const std::uint32_t delta : {0U, 8 * kDifferenceOne}) {
        BuildOptions options;
        options.delta = delta;
        const std::unique_ptr<MemoryClip> one = built(raw, options);
        const std::unique_ptr<MemoryClip> two = built(raw, options);
        for (int k = 0; k <= one->shape().time_levels(); ++k) {
            for (std::int64_t i = 0; i < (k == 0 ? 1 : one->shape().nodes_at(k - 1));
                 ++i) {
                ASSERT_EQ(one->stored({k, i}), two->stored({k, i}));
                if (!one->stored({k, i})) continue;
                EXPECT_EQ(**one->nodes({k, i}), **two->nodes({k, i}));
                for (int level = kBrickLevel; level <= one->shape().space_levels();
                     ++level) {
                    EXPECT_EQ(**one->layer({k, i}, level), **two->layer({k, i}, level));
                }
            }
        }
    }
}

TEST(Build, ProgressCountsFramesAndThenTimeNodes) {
    const RawClip raw = random_clip(8, 8, 5, 55);
    std::vector<std::pair<std::int64_t, std::int64_t>> told;
    BuildOptions options;
    options.progress = [&told](std::int64_t frames, std::int64_t nodes) {
        told.emplace_back(frames, nodes);
        return true;
    };
    (void)built(raw, options);
    // Frame 5 is alone below its three ancestors: none of its four siblings is stored twice.
    const std::vector<std::pair<std::int64_t, std::int64_t>> expected = {
        {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {5, 1}, {5, 3}, {5, 5}, {5, 7}, {5, 9}};
    EXPECT_EQ(told, expected);
}

TEST(Build, ProgressCanStopItAtEveryStep) {
    const RawClip raw = random_clip(8, 8, 5, 56);
    for (int stop = 0; stop < 10; ++stop) {
        RawSource source(raw);
        MemorySpool spool;
        MemoryClip::Sink sink;
        BuildOptions options;
        int calls = 0;
        options.progress = [&](std::int64_t, std::int64_t) { return calls++ != stop; };
        const Result<ClipShape> shape = build(source, spool, sink, options);
        ASSERT_FALSE(shape.has_value()) << stop;
        EXPECT_EQ(shape.error().code, ErrorCode::kUnavailable);
        EXPECT_EQ(calls, stop + 1);
        EXPECT_NE(shape.error().message.find(stop < 5 ? std::to_string(stop + 1) + " fr"
                                                      : "5 frames"),
                  std::string::npos)
            << shape.error().message;
    }
}

TEST(Build, NoFrameIsNoClip) {
    RawClip raw;
    raw.format = {8, 8, {25, 1}};
    RawSource source(raw);
    MemorySpool spool;
    MemoryClip::Sink sink;
    const Result<ClipShape> shape = build(source, spool, sink, {});
    ASSERT_FALSE(shape.has_value());
    EXPECT_EQ(shape.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(shape.error().param, "frames");
}

TEST(Build, AFormatOutsideTheLimitsIsRefusedBeforeAnythingIsRead) {
    RawClip raw;
    raw.format = {kMaxSide + 1, 8, {25, 1}};
    RawSource source(raw);
    source.fail_at(0);
    MemorySpool spool;
    MemoryClip::Sink sink;
    const Result<ClipShape> shape = build(source, spool, sink, {});
    ASSERT_FALSE(shape.has_value());
    EXPECT_EQ(shape.error().param, "width");
}

TEST(Build, MoreFramesThanAClipCanHaveAreRefused) {
    const RawClip raw = random_clip(8, 8, 2, 57);
    RawSource source(raw);
    source.set_repeats({std::int64_t{1} << kMaxTimeLevels, 1});
    MemorySpool spool;
    MemoryClip::Sink sink;
    const Result<ClipShape> shape = build(source, spool, sink, {});
    ASSERT_FALSE(shape.has_value());
    EXPECT_EQ(shape.error().param, "frames");
    EXPECT_NE(shape.error().message.find("1073741825"), std::string::npos);
}

TEST(Build, PassesOnWhatTheSourceMeetsAtEveryFrame) {
    const RawClip raw = random_clip(8, 8, 5, 58);
    for (std::size_t call = 0; call <= 5; ++call) {
        RawSource source(raw);
        source.fail_at(call);
        MemorySpool spool;
        MemoryClip::Sink sink;
        const Result<ClipShape> shape = build(source, spool, sink, {});
        ASSERT_FALSE(shape.has_value());
        EXPECT_EQ(shape.error().message, "frame " + std::to_string(call));
    }
}

TEST(Build, PassesOnWhatTheSpoolMeetsAtEveryCall) {
    const RawClip raw = random_clip(8, 8, 5, 59);
    const auto run = [&raw](FaultySpool& spool) {
        RawSource source(raw);
        MemoryClip::Sink sink;
        return build(source, spool, sink, {});
    };
    FaultySpool sound;
    ASSERT_TRUE(run(sound).has_value());
    // Nine time nodes are put in, each in three pieces, and read once.
    ASSERT_EQ(sound.appends(), 3 * 9);
    ASSERT_EQ(sound.calls(), 2 * 3 * 9);
    for (std::int64_t call = 0; call < sound.calls(); ++call) {
        FaultySpool faulty;
        faulty.fail_at(call);
        const Result<ClipShape> shape = run(faulty);
        ASSERT_FALSE(shape.has_value()) << call;
        EXPECT_EQ(shape.error().message, "call " + std::to_string(call));
    }
}

// Fails at the step it is told to: begin, every add, finish.
class FaultySink final : public ClipSink {
  public:
    explicit FaultySink(int fail_at) : fail_at_(fail_at) {}
    [[nodiscard]] Result<void> begin(const ClipShape&, std::uint32_t) override {
        return step();
    }
    [[nodiscard]] Result<void> add(Siblings) override { return step(); }
    [[nodiscard]] Result<void> finish() override { return step(); }
    [[nodiscard]] int steps() const { return steps_; }

  private:
    Result<void> step() {
        if (steps_++ == fail_at_) return Error{ErrorCode::kIo, "step"};
        return {};
    }
    int fail_at_;
    int steps_ = 0;
};

TEST(Build, PassesOnWhatTheSinkMeetsAtEveryStep) {
    const RawClip raw = random_clip(8, 8, 5, 60);
    FaultySink sound(-1);
    {
        RawSource source(raw);
        MemorySpool spool;
        ASSERT_TRUE(build(source, spool, sound, {}).has_value());
    }
    ASSERT_EQ(sound.steps(), 1 + 5 + 1);
    for (int step = 0; step < sound.steps(); ++step) {
        RawSource source(raw);
        MemorySpool spool;
        FaultySink sink(step);
        const Result<ClipShape> shape = build(source, spool, sink, {});
        ASSERT_FALSE(shape.has_value()) << step;
        EXPECT_EQ(shape.error().message, "step");
        EXPECT_EQ(sink.steps(), step + 1);
    }
}

}  // namespace
}  // namespace haarmony::video
