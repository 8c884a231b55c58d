// Drawing takes no memory of its own: beside a test of its own program, since that counts
// all that is allocated.
#include <gtest/gtest.h>

#include "engine/video/display.h"
#include "engine/video/incremental_display.h"
#include "tests/engine/video/linked_clip.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/support/allocated_bytes.h"

namespace haarmony::video {
namespace {

TEST(DisplayMemory, DrawingIntoABufferAllocatesNothing) {
    const auto clip = testing::linked_clip(testing::moving_clip(45, 30, 4, 1));
    const Frame frame = *clip->frame({2, 1}, 6), next = *clip->frame({2, 2}, 6);
    Picture canvas(45, 30);
    const std::int64_t before = test::allocated_bytes();
    test::watch_allocated_bytes();
    for (int level = 0; level <= 6; ++level) {
        for (const Edge edge : {Edge::kPad, Edge::kNormalize}) {
            const ClipShape& shape = clip->shape();
            const PixelBox box{0, 0, shape.width_at(level), shape.height_at(level)};
            draw(frame, level, edge, box, canvas.pixels.data(), 45);
            draw_changes(frame, next, level, edge, box, canvas.pixels.data(), 45);
        }
    }
    EXPECT_EQ(test::most_allocated_bytes(), before);
    EXPECT_EQ(test::allocated_bytes(), before);
    // What is counted at all is counted.
    const Picture drawn = draw(frame, 6, Edge::kPad);
    EXPECT_GE(test::most_allocated_bytes(), before + 45 * 30 * 4);
}

}  // namespace
}  // namespace haarmony::video
