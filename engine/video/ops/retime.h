// A clip at another speed: slower by frames that stay longer, faster by motion blur.
//   leaf_tree.h -> [retime.h] -> build.h
//
// Frame j of the result shows the time node that holds frame floor(j speed) of the clip,
// at the time level whose nodes are 2^m frames long, m = floor(log2 speed), or single
// frames where speed < 1. So a speed of 2^m shows all nodes of one time level in turn,
// and a speed of 1/n each frame n times; any other alternates between longer and shorter
// steps.
//
// Errors   retime(): a speed outside 1/65,536 .. 65,536, or a result longer than a clip
//          may be, param speed; next(): what the clip's storage meets.
// Source   sec. 5.4.1 ["motion-blurred fast-forward"], sec. 5.4.2 ["3:2 pulldown"].
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

struct Speed {
    std::int64_t numerator = 1;
    std::int64_t denominator = 1;
};

// `clip` must outlive the source.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> retime(const TimeTree& clip,
                                                          const Speed& speed);

}  // namespace haarmony::video
