// Builds at delta > 0: the bound, and that it buys something.
#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "engine/video/build.h"
#include "engine/video/memory_clip.h"
#include "tests/engine/video/raw_source.h"
#include "tests/engine/video/worst_difference.h"

namespace haarmony::video {
namespace {

using testing::plain_clip;
using testing::random_clip;
using testing::RawClip;
using testing::RawSource;
using testing::worst_difference;

std::unique_ptr<MemoryClip> built(const RawClip& clip, std::uint32_t delta) {
    RawSource source(clip);
    MemorySpool spool;
    MemoryClip::Sink sink;
    BuildOptions options;
    options.delta = delta;
    EXPECT_TRUE(build(source, spool, sink, options).has_value());
    return sink.take();
}

// A slope with noise that moves by a pixel a frame, half of it fading out.
RawClip drifting(int width, int height, int frames, std::uint32_t seed) {
    std::mt19937 random(seed);
    RawClip clip;
    clip.format = {width, height, {25, 1}};
    for (int t = 0; t < frames; ++t) {
        Picture frame(width, height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto value =
                    static_cast<std::uint8_t>(40 + (x + t) * 2 + random() % 4);
                const auto alpha =
                    static_cast<std::uint8_t>(x < width / 2 ? 255 : 255 - 2 * y - t);
                frame.at(x, y) = {value, static_cast<std::uint8_t>(3 * y), value, alpha};
            }
        }
        clip.frames.push_back(frame);
    }
    return clip;
}

TEST(BuildBound, EveryPixelOfEveryPictureIsWithinDelta) {
    const std::vector<RawClip> clips = {drifting(32, 32, 8, 1),
                                        drifting(21, 37, 5, 2),
                                        random_clip(32, 20, 5, 3, true),
                                        random_clip(5, 3, 4, 4),
                                        drifting(40, 9, 7, 5)};
    for (const RawClip& raw : clips) {
        const std::unique_ptr<MemoryClip> exact = plain_clip(raw);
        std::uint64_t last = built(raw, 0)->memory_bytes();
        for (const std::uint32_t levels : {1U, 2U, 4U, 8U, 16U, 64U}) {
            const std::uint32_t delta = levels * kDifferenceOne;
            const std::unique_ptr<MemoryClip> clip = built(raw, delta);
            EXPECT_EQ(clip->delta(), delta);
            EXPECT_LE(worst_difference(*exact, *clip).anywhere(), delta) << levels;
            EXPECT_LE(clip->memory_bytes(), last) << levels;
            last = clip->memory_bytes();
        }
        EXPECT_LT(last, exact->memory_bytes());
    }
}

TEST(BuildBound, ErrorsDoNotAddUpAlongAChainOfLinks) {
    // Each frame is two levels lighter than the one before: every node could be linked to the
    // one above it, and the last frame so to the root, 15 levels away.
    RawClip raw;
    raw.format = {8, 8, {25, 1}};
    for (int t = 0; t < 16; ++t) {
        Picture frame(8, 8);
        for (std::size_t p = 0; p < frame.pixels.size(); ++p) {
            const auto value = static_cast<std::uint8_t>(100 + 2 * t + p % 3);
            frame.pixels[p] = {value, value, value, 255};
        }
        raw.frames.push_back(frame);
    }
    const std::unique_ptr<MemoryClip> exact = plain_clip(raw);
    for (const std::uint32_t levels : {1U, 2U, 4U, 9U}) {
        EXPECT_LE(
            worst_difference(*exact, *built(raw, levels * kDifferenceOne)).anywhere(),
            levels * kDifferenceOne);
    }
}

TEST(BuildBound, ErrorsDoNotAddUpOverPrunedLevels) {
    // A dyadic ramp, each level of which is within delta of the one above.
    RawClip raw;
    raw.format = {64, 64, {25, 1}};
    Picture frame(64, 64);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto value = static_cast<std::uint8_t>(3 * x);
            frame.at(x, y) = {value, value, value, 255};
        }
    }
    raw.frames.push_back(frame);
    const std::unique_ptr<MemoryClip> exact = plain_clip(raw);
    for (const std::uint32_t levels : {2U, 3U, 6U, 12U}) {
        const std::unique_ptr<MemoryClip> clip = built(raw, levels * kDifferenceOne);
        EXPECT_LE(worst_difference(*exact, *clip).anywhere(), levels * kDifferenceOne);
    }
}

TEST(BuildBound, DeltaZeroIsExact) {
    const RawClip raw = drifting(19, 33, 5, 6);
    EXPECT_EQ(worst_difference(*plain_clip(raw), *built(raw, 0)).anywhere(), 0U);
}

}  // namespace
}  // namespace haarmony::video
