// Motion blur of any length: half a time node, or any range of frames.
//   time_tree.h, display.h -> [shutter.h]
//
// Scale   the mean of the fewest time nodes that cover the range, each as often as it has
//         frames, premultiplied, rounded once; exact where one node covers it.
// Errors  what the clip's storage meets.
// Cost    at most 2 time_levels nodes, whatever the range.
// Source  sec. 5.4.1 ["a limited degree of motion blur ... by descending one level deeper"].
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/display.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

// The first half of a time node: its first child; a single frame stays itself.
// Requires: clip.shape().contains(at).
[[nodiscard]] NodeAddress half_blur(const TimeTree& clip, const NodeAddress& at);

// The fewest nodes that hold exactly these frames, in order.
// Requires: 0 <= first < end <= frames.
[[nodiscard]] std::vector<NodeAddress> covering_nodes(const ClipShape& shape,
                                                      const FrameRange& range);

// The frames of a range averaged, drawn as draw() and zoom() do.
// Requires: what those and covering_nodes() require.
[[nodiscard]] Result<Picture> draw_shutter(const TimeTree& clip,
                                           const FrameRange& range,
                                           int level,
                                           Edge edge,
                                           const PixelBox& box);
[[nodiscard]] Result<Picture> zoom_shutter(const TimeTree& clip,
                                           const FrameRange& range,
                                           std::int32_t root_side,
                                           Edge edge,
                                           const PixelBox& box,
                                           Finer finer = Finer::kFlat);

}  // namespace haarmony::video
