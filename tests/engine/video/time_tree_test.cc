#include "engine/video/time_tree.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "engine/video/memory_clip.h"

namespace haarmony::video {
namespace {

// Siblings of seven frames of 32 x 32, stored only where `stored_` says; counts what is read.
class CountedTree final : public TimeTree {
  public:
    explicit CountedTree(std::vector<SiblingAddress> stored)
        : TimeTree(*ClipShape::make({32, 32, {25, 1}}, 7), 0),
          stored_(std::move(stored)) {}

    [[nodiscard]] bool stored(const SiblingAddress& address) const override {
        return std::find(stored_.begin(), stored_.end(), address) != stored_.end();
    }
    [[nodiscard]] Result<Frame::Nodes> nodes(
        const SiblingAddress& address) const override {
        if (nodes_fail) return Error{ErrorCode::kIo, "nodes"};
        SiblingNodes made;
        made.count = 2;
        for (int half = 0; half < 2; ++half) {
            made.node[static_cast<std::size_t>(half)].bounds.left =
                100 * address.time_level + 10 * static_cast<int>(address.index) + half;
        }
        return Frame::Nodes(std::make_shared<const SiblingNodes>(made));
    }
    [[nodiscard]] Result<Frame::LayerPtr> layer(const SiblingAddress& address,
                                                int space_level) const override {
        if (space_level == layer_that_fails) return Error{ErrorCode::kIo, "layer"};
        ++layers_read[{address.time_level, space_level}];
        Layer made;
        made.nodes.resize(2);
        const auto mark = static_cast<std::uint8_t>(64 * address.time_level +
                                                    8 * address.index + space_level);
        Brick brick{};
        made.bricks.push_back(brick);
        brick.fill({mark, 0, 0, 255});
        made.bricks.push_back(brick);
        made.nodes[1].brick = make_ref(address.time_level, mark);
        return Frame::LayerPtr(std::make_shared<const Layer>(std::move(made)));
    }

    mutable std::map<std::pair<int, int>, int> layers_read;
    bool nodes_fail = false;
    int layer_that_fails = -1;

  private:
    std::vector<SiblingAddress> stored_;
};

const std::vector<SiblingAddress> kAll =
    {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {3, 0}, {3, 1}, {3, 2}, {3, 3}};

TEST(TimeTree, AFrameNeedsTheLayersOfItsAncestorsAndNoOthers) {
    const CountedTree tree(kAll);
    const Result<Frame> frame = tree.frame({3, 5}, 4);
    ASSERT_TRUE(frame.has_value());
    const std::map<std::pair<int, int>, int> expected = {{{0, 3}, 1},
                                                         {{0, 4}, 1},
                                                         {{1, 3}, 1},
                                                         {{1, 4}, 1},
                                                         {{2, 3}, 1},
                                                         {{2, 4}, 1},
                                                         {{3, 3}, 1},
                                                         {{3, 4}, 1}};
    EXPECT_EQ(tree.layers_read, expected);
    EXPECT_EQ((*frame).asked(), (NodeAddress{3, 5}));
    EXPECT_EQ((*frame).stored(), (NodeAddress{3, 5}));
    EXPECT_EQ((*frame).space_level(), 4);
    // The second of the siblings (3, 2).
    EXPECT_EQ((*frame).time_node().bounds.left, 321);
}

TEST(TimeTree, RefsLeadToTheirTimeLevelsLayers) {
    const CountedTree tree(kAll);
    const Result<Frame> frame = tree.frame({3, 5}, 5);
    ASSERT_TRUE(frame.has_value());
    for (int k = 0; k <= 3; ++k) {
        const std::int64_t siblings = k == 0 ? 0 : 5 >> (4 - k);
        for (int level = kBrickLevel; level <= 5; ++level) {
            const auto mark = static_cast<std::uint8_t>(64 * k + 8 * siblings + level);
            EXPECT_EQ((*frame).brick(level, make_ref(k, 1))[0].r, mark);
            EXPECT_EQ((*frame).node(level, make_ref(k, 1)).brick, make_ref(k, mark));
            EXPECT_EQ((*frame).brick(level, make_ref(k, 0))[0], kClear);
        }
    }
}

TEST(TimeTree, WhereNothingFinerIsStoredTheAncestorIsShown) {
    const CountedTree tree({{0, 0}, {1, 0}, {2, 1}});
    Result<Frame> frame = tree.frame({3, 6}, 3);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ((*frame).asked(), (NodeAddress{3, 6}));
    EXPECT_EQ((*frame).stored(), (NodeAddress{2, 3}));
    EXPECT_EQ((*frame).time_node().bounds.left, 211);
    frame = tree.frame({3, 1}, 3);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ((*frame).stored(), (NodeAddress{1, 0}));
    EXPECT_EQ((*frame).time_node().bounds.left, 100);
    EXPECT_TRUE(tree.finer_in_time({0, 0}));
    EXPECT_FALSE(tree.finer_in_time({1, 0}));
    EXPECT_TRUE(tree.finer_in_time({1, 1}));
    EXPECT_FALSE(tree.finer_in_time({2, 3}));
    EXPECT_FALSE(tree.finer_in_time({3, 6}));
}

TEST(TimeTree, CoarseLevelsNeedNoLayerAtAll) {
    const CountedTree tree(kAll);
    for (int level = 0; level < kBrickLevel; ++level) {
        const Result<Frame> frame = tree.frame({2, 1}, level);
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ((*frame).time_node().bounds.left, 201);
    }
    EXPECT_TRUE(tree.layers_read.empty());
}

TEST(TimeTree, TheTimeParentOfAFrameHasTheSameLayersAndReadsNone) {
    const CountedTree tree(kAll);
    const Result<Frame> frame = tree.frame({3, 5}, 4);
    ASSERT_TRUE(frame.has_value());
    const auto read = tree.layers_read;
    const Result<Frame> parent = tree.above(*frame);
    ASSERT_TRUE(parent.has_value());
    EXPECT_EQ(tree.layers_read, read);
    EXPECT_EQ((*parent).stored(), (NodeAddress{2, 2}));
    EXPECT_EQ((*parent).time_node().bounds.left, 210);
    EXPECT_EQ((*parent).depth(), 2);
    for (int k = 0; k <= 2; ++k)
        EXPECT_EQ(&(*parent).layer(k, 4), &(*frame).layer(k, 4)) << k;
}

TEST(TimeTree, FramesShareTheLayersThatBothHold) {
    const CountedTree tree(kAll);
    const Result<Frame> frame = tree.frame({3, 5}, 4);
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(Frame::last_shared_level(*frame, *frame), 3);
    EXPECT_EQ(Frame::last_shared_level(*frame, *tree.above(*frame)), 2);
    // The tree makes new layers each time that it is asked.
    EXPECT_EQ(Frame::last_shared_level(*frame, *tree.frame({3, 5}, 4)), -1);
}

TEST(TimeTree, PassesOnWhatTheStorageMeets) {
    CountedTree tree(kAll);
    tree.layer_that_fails = 4;
    Result<Frame> frame = tree.frame({2, 1}, 4);
    ASSERT_FALSE(frame.has_value());
    EXPECT_EQ(frame.error().message, "layer");
    EXPECT_TRUE(tree.frame({2, 1}, 3).has_value());
    tree.nodes_fail = true;
    frame = tree.frame({2, 1}, 3);
    ASSERT_FALSE(frame.has_value());
    EXPECT_EQ(frame.error().message, "nodes");
}

}  // namespace
}  // namespace haarmony::video
