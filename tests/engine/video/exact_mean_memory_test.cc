// What frames and their means take from the heap: counted, byte by byte.
#include <gtest/gtest.h>

#include <vector>

#include "engine/video/create_frame.h"
#include "engine/video/exact_mean.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"
#include "tests/support/allocated_bytes.h"

namespace haarmony::video::testing {
namespace {

// Two frames make one mean, as in a build.
struct Round {
    explicit Round(const FrameFormat& format) : one(format), two(format) {}

    void run(const RawClip& clip) {
        two.clear();
        for (const Picture& frame : clip.frames) {
            create_frame(frame.view(), tree);
            one.clear();
            one.add(tree, 1);
            one.mean_into(mean);
            two.add(one);
        }
        two.mean_into(mean);
    }

    FrameSum one, two;
    ImageTree tree;
    ExactFrame mean;
};

TEST(ExactMeanMemory, NothingIsAllocatedOnceStorageIsThere) {
    for (const bool coherent : {false, true}) {
        const RawClip clip = random_clip(200, 120, 2, 5, coherent);
        Round round(clip.format);
        round.run(clip);
        const std::int64_t before = test::allocated_bytes();
        test::watch_allocated_bytes();
        round.run(clip);
        EXPECT_EQ(test::most_allocated_bytes(), before);
        EXPECT_EQ(test::allocated_bytes(), before);
    }
}

// A clip of natural pictures pays 6 bytes a pixel for sums of opaque frames, and a node of 24
// bytes and its ancestors for each 64 pixels; vectors grow to twice what they hold.
TEST(ExactMeanMemory, ADenseOpaqueSumTakesAFewBytesAPixel) {
    RawClip clip = random_clip(512, 512, 1, 6);
    for (Rgba& pixel : clip.frames[0].pixels) pixel.a = 255;
    ImageTree tree;
    create_frame(clip.frames[0].view(), tree);
    const std::int64_t before = test::allocated_bytes();
    FrameSum sum(clip.format);
    sum.add(tree, 1);
    constexpr std::int64_t kPixels = 512 * 512;
    EXPECT_LE(test::allocated_bytes() - before, 2 * kPixels * (6 + 4.0 / 3 * 24 / 64));
}

}  // namespace
}  // namespace haarmony::video::testing
