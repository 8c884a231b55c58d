// A picture kept up to date: of the next frame only what differs from the last one is drawn.
//   time_tree.h, drawing.h -> [incremental_display.h]
//
// Two frames of one clip show the same content where their trees lead to the same node: what
// the dissertation's FIRST and LAST say of a run of up-links, decided by comparing the ends
// of the links, so that it holds forwards, backwards, and between any two frames.
//
// Shape   as display.h; the level and the box stay.
// Errors  none; frames of two clips are a caller's bug.
// Cost    proportional to the nodes that differ and the squares redrawn.
// Source  sec. 5.3.2 [up-links in display; bounding boxes]; ERRATA of the project, video 8,
//         9, 11.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "engine/video/picture.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

struct Redrawn {
    std::int64_t squares = 0;  // bricks, and quadrants without finer detail
    PixelBox box;              // around all that was redrawn; empty if nothing was

    friend bool operator==(const Redrawn&, const Redrawn&) = default;
};

// `out` shows `box` of `shown`, and afterwards of `next`. Squares replace what was there,
// clear ones too. Requires: as draw(), for both frames.
Redrawn draw_changes(const Frame& shown,
                     const Frame& next,
                     int level,
                     Edge edge,
                     const PixelBox& box,
                     Rgba* out,
                     std::ptrdiff_t stride);

class IncrementalDisplay {
  public:
    IncrementalDisplay(int level, Edge edge, const PixelBox& box)
        : level_(level), edge_(edge), box_(box), picture_(box.width, box.height) {}

    // The first frame is drawn in full. Holds on to the frame until the next one.
    Redrawn show(Frame frame);
    [[nodiscard]] const Picture& picture() const { return picture_; }

  private:
    int level_;
    Edge edge_;
    PixelBox box_;
    Picture picture_;
    std::optional<Frame> shown_;
};

}  // namespace haarmony::video
