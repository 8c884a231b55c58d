// A frame painted as deep as it has detail: the dissertation's adaptive refinement.
//   [refine.h] -> julia.h, fluid.h, scene.h, ... -> frame_source.h
//
// A field is asked for the 64 pixels of a square, and says whether smaller ones would
// show more; where they would, its four quadrants are asked in turn.
//
// Units    finest pixels of the frame; the centre of pixel (0, 0) is at (0.5, 0.5).
// Errors   none; a wrong shape is a caller's bug and asserts.
// Cost     linear in the squares that have detail, and in those that the picture's edge
//          crosses.
// Source   sec. 5.3.1 ["the recursive function descends to varying depths"].
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "engine/video/brick.h"
#include "engine/video/clip_shape.h"
#include "engine/video/frame_source.h"
#include "engine/video/image_tree.h"

namespace haarmony::video {

// Eight by eight pixels, each `cell` finest pixels wide.
struct FieldSquare {
    std::int32_t left = 0;
    std::int32_t top = 0;
    std::int32_t cell = 1;

    // The centre of pixel i of the square's brick.
    [[nodiscard]] double x(int i) const { return left + (i % kBrickSide + 0.5) * cell; }
    [[nodiscard]] double y(int i) const { return top + (i / kBrickSide + 0.5) * cell; }
};

class Field {
  public:
    virtual ~Field() = default;
    // The pixels of a square, and whether smaller ones would show more. Also asked for
    // what lies beyond the picture's edge; that is cut off.
    [[nodiscard]] virtual bool sample(const FieldSquare& square, Brick& brick) const = 0;
    // How many frames it stays.
    [[nodiscard]] virtual std::int64_t stays() const { return 1; }
};

// Down to space level `depth` at most. Requires: the format has at least 3 space levels,
// kBrickLevel <= depth <= its space levels.
void refine(const Field& field, const FrameFormat& format, int depth, ImageTree& tree);

// What frame t shows.
using MovingField = std::function<std::unique_ptr<Field>(std::int64_t frame)>;

// The fields of frames 0 .. frames - 1. Requires: as refine().
[[nodiscard]] std::unique_ptr<FrameSource> refined_frames(const FrameFormat& format,
                                                          std::int64_t frames,
                                                          int depth,
                                                          MovingField field);

}  // namespace haarmony::video
