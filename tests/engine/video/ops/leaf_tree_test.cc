// Frames of a clip as trees, against the pictures that they show.
#include "engine/video/ops/leaf_tree.h"

#include <gtest/gtest.h>

#include "engine/video/ops/tree_picture.h"
#include "tests/engine/video/plain_clip.h"
#include "tests/engine/video/tree_pixels.h"

namespace haarmony::video {
namespace {

using testing::exact_picture;
using testing::RawClip;

TEST(LeafTree, ShowsTheFrameAtEverySpaceLevel) {
    for (const auto& [width, height] : {std::pair{37, 23}, {3, 2}, {1, 1}, {8, 9}}) {
        const RawClip raw = testing::random_clip(width, height, 3, 5);
        const auto clip = testing::plain_clip(raw);
        const ClipShape& shape = clip->shape();
        for (int level = 0; level <= shape.space_levels(); ++level) {
            for (const NodeAddress at : {NodeAddress{0, 0}, {1, 1}, {2, 1}}) {
                ImageTree tree;
                const Visited visited = leaf_tree(*clip->frame(at, level), tree);
                EXPECT_EQ(visited.read, static_cast<std::int64_t>(tree.nodes.size()));
                const FrameFormat format{
                    shape.width_at(level), shape.height_at(level), shape.rate()};
                const Picture want = exact_picture(raw, at, level, Edge::kPad);
                EXPECT_EQ(testing::picture_of(tree, format), want)
                    << width << " " << level;
                EXPECT_EQ(tree_picture(tree, format), want) << width << " " << level;
            }
        }
    }
}

}  // namespace
}  // namespace haarmony::video
