#include "server/app/leaf_frames.h"

#include <gtest/gtest.h>

#include <vector>

namespace haarmony::server {
namespace {

const video::FrameFormat kFormat{8, 8, {25, 1}};

std::vector<std::byte> two_frames() {
    std::vector<std::byte> bytes;
    append_leaf_frame(std::vector<video::LeafSquare>{{1, 1, 0, {1, 2, 3, 4}},
                                                     {3, 7, 7, {250, 251, 252, 253}}},
                      3,
                      bytes);
    append_leaf_frame({}, 1, bytes);
    return bytes;
}

TEST(LeafFrames, ComeBackAsTheFramesThatTheyStandFor) {
    const auto bytes = two_frames();
    LeafFrames frames(bytes, kFormat);
    video::SourceFrame frame;
    ASSERT_TRUE(*frames.next(frame));
    EXPECT_EQ(frame.repeats, 3);
    video::ImageTree want;
    ASSERT_TRUE(video::create_frame(
        std::vector<video::LeafSquare>{{1, 1, 0, {1, 2, 3, 4}},
                                       {3, 7, 7, {250, 251, 252, 253}}},
        kFormat,
        want));
    EXPECT_EQ(frame.tree.nodes, want.nodes);
    EXPECT_EQ(frame.tree.bricks, want.bricks);
    ASSERT_TRUE(*frames.next(frame));
    EXPECT_EQ(frame.repeats, 1);
    EXPECT_FALSE(*frames.next(frame));
}

TEST(LeafFrames, ThatAreCutOffAnywhereAreAnError) {
    const auto bytes = two_frames();
    constexpr std::size_t kFirst = 12 + 2 * 16;
    for (std::size_t size = 1; size < bytes.size(); ++size) {
        if (size == kFirst) continue;
        LeafFrames frames(std::span<const std::byte>(bytes).first(size), kFormat);
        video::SourceFrame frame;
        Result<bool> next = frames.next(frame);
        if (size > kFirst) {
            ASSERT_TRUE(next);
            next = frames.next(frame);
        }
        ASSERT_FALSE(next) << size;
        EXPECT_EQ(next.error().code, ErrorCode::kIo);
    }
}

TEST(LeafFrames, ThatNoFrameCanHaveNameTheFrame) {
    std::vector<std::byte> bytes;
    append_leaf_frame({}, 1, bytes);
    append_leaf_frame(
        std::vector<video::LeafSquare>{{1, 0, 0, {}}, {1, 0, 0, {}}}, 1, bytes);
    LeafFrames frames(bytes, kFormat);
    video::SourceFrame frame;
    ASSERT_TRUE(frames.next(frame));
    const auto next = frames.next(frame);
    ASSERT_FALSE(next);
    EXPECT_EQ(next.error().param, "frames");
    EXPECT_TRUE(next.error().message.starts_with("frames[1]: ")) << next.error().message;
}

}  // namespace
}  // namespace haarmony::server
