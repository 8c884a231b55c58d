// An image tree written from its finest squares up, without what shows no detail.
//   create_frame.h -> [tree_writer.h] -> image_tree.h
//
// Errors  none; a wrong shape is a caller's bug and asserts.
// Cost    linear in what is written.
// Source  sec. 5.3.1, Figure 5.6: CreateFrame() and PruneTree() at delta 0.
#pragma once

#include <array>
#include <cstdint>

#include "engine/video/image_tree.h"

namespace haarmony::video {

// A square as the quadrant of the brick above it: with half the detail of its own brick. Each
// pixel is one of the four that it stands for; where they differ there is a node.
struct TreePart {
    std::uint32_t node = kNoDetail;
    std::array<Rgba, kBrickPixels / 4> pixels{};
};

class TreeWriter {
  public:
    // Empties the tree, but keeps its storage. The tree must outlive the writer.
    explicit TreeWriter(ImageTree& tree);

    // A square without finer detail.
    [[nodiscard]] TreePart add(const Brick& brick);
    // A square made of its four quadrants, added before.
    [[nodiscard]] TreePart join(const std::array<TreePart, 4>& quadrants);
    // The last square is the root.
    void finish(const TreePart& root);

  private:
    ImageTree& tree_;
};

}  // namespace haarmony::video
