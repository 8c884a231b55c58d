// The image trees of siblings against those of their time-ancestors: what is shown there
// already becomes an up-link, the rest is the siblings' own.
//   image_tree.h -> near_match.h, content_table.h -> [up_links.h] -> build.h
//
// At delta 0 a node or brick is linked exactly where its content, averages and all that lies
// below included, is byte for byte that of a time-ancestor or of the brother: at the same
// place or at any other. At delta > 0 also where the time-parent shows, at the same place and
// at every space level, pixels within delta of the exact ones; and detail is left out where
// the pixels above it are within delta of it.
//
// Errors   kTooLarge: more nodes or bricks of one space level than a Ref can name.
// Cost     linear in the bricks of the frames (near_match.h at delta > 0).
// Threads  one caller.
// Source   sec. 5.2.2, 5.3.1, Figures 5.6, 5.7; ERRATA of the project, video 1 to 7, 12, 13.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/content_table.h"
#include "engine/video/image_tree.h"
#include "engine/video/layer.h"
#include "engine/video/layer_chain.h"
#include "engine/video/near_match.h"

namespace haarmony::video {

class UpLinks {
  public:
    // `delta` in units of difference(). Nodes and bricks of a layer have indices up to
    // max_index. Requires: max_index <= kMaxRefIndex.
    UpLinks(int space_levels,
            std::uint32_t delta,
            std::uint32_t max_index = kMaxRefIndex);
    UpLinks(const UpLinks&) = delete;
    UpLinks& operator=(const UpLinks&) = delete;

    // Begins siblings one time level further down; first of all the root.
    void descend();
    // The next of the siblings. Requires: descend() was called; `parent` is their time-parent
    // as it was linked, or null for the root.
    [[nodiscard]] Result<TimeNode> link(const ExactFrame& frame, const TimeNode* parent);
    // What the siblings linked since descend() have of their own.
    [[nodiscard]] const std::vector<Layer>& layers() const {
        return chain_.layers[static_cast<std::size_t>(depth_) - 1];
    }
    // Leaves the siblings, of which nothing more is below.
    void ascend();

  private:
    // The node that stands for node `index` of the frame, whose time-parent has `above`.
    Ref resolve(const ExactFrame& frame, std::uint32_t index, int level, Ref above);
    // `above` is the brick that the time-parent shows, if any.
    Ref brick_for(const Brick& exact, int level, Ref above);
    Ref own(const Brick& brick, int level);
    Ref own(const LinkedNode& node, int level);
    // Of the finest level, where a node is its brick: one look-up instead of two.
    Ref own_finest(const Brick& brick);
    template <typename List, typename T>
    Ref append(List& to, const T& what, int level);
    [[nodiscard]] Layer& own_layer(int level) {
        return chain_.layers[static_cast<std::size_t>(depth_) - 1]
                            [static_cast<std::size_t>(level - kBrickLevel)];
    }

    int finest_;
    std::uint32_t delta_;
    std::uint32_t max_index_;
    int depth_ = 0;     // time levels begun
    LayerChain chain_;  // its storage stays when depth_ falls
    ContentTable table_;
    std::vector<std::size_t> marks_;
    NearMatch near_;
    std::vector<Ref> resolved_;  // by node of the frame
    int full_level_ = -1;        // the space level with too many, or -1
};

}  // namespace haarmony::video
