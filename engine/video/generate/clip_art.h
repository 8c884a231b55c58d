// Clips made on the spot and composed: what room and panorama are made of.
//   scene.h, compose.h -> [clip_art.h] -> room.h, panorama.h
//
// Errors  what building and composing meet.
// Cost    the clips are built, and held in memory, when the composition is made.
// Source  sec. 5.4.4.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/generate/recipe.h"
#include "engine/video/memory_clip.h"

namespace haarmony::video {

// Layers of clip-art for one canvas, lowest first.
class ClipArt {
  public:
    // Coordinates are parts of the canvas's height. `cell` is what one of the clip's
    // pixels takes of the recipe's depth: 1 is the finest detail, 4 a pixel of 4 x 4 of
    // those.
    explicit ClipArt(const Recipe& recipe);

    // What a piece of this size should be made as.
    [[nodiscard]] Recipe piece(double width, double height, int cell) const;
    // The clip's pixels in parts of the canvas's height.
    [[nodiscard]] double unit(int cell) const;
    // `source` becomes the next layer. One of a single frame stays to the end.
    [[nodiscard]] Result<void> add(FrameSource& source,
                                   double left,
                                   double top,
                                   int cell);
    // All layers as a source of frames that holds on to them. Leaves nothing behind.
    [[nodiscard]] Result<std::unique_ptr<FrameSource>> composed();

  private:
    struct Piece {
        std::unique_ptr<MemoryClip> clip;
        std::int64_t dx = 0;
        std::int64_t dy = 0;
        std::int32_t scale = 1;
    };
    Recipe recipe_;
    std::int32_t
        finest_;  // pixels of the canvas that a pixel of the recipe's depth is wide
    std::vector<Piece> pieces_;
};

}  // namespace haarmony::video
