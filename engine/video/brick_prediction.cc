#include "engine/video/brick_prediction.h"

#include <cassert>

#include "engine/video/brick_kernel.h"

namespace haarmony::video {

bool possible(Reference reference, const BrickNeighbors& neighbors) {
    switch (reference) {
        case Reference::kBefore:
            return neighbors.before != nullptr;
        case Reference::kParent:
            return neighbors.parent != nullptr;
        case Reference::kMirror:
            return neighbors.parent != nullptr && neighbors.first != nullptr;
        case Reference::kCoarse:
            return neighbors.coarse != nullptr;
        case Reference::kParentCoarse:
            return neighbors.parent != nullptr && neighbors.coarse != nullptr &&
                   neighbors.parent_coarse != nullptr;
        case Reference::kOtherEdge:
            return neighbors.other_edge != nullptr;
    }
    return false;
}

const Brick& predict(Reference reference,
                     const BrickNeighbors& neighbors,
                     PredictionRoom& room) {
    assert(possible(reference, neighbors));
    switch (reference) {
        case Reference::kBefore:
            return *neighbors.before;
        case Reference::kParent:
            return *neighbors.parent;
        case Reference::kMirror:
            shift(*neighbors.parent, *neighbors.parent, *neighbors.first, room.made);
            break;
        case Reference::kCoarse:
            smooth(*neighbors.coarse, neighbors.quadrant, room.made);
            break;
        case Reference::kParentCoarse:
            smooth(*neighbors.coarse, neighbors.quadrant, room.enlarged);
            smooth(*neighbors.parent_coarse, neighbors.quadrant, room.parent_enlarged);
            shift(*neighbors.parent, room.enlarged, room.parent_enlarged, room.made);
            break;
        case Reference::kOtherEdge:
            return *neighbors.other_edge;
    }
    return room.made;
}

}  // namespace haarmony::video
