#include "engine/video/linked_nodes.h"

#include <gtest/gtest.h>

#include <vector>

namespace haarmony::video {
namespace {

constexpr std::uint32_t kMany = 1000;

LinkedNodes childless() {
    LinkedNodes nodes;
    for (std::uint32_t i = 0; i < kMany; ++i) {
        LinkedNode node;
        node.brick = make_ref(static_cast<int>(i % 7), 3 * i);
        nodes.push_back(node);
    }
    return nodes;
}

TEST(LinkedNodes, WithoutChildrenAreTheirBricksAlone) {
    const LinkedNodes plain = childless();
    LinkedNodes compact = plain;
    EXPECT_EQ(compact.memory_bytes(), kMany * sizeof(LinkedNode));
    compact.compact();
    EXPECT_EQ(compact.memory_bytes(), kMany * sizeof(Ref));
    ASSERT_EQ(compact.size(), kMany);
    const LinkedNodes& read = compact;
    for (std::uint32_t i = 0; i < kMany; ++i) {
        EXPECT_EQ(read.brick(i), make_ref(static_cast<int>(i % 7), 3 * i));
        EXPECT_EQ(read[i].brick, read.brick(i));
        for (const Ref child : read[i].child) EXPECT_EQ(child, kNoDetailRef);
    }
    compact.compact();
    EXPECT_EQ(compact, plain);
}

TEST(LinkedNodes, OneChildKeepsAllAsTheyAre) {
    for (std::size_t q = 0; q < 4; ++q) {
        LinkedNodes nodes = childless();
        nodes[kMany / 2].child[q] = make_ref(0, 0);
        const LinkedNodes plain = nodes;
        nodes.compact();
        EXPECT_EQ(nodes.memory_bytes(), kMany * sizeof(LinkedNode)) << q;
        EXPECT_EQ(nodes, plain) << q;
        EXPECT_EQ(plain.brick(5), make_ref(5, 15)) << q;
    }
}

TEST(LinkedNodes, AreEqualWhereTheirNodesAreHoweverHeld) {
    const LinkedNodes plain = childless();
    for (const bool compact : {false, true}) {
        LinkedNodes other = plain;
        if (compact) other.compact();
        EXPECT_EQ(plain, other);
        other = plain;
        other[kMany - 1].brick = make_ref(9, 9);
        if (compact) other.compact();
        EXPECT_NE(plain, other);
        other = plain;
        other[0].child[3] = make_ref(0, 1);
        if (compact) other.compact();
        EXPECT_NE(plain, other);
        other = plain;
        other.push_back(LinkedNode{});
        if (compact) other.compact();
        EXPECT_NE(plain, other);
    }
}

TEST(LinkedNodes, BeginAnewWhenCleared) {
    for (const bool assigned : {false, true}) {
        LinkedNodes nodes = childless();
        nodes.compact();
        LinkedNode node;
        node.brick = make_ref(1, 2);
        node.child[1] = make_ref(3, 4);
        if (assigned) {
            nodes.assign(2, node);
        } else {
            nodes.clear();
            EXPECT_TRUE(nodes.empty());
            EXPECT_EQ(nodes.memory_bytes(), 0U);
            nodes.resize(2, node);
        }
        nodes[1].brick = make_ref(5, 6);
        const LinkedNodes& read = nodes;
        EXPECT_EQ(read[0], node);
        EXPECT_EQ(read.brick(1), make_ref(5, 6));
        EXPECT_EQ(read.size(), 2U);
    }
}

TEST(LinkedNodes, NoneAreCompactToo) {
    LinkedNodes nodes;
    nodes.reserve(100);
    nodes.compact();
    EXPECT_TRUE(nodes.empty());
    nodes.push_back(LinkedNode{});
    EXPECT_EQ(nodes.size(), 1U);
    EXPECT_EQ(nodes, (LinkedNodes{LinkedNode{}}));
}

}  // namespace
}  // namespace haarmony::video
