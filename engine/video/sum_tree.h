// The finest squares of many frames, added up: a quadtree of sums.
//   image_tree.h -> [sum_tree.h] -> exact_mean.h
//
// Shape   as an ImageTree: nodes from level 3 down, a brick counts where a quadrant has no
//         child; it has as much detail as the finest of what was added.
// Units   a pixel's sums are over time alone: those of any one of the finest pixels in it.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Cost    linear in the detail of what is added, and of where it is added.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/video/image_tree.h"
#include "engine/video/pixel.h"

namespace haarmony::video {

using SumBrick = std::array<PixelSum, kBrickPixels>;

class SumTree {
  public:
    // `tree` stays for `repeats` frames.
    void add(const ImageTree& tree, std::int64_t repeats);
    void add(const SumTree& other);
    // As new; keeps its storage.
    void clear();

    [[nodiscard]] std::int64_t frames() const { return frames_; }
    // Requires: frames() >= 1.
    [[nodiscard]] std::uint32_t root() const { return 0; }
    [[nodiscard]] const TreeNode& node(std::uint32_t index) const {
        return nodes_[index];
    }
    [[nodiscard]] const SumBrick& brick(std::uint32_t index) const {
        return bricks_[index];
    }

  private:
    template <typename Source>
    void add_node(std::uint32_t at, const Source& source, std::uint32_t node);
    void add_flat(std::uint32_t at, const SumBrick& sums);
    void add_brick(std::uint32_t at, const SumBrick& sums);
    std::uint32_t split(std::uint32_t at, std::size_t quadrant);

    std::vector<TreeNode> nodes_;
    std::vector<SumBrick> bricks_;
    std::int64_t frames_ = 0;
};

}  // namespace haarmony::video
