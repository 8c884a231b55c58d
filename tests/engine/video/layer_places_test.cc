// Places in a hand-made tree, and in random ones against a walk from every pixel's side.
#include "engine/video/layer_places.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/engine/video/random_links.h"

namespace haarmony::video::testing {
namespace {

LinkedNode leaf(Ref brick) {
    LinkedNode node;
    node.brick = brick;
    return node;
}

void add_two(Bricks& bricks) {
    for (int i = 0; i < 2; ++i) bricks.push_back(Brick{});
}

// A root of two levels and a second half that shares the first's left side.
struct TwoHalves {
    std::vector<Layer> top{2};
    std::vector<Layer> own{2};
    SiblingNodes top_nodes;
    SiblingNodes nodes;

    TwoHalves() {
        top[0].nodes = {{make_ref(0, 0),
                         {make_ref(0, 0), kNoDetailRef, kNoDetailRef, make_ref(0, 1)}}};
        top[1].nodes = {leaf(make_ref(0, 0)), leaf(make_ref(0, 1))};
        for (Layer& layer : top) add_two(layer.bricks);
        own[0].nodes = {{make_ref(1, 0),
                         {make_ref(1, 0), make_ref(1, 1), make_ref(0, 0), kNoDetailRef}},
                        {make_ref(1, 1),
                         {make_ref(1, 0), make_ref(1, 2), kNoDetailRef, make_ref(1, 2)}}};
        own[1].nodes.resize(4, leaf(make_ref(0, 0)));
        for (Layer& layer : own) add_two(layer.bricks);
        top_nodes.count = 1;
        top_nodes.node[0].root = {make_ref(0, 0), make_ref(0, 0)};
        nodes.count = 2;
        nodes.node[0].root = {make_ref(1, 0), make_ref(1, 0)};
        nodes.node[1].root = {make_ref(1, 1), make_ref(1, 1)};
    }

    [[nodiscard]] LayerSurroundings at(int level) const {
        LayerSurroundings made;
        made.address = {1, 0};
        made.space_level = level;
        made.finest_level = 4;
        made.nodes = &nodes;
        made.time_parent = &top_nodes.node[0];
        made.layers = {{&top[0], &top[1]}, {&own[0], &own[1]}};
        return made;
    }
};

void expect_shown(const Shown& shown, Ref node, int level) {
    EXPECT_EQ(shown.node, node);
    EXPECT_EQ(shown.level, level);
}

TEST(LayerPlaces, RootsComeFirstHalfFirst) {
    const TwoHalves clip;
    const std::vector<Placed> found = places(clip.at(3));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].node, 0U);
    EXPECT_EQ(found[1].node, 1U);
    expect_shown(found[1].parent, make_ref(0, 0), 3);
    expect_shown(found[1].first, make_ref(1, 0), 3);
    EXPECT_FALSE(found[0].first.any());
    EXPECT_FALSE(found[0].coarse.any());
}

TEST(LayerPlaces, ANodeShownTwiceCountsWhereItIsShownFirst) {
    const TwoHalves clip;
    const std::vector<Placed> found = places(clip.at(4));
    ASSERT_EQ(found.size(), 3U);  // node 3 is shown nowhere
    const Placed& first = found[0];
    EXPECT_EQ(first.node, 0U);
    expect_shown(first.parent, make_ref(0, 0), 4);
    expect_shown(first.coarse, make_ref(1, 0), 3);
    expect_shown(first.parent_coarse, make_ref(0, 0), 3);
    const Placed& beside = found[1];
    EXPECT_EQ(beside.node, 1U);
    EXPECT_EQ(beside.x, 1);
    EXPECT_EQ(beside.y, 0);
    // The time-parent has no finer detail there.
    expect_shown(beside.parent, make_ref(0, 0), 3);
    const Placed& second = found[2];
    EXPECT_EQ(second.node, 2U);
    EXPECT_EQ(second.x, 1);
    EXPECT_EQ(second.y, 0);
    expect_shown(second.first, make_ref(1, 1), 4);
    expect_shown(second.coarse, make_ref(1, 1), 3);
}

// Looks for a place from the root, one step a level.
Shown shown_at(const LayerSurroundings& at, Ref root, int level, int x, int y) {
    Shown shown{root, kBrickLevel};
    while (shown.any() && shown.level < level) {
        const int bit = level - shown.level - 1;
        const int q = (x >> bit & 1) + 2 * (y >> bit & 1);
        const Ref child =
            at.node(shown.level, shown.node).child[static_cast<std::size_t>(q)];
        if (child == kNoDetailRef) break;
        shown = {child, shown.level + 1};
    }
    return shown;
}

void expect_same(const Shown& found, const Shown& wanted) {
    EXPECT_EQ(found.node, wanted.node);
    if (found.any()) {
        EXPECT_EQ(found.level, wanted.level);
    }
}

TEST(LayerPlaces, NeighboursAreWhatAWalkFromTheRootFinds) {
    int checked = 0;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        const LinkedClip clip = linked_clip(50, 64, 7, seed);
        std::map<std::pair<int, std::int64_t>, const Siblings*> by_address;
        for (const Siblings& own : clip.siblings)
            by_address[{own.address.time_level, own.address.index}] = &own;
        for (const Siblings& own : clip.siblings) {
            for (int level = kBrickLevel; level <= clip.shape.space_levels(); ++level) {
                LayerSurroundings at;
                at.address = own.address;
                at.space_level = level;
                at.finest_level = clip.shape.space_levels();
                at.nodes = &own.nodes;
                for (int k = 0; k <= own.address.time_level; ++k) {
                    const std::int64_t index =
                        k == 0 ? 0 : own.address.index >> (own.address.time_level - k);
                    const Siblings& above = *by_address.at({k, index});
                    auto& layers = at.layers.emplace_back();
                    for (const Layer& layer : above.layers) layers.push_back(&layer);
                    if (k == own.address.time_level - 1)
                        at.time_parent =
                            &above.nodes.node[k == 0 ? 0 : own.address.index & 1];
                }
                for (const Placed& placed : places(at)) {
                    // The first tree that shows the node there is the one it was found in.
                    bool found = false;
                    for (int half = 0; half < own.nodes.count && !found; ++half) {
                        for (std::size_t edge = 0; edge < kEdges && !found; ++edge) {
                            const TimeNode& node = own.nodes.node[half];
                            const auto shown = [&](const TimeNode& of, std::size_t e) {
                                return shown_at(
                                    at, of.root[e], level, placed.x, placed.y);
                            };
                            const Shown self = shown(node, edge);
                            found = self.level == level &&
                                    self.node ==
                                        make_ref(own.address.time_level, placed.node);
                            if (!found) continue;
                            ++checked;
                            expect_same(placed.parent,
                                        at.time_parent == nullptr
                                            ? Shown{}
                                            : shown(*at.time_parent, edge));
                            expect_same(
                                placed.first,
                                half == 0 ? Shown{} : shown(own.nodes.node[0], edge));
                            expect_same(placed.other_edge,
                                        edge == 0 ? Shown{} : shown(node, 0));
                        }
                    }
                    EXPECT_TRUE(found);
                }
            }
        }
    }
    EXPECT_GT(checked, 100);
}

TEST(LayerPlaces, ABrickIsEnlargedByItsPixels) {
    Brick brick;
    for (int i = 0; i < kBrickPixels; ++i)
        brick[i] = {static_cast<std::uint8_t>(i), 0, 0, 255};
    Brick out;
    enlarge(brick, 2, 5, 2, out);  // place (5, 2) of the 4 x 4 that the brick becomes
    for (int y = 0; y < kBrickSide; ++y) {
        for (int x = 0; x < kBrickSide; ++x)
            EXPECT_EQ(out[y * 8 + x].r, (4 + y / 4) * 8 + 2 + x / 4);
    }
}

}  // namespace
}  // namespace haarmony::video::testing
