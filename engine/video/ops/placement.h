// How large a clip is shown and where: a scale, then a translation.
//   [placement.h] -> place.h, compose.h
//
// Scale    sx / 2^shrink and sy / 2^shrink. A shrink of n shows the clip's space level
//          L - n, whose pixels are exact averages, each repeated sx times across and sy
//          times down. The dissertation shrinks by levels added above instead, which
//          keeps all detail: for that, scale the other clips up.
// Units    dx, dy in pixels of space level at_level of the clip: 2^(L - at_level) pixels
//          of the canvas each. Positive is right and down.
// Errors   kInvalidArgument; param is scale, translate or at_level.
// Source   sec. 5.3.3, "Translating a video clip", "Scaling a video clip"; ERRATA of the
//          project, video 20, 21.
#pragma once

#include <cstdint>
#include <optional>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"

namespace haarmony::video {

struct Scale {
    std::int32_t x = 1;
    std::int32_t y = 1;
    int shrink = 0;

    friend bool operator==(const Scale&, const Scale&) = default;
};

// From numbers that are positive integers over a power of two, in lowest terms.
[[nodiscard]] Result<Scale> scale_of(double x, double y);

struct Placement {
    Scale scale = {};
    std::int64_t dx = 0;
    std::int64_t dy = 0;
    std::optional<int> at_level = {};  // the clip's L if not said
};

// Where the clip lies on the canvas, in pixels of the canvas's finest level.
struct CanvasBox {
    std::int64_t left = 0;
    std::int64_t top = 0;
    std::int64_t width = 0;
    std::int64_t height = 0;

    friend bool operator==(const CanvasBox&, const CanvasBox&) = default;
};

// Refuses a scale of zero, a shrink below level 0, an at_level outside 0 .. L, and what
// is larger or further away than 2^32 pixels.
[[nodiscard]] Result<CanvasBox> placed_box(const ClipShape& clip,
                                           const Placement& placement);

}  // namespace haarmony::video
