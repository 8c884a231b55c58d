// The finest squares of many frames, added up: a quadtree of sums.
//   image_tree.h, sum_kernel.h -> [sum_tree.h] -> exact_mean.h
//
// Shape   as an ImageTree: nodes from level 3 down, a brick counts where a quadrant has no
//         child; it has as much detail as the finest of what was added.
// Units   a pixel's sums are over time alone: those of any one of the finest pixels in it.
//         Up to kMostSamples frames they have 32 bits, beyond that 64.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Cost    linear in the detail of what is added, and of where it is added.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/video/image_tree.h"
#include "engine/video/pixel.h"
#include "engine/video/sum_kernel.h"

namespace haarmony::video {

using WidePlanes = Planes<std::uint64_t>;

struct NarrowSums {
    // Whoever makes one fills it: to clear it first costs as much as to fill it.
    NarrowSums() {}

    SumPlanes planes;
    bool opaque;  // then there is no plane of alpha, and colours are not times alpha
};

// Sum i of a brick of so many samples.
[[nodiscard]] PixelSum sum_at(const SumPlanes& planes,
                              bool opaque,
                              std::uint64_t samples,
                              std::size_t i);
[[nodiscard]] PixelSum sum_at(const WidePlanes& planes, std::size_t i);

class SumTree {
  public:
    // `tree` stays for `repeats` frames.
    void add(const ImageTree& tree, std::int64_t repeats);
    void add(const SumTree& other);
    // As new; keeps its storage.
    void clear();

    [[nodiscard]] std::int64_t frames() const { return frames_; }
    [[nodiscard]] bool wide() const { return wide_; }
    // Requires: frames() >= 1.
    [[nodiscard]] std::uint32_t root() const { return 0; }
    [[nodiscard]] const TreeNode& node(std::uint32_t index) const {
        return nodes_[index];
    }
    // Requires: not wide().
    [[nodiscard]] const NarrowSums& narrow_brick(std::uint32_t index) const {
        return narrow_bricks_[index];
    }
    // Requires: wide().
    [[nodiscard]] const WidePlanes& wide_brick(std::uint32_t index) const {
        return wide_bricks_[index];
    }

  private:
    // `count` is how many frames an addend has.
    template <typename Source>
    void add_tree(const Source& source, std::uint32_t root, std::uint64_t count);
    template <typename Source>
    void add_node(std::uint32_t at,
                  const Source& source,
                  std::uint32_t node,
                  std::uint64_t count);
    template <typename Addend>
    void add_flat(std::uint32_t at, const Addend& addend, std::uint64_t count);

    void add_brick(std::uint32_t at, const Brick& pixels, std::uint64_t count);
    void add_brick(std::uint32_t at, const NarrowSums& sums, std::uint64_t count);
    void add_brick(std::uint32_t at, const WidePlanes& sums, std::uint64_t count);
    WidePlanes& wide_brick_of(std::uint32_t at);
    std::uint32_t split(std::uint32_t at, std::size_t quadrant);
    void widen();

    std::vector<TreeNode> nodes_;
    std::vector<NarrowSums> narrow_bricks_;
    std::vector<WidePlanes> wide_bricks_;
    std::int64_t frames_ = 0;
    bool wide_ = false;
};

}  // namespace haarmony::video
