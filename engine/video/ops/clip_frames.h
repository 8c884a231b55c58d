// Frames of a clip, one after the other, as a source of frames.
//   leaf_tree.h -> [clip_frames.h] -> concatenate.h, build.h
//
// Frames that the clip has only once, however long they stay, are handed on once, with
// SourceFrame::repeats.
//
// Errors   range_frames: a range that is empty or not within the clip, param frames;
//          next(): what the clip's storage meets.
// Source   sec. 5.4.4 ["load video fragments"].
#pragma once

#include <cstdint>
#include <memory>

#include "engine/core/result.h"
#include "engine/video/clip_shape.h"
#include "engine/video/frame_source.h"
#include "engine/video/time_tree.h"

namespace haarmony::video {

// Single frames [range.first, range.end). `clip` must outlive the source.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> range_frames(const TimeTree& clip,
                                                                const FrameRange& range);

}  // namespace haarmony::video
