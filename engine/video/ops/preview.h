// One picture of a composition at once, from the averages that its clips have already.
//   compose.h -> [preview.h]
//
// The averaged frames are composited, where the final clip averages composited frames;
// the two differ by how much Porter and Duff's "compositing assumption" is violated. At
// single frames and the finest level they are the same. A layer whose frames do not
// coincide with a time node of its clip is averaged from the nodes that cover them, and
// where its level does not coincide with one of its clip's, the pixel in the middle is
// taken.
//
// Errors   as composed_shape(); an address or level outside the composition, param
//          time_level, index or level; what the clips' storage meets.
// Cost     of one layer: linear in the squares of at most two time nodes a time level.
// Source   sec. 5.4.4 [preview mode].
#pragma once

#include <span>

#include "engine/core/result.h"
#include "engine/video/ops/compose.h"
#include "engine/video/picture.h"

namespace haarmony::video {

[[nodiscard]] Result<Picture> preview(std::span<const CompositionLayer> layers,
                                      const FrameFormat& canvas,
                                      const NodeAddress& at,
                                      int level);

}  // namespace haarmony::video
