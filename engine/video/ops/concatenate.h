// Sources of frames, one after the other.
//   clip_frames.h -> [concatenate.h] -> build.h
//
// Errors   concatenate(): no source at all, or one whose frames are of another size than
//          the first's, param clips; next(): what the sources meet.
#pragma once

#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"

namespace haarmony::video {

// The pace is the first one's: frames are lined up one to one, whatever their rate was.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> concatenate(
    std::vector<std::unique_ptr<FrameSource>> sources);

}  // namespace haarmony::video
