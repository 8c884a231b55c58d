#include "engine/video/memory_clip.h"

#include <gtest/gtest.h>

namespace haarmony::video {
namespace {

Siblings siblings(int time_level, std::int64_t index, std::uint8_t red) {
    Siblings made;
    made.address = {time_level, index};
    made.nodes.count = time_level == 0 ? 1 : 2;
    made.layers.resize(2);
    for (Layer& layer : made.layers) {
        // Room for more than there is, which the clip does not keep.
        layer.nodes.reserve(100);
        layer.bricks.reserve(100);
        layer.nodes.resize(3);
        Brick brick;
        brick.fill({red, 0, 0, 255});
        layer.bricks.push_back(brick);
    }
    return made;
}

ClipShape shape() { return *ClipShape::make({16, 16, {25, 1}}, 4); }

TEST(MemoryClip, HoldsWhatItWasGiven) {
    MemoryClip::Sink sink;
    ASSERT_TRUE(sink.begin(shape(), 7).has_value());
    ASSERT_TRUE(sink.add(siblings(0, 0, 1)).has_value());
    ASSERT_TRUE(sink.add(siblings(1, 0, 2)).has_value());
    ASSERT_TRUE(sink.add(siblings(2, 1, 3)).has_value());
    ASSERT_TRUE(sink.finish().has_value());
    const std::unique_ptr<MemoryClip> clip = sink.take();
    ASSERT_NE(clip, nullptr);
    EXPECT_EQ(clip->shape(), shape());
    EXPECT_EQ(clip->delta(), 7U);
    EXPECT_TRUE(clip->stored({0, 0}));
    EXPECT_TRUE(clip->stored({2, 1}));
    EXPECT_FALSE(clip->stored({2, 0}));
    EXPECT_FALSE(clip->stored({1, 1}));
    for (const auto& [address, red] :
         std::vector<std::pair<SiblingAddress, std::uint8_t>>{
             {{0, 0}, 1}, {{1, 0}, 2}, {{2, 1}, 3}}) {
        const Siblings want = siblings(address.time_level, address.index, red);
        EXPECT_EQ(**clip->nodes(address), want.nodes);
        EXPECT_EQ(**clip->layer(address, 3), want.layers[0]);
        EXPECT_EQ(**clip->layer(address, 4), want.layers[1]);
    }
}

TEST(MemoryClip, CountsItsNodesBricksAndTimeNodes) {
    MemoryClip::Sink sink;
    ASSERT_TRUE(sink.begin(shape(), 0).has_value());
    ASSERT_TRUE(sink.add(siblings(0, 0, 1)).has_value());
    ASSERT_TRUE(sink.add(siblings(1, 0, 2)).has_value());
    ASSERT_TRUE(sink.finish().has_value());
    EXPECT_EQ(sink.take()->memory_bytes(),
              3 * sizeof(TimeNode) + 4 * (3 * sizeof(Ref) + 3 * kBrickPixels));
}

TEST(MemoryClip, AFrameOutlivesTheClip) {
    MemoryClip::Sink sink;
    ASSERT_TRUE(sink.begin(shape(), 0).has_value());
    Siblings root = siblings(0, 0, 9);
    root.nodes.node[0].root = {make_ref(0, 0), make_ref(0, 0)};
    root.layers[0].nodes[0].brick = make_ref(0, 0);
    ASSERT_TRUE(sink.add(std::move(root)).has_value());
    ASSERT_TRUE(sink.finish().has_value());
    std::unique_ptr<MemoryClip> clip = sink.take();
    const Result<Frame> frame = clip->frame({0, 0}, 4);
    ASSERT_TRUE(frame.has_value());
    clip.reset();
    const LinkedNode& node = (*frame).node(3, (*frame).root(Edge::kPad));
    EXPECT_EQ((*frame).brick(3, node.brick)[63], (Rgba{9, 0, 0, 255}));
}

}  // namespace
}  // namespace haarmony::video
