// One frame as a quadtree of bricks: as a source hands it in, and with its exact averages.
//   pixel.h, brick.h -> [image_tree.h] -> build.h (up-links) -> time_tree.h
//
// Shape    the root brick is the frame's root square at space level 3; the brick below
//          quadrant q of a brick at level l is its square at level l + 1, down to the finest
//          level that has detail. A missing child means: no finer detail, each pixel is one
//          flat square. A frame whose space_levels are below 3 is held as if it were scaled
//          up to a square of 8: its finest pixels are squares of several.
//          What lies outside width x height is clear.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Source   sec. 5.2.1, Figure 5.2; sec. 5.3.1, CreateFrame() [adaptive sources].
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/video/brick.h"

namespace haarmony::video {

// Index of a node or of a brick in the tree that it belongs to.
inline constexpr std::uint32_t kNoDetail = 0xFFFF'FFFF;

struct TreeNode {
    std::uint32_t brick = kNoDetail;
    std::array<std::uint32_t, 4> child = {kNoDetail, kNoDetail, kNoDetail, kNoDetail};

    friend bool operator==(const TreeNode&, const TreeNode&) = default;
};

// A frame of a source. Pixels of a brick count where the quadrant has no child; above a
// child they mean nothing (a node may then have no brick at all, if it has four children).
struct ImageTree {
    std::vector<TreeNode> nodes;
    std::vector<Brick> bricks;
    std::uint32_t root = kNoDetail;  // the node of level 3; a tree always has one
};

// What averages of squares that cross the picture's edge count: the clear padding too (the
// dissertation's), or only the samples inside the picture.
enum class Edge : std::uint8_t { kPad = 0, kNormalize = 1 };
inline constexpr int kEdges = 2;

// The square of non-clear pixels, in pixels of the finest level; empty where right <= left.
struct Bounds {
    std::int32_t left = 0;
    std::int32_t top = 0;
    std::int32_t right = 0;
    std::int32_t bottom = 0;

    [[nodiscard]] bool empty() const { return right <= left || bottom <= top; }
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

// A time node with every average rounded once from exact sums, and pruned without loss: a
// quadrant has a child exactly where some finer pixel differs from the one that it lies in.
// Every brick counts in full. The two trees share all nodes that no edge crosses.
struct ExactFrame {
    std::vector<TreeNode> nodes;
    std::vector<Brick> bricks;
    std::array<std::uint32_t, kEdges> root = {kNoDetail, kNoDetail};  // by Edge
    std::array<Apex, kEdges> apex{};
    Bounds bounds;

    friend bool operator==(const ExactFrame&, const ExactFrame&) = default;
};

}  // namespace haarmony::video
