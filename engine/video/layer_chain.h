// The layers of the siblings on the way from the root of the time tree to where a build is.
//   layer.h -> [layer_chain.h] -> near_match.h, up_links.h
//
// Shape    layers[k][l - kBrickLevel]: time level, then space level. A ref of a chain names
//          a node or brick of one of these.
// Errors   none; a ref of another chain is a caller's bug.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/video/layer.h"

namespace haarmony::video {

struct LayerChain {
    std::vector<std::vector<Layer>> layers;

    [[nodiscard]] LinkedNode node(int level, Ref ref) const {
        return layer(level, ref).nodes[index_of(ref)];
    }
    [[nodiscard]] Brick brick(int level, Ref ref) const {
        return layer(level, ref).bricks[index_of(ref)];
    }
    // Whether a brick is `brick`, byte for byte.
    [[nodiscard]] bool equals(int level, Ref ref, const Brick& brick) const {
        return layer(level, ref).bricks.equals(index_of(ref), brick);
    }

  private:
    [[nodiscard]] const Layer& layer(int level, Ref ref) const {
        return layers[static_cast<std::size_t>(time_level_of(ref))]
                     [static_cast<std::size_t>(level - kBrickLevel)];
    }
};

}  // namespace haarmony::video
