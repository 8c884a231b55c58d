// The next time node to be shown on a way through a clip that leaves no frame out.
//   clip_shape.h -> [advance.h] -> playback.h, scrub.h
//
// A front parts what was shown from what was not; the node that holds the frame beyond it
// goes on: a small one where the way is slow, a blurred one where it is fast.
//
// Units   frames; a position p lies in frame floor(p), forwards 0 .. frames.
// Errors  none; a wrong argument is a caller's bug and asserts.
// Source  sec. 5.4.2 ["alternating between ... two adjacent levels"], 5.4.3.
#pragma once

#include <cstdint>

#include "engine/video/clip_shape.h"

namespace haarmony::video {

enum class Direction : std::int8_t { kForwards = 1, kBackwards = -1 };

// The end of a range that lies in a direction: the front once it was shown.
[[nodiscard]] inline std::int64_t front_of(const FrameRange& shown, Direction direction) {
    return direction == Direction::kForwards ? shown.end : shown.first;
}
// Whether there is a frame beyond a front.
[[nodiscard]] inline bool at_end(const ClipShape& shape,
                                 std::int64_t front,
                                 Direction direction) {
    return front == (direction == Direction::kForwards ? shape.frames() : 0);
}

// Of the nodes that hold the frame beyond `front` that which goes furthest, but not beyond
// `limit`; the finest of those, or the single frame if none does.
// Requires: not at_end(), 0 <= front <= frames.
[[nodiscard]] NodeAddress furthest_node(const ClipShape& shape,
                                        std::int64_t front,
                                        Direction direction,
                                        double limit);

// The same at a steady pace of `step` frames, by two adjacent sizes only and without showing
// a frame twice: the front is then always less than a step (or a frame) away from a target
// that moves by `step` each time. A front that lags by more than three steps catches up by
// furthest_node(). Requires: as above, step > 0.
[[nodiscard]] NodeAddress steady_node(const ClipShape& shape,
                                      std::int64_t front,
                                      Direction direction,
                                      double target,
                                      double step);

}  // namespace haarmony::video
