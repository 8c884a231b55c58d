// A tree scaled and moved onto a canvas in one walk: the dissertation's "third function".
//   leaf_tree.h, placement.h -> [place.h] -> compose.h, preview.h
//
// Shape    the canvas is a frame of its own format, clear where the tree does not reach;
//          what reaches beyond it is cut off.
// Errors   none; a wrong shape is a caller's bug and asserts.
// Cost     linear in the squares of the tree and of the result, both of which are
//          counted: what is flat is looked at once, however large.
// Source   sec. 5.3.3, TranslateFrame(), ScaleNode(), PutRectInTree(), on leaf frames;
//          ERRATA of the project, video 18 to 21.
#pragma once

#include <cstdint>

#include "engine/video/clip_shape.h"
#include "engine/video/image_tree.h"
#include "engine/video/ops/leaf_tree.h"

namespace haarmony::video {

// Which pixels of the canvas pixel u of the tree's finest level becomes:
// floor((u scale + add) / 2^halvings) up to, not including, that of u + 1.
struct Mapping {
    std::int64_t scale_x = 1;
    std::int64_t scale_y = 1;
    std::int64_t add_x = 0;
    std::int64_t add_y = 0;
    int halvings = 0;
};

// `levels` are the space levels of `tree`, its finest pixels 2^levels to the root square.
// Requires: scales >= 1, 0 <= halvings <= 32, results within 2^44.
Visited place(const ImageTree& tree,
              int levels,
              const Mapping& mapping,
              const FrameFormat& canvas,
              ImageTree& out);

}  // namespace haarmony::video
