// The finest squares of many frames, added up: a quadtree of sums.
//   image_tree.h, sum_brick.h -> [sum_tree.h] -> exact_mean.h
//
// Shape   as an ImageTree: nodes from level 3 down, a brick counts where a quadrant has no
//         child; it has as much detail as the finest of what was added.
// Units   a pixel's sums are over time alone: those of any one of the finest pixels in it.
// Errors  none; a wrong shape is a caller's bug and asserts.
// Cost    linear in the detail of what is added, and of where it is added.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/video/image_tree.h"
#include "engine/video/sum_brick.h"

namespace haarmony::video {

struct SumNode {
    std::uint32_t brick = kNoDetail;  // among those of its width
    SumWidth width = SumWidth::kShort;
    std::array<std::uint32_t, 4> child = {kNoDetail, kNoDetail, kNoDetail, kNoDetail};
};

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
    [[nodiscard]] const SumNode& node(std::uint32_t at) const { return nodes_[at]; }

    // Calls `visitor` with a node's ShortSums, NarrowSums or WideSums.
    // Requires: a node that has a brick.
    template <typename Visitor>
    decltype(auto) visit(const SumNode& node, Visitor&& visitor) const {
        assert(node.brick != kNoDetail);
        switch (node.width) {
            case SumWidth::kShort:
                return std::forward<Visitor>(visitor)(short_[node.brick]);
            case SumWidth::kNarrow:
                return std::forward<Visitor>(visitor)(narrow_[node.brick]);
            case SumWidth::kWide:
                break;
        }
        return std::forward<Visitor>(visitor)(wide_[node.brick]);
    }

  private:
    // What is being added, and to how many frames it brings the sum.
    struct Count {
        std::uint64_t before = 0;
        std::uint64_t added = 0;
    };

    template <typename Source>
    void add_tree(const Source& source, std::uint32_t root, std::int64_t frames);
    template <typename Source>
    void add_node(std::uint32_t at,
                  const Source& source,
                  std::uint32_t node,
                  const Count& count);
    template <typename Addend>
    void add_flat(std::uint32_t at, const Addend& addend, const Count& count);
    template <typename Addend>
    void add_brick(std::uint32_t at, const Addend& addend, const Count& count);
    std::uint32_t split(std::uint32_t at, std::size_t quadrant);
    void widen(SumNode& node, SumWidth width, std::uint64_t frames);

    std::vector<SumNode> nodes_;
    std::vector<ShortSums> short_;
    std::vector<NarrowSums> narrow_;
    std::vector<WideSums> wide_;
    std::int64_t frames_ = 0;
};

}  // namespace haarmony::video
