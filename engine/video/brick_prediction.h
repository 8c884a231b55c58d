// What a brick is expected to look like, from what is decoded already.
//   brick_kernel.h -> [brick_prediction.h] -> brick_coder.h
//
// Shape   MRV.md, "Bricks", has every formula.
// Errors  none; a reference that is not there is a caller's bug and asserts.
// Source  the mirror is the time tree's own: a mean and one half determine the other.
#pragma once

#include <cstdint>

#include "engine/video/brick.h"

namespace haarmony::video {

// What a brick is predicted from.
enum class Reference : std::uint8_t {
    kBefore,        // the brick coded before; grey at first
    kParent,        // what the time-parent shows at the place
    kMirror,        // 2 parent - first half, in the second half
    kCoarse,        // the brick above it in the image tree, smoothly enlarged
    kParentCoarse,  // the time-parent, moved by as much as the coarse bricks differ
    kOtherEdge,     // what the tree of the other edge rule shows at the place
};
inline constexpr int kReferences = 6;

// The bricks around a brick; null where there is none. Of the two coders, which know it, comes
// the brick before.
struct BrickNeighbors {
    const Brick* parent = nullptr;
    const Brick* first = nullptr;
    const Brick* coarse = nullptr;
    const Brick* parent_coarse = nullptr;
    const Brick* other_edge = nullptr;
    int quadrant = 0;  // of the coarse bricks
    const Brick* before = nullptr;
};

inline constexpr Brick kGrey = [] {
    Brick grey;
    grey.fill({128, 128, 128, 255});
    return grey;
}();

// Whether the brick has what the reference needs.
[[nodiscard]] bool possible(Reference reference, const BrickNeighbors& neighbors);
// Room for a prediction and what it is made of: kept by the caller, since filling it with
// zeros anew takes as long as predicting.
struct PredictionRoom {
    Brick made;
    Brick enlarged;
    Brick parent_enlarged;
};
// The prediction: one of the neighbours, or room.made. Requires: possible(reference, neighbors).
[[nodiscard]] const Brick& predict(Reference reference,
                                   const BrickNeighbors& neighbors,
                                   PredictionRoom& room);

}  // namespace haarmony::video
