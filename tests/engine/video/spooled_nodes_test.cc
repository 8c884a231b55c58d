#include "engine/video/spooled_nodes.h"

#include <gtest/gtest.h>

namespace haarmony::video {
namespace {

SpooledNode varied(std::uint64_t head) { return {{head, 0}, false}; }
SpooledNode uniform(std::uint64_t head) { return {{head, 0}, true}; }

TEST(SpooledNodes, EveryNodeIsFoundByHeightAndIndex) {
    SpooledNodes nodes;
    nodes.add(0, 0, uniform(1));
    nodes.add(0, 1, uniform(2));
    nodes.add(1, 0, varied(3));
    nodes.add(0, 2, uniform(4));
    nodes.add(1, 1, varied(5));
    nodes.add(2, 0, varied(6));
    EXPECT_EQ(nodes.at(0, 0).frame.head, 1U);
    EXPECT_EQ(nodes.at(0, 1).frame.head, 2U);
    EXPECT_EQ(nodes.at(0, 2).frame.head, 4U);
    EXPECT_EQ(nodes.at(1, 0).frame.head, 3U);
    EXPECT_EQ(nodes.at(1, 1).frame.head, 5U);
    EXPECT_EQ(nodes.at(2, 0).frame.head, 6U);
    EXPECT_TRUE(nodes.at(0, 0).uniform);
    EXPECT_FALSE(nodes.at(2, 0).uniform);
    EXPECT_EQ(nodes.size(), 6U);
}

TEST(SpooledNodes, NothingIsKeptBelowAUniformNode) {
    SpooledNodes nodes;
    nodes.add(0, 0, uniform(1));
    nodes.add(0, 1, uniform(2));
    nodes.add(1, 0, varied(3));
    nodes.add(0, 2, uniform(4));
    nodes.add(0, 3, uniform(4));
    EXPECT_EQ(nodes.size(), 5U);
    nodes.add(1, 1, uniform(4));
    EXPECT_EQ(nodes.size(), 4U);
    EXPECT_EQ(nodes.at(0, 1).frame.head, 2U);
    EXPECT_EQ(nodes.at(1, 1).frame.head, 4U);
    // A run of which only the top was ever known.
    nodes.add(20, 1, uniform(7));
    EXPECT_EQ(nodes.size(), 5U);
    nodes.add(21, 0, uniform(8));
    EXPECT_EQ(nodes.size(), 1U);
    EXPECT_EQ(nodes.at(21, 0).frame.head, 8U);
}

}  // namespace
}  // namespace haarmony::video
