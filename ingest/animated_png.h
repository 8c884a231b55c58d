// An animated PNG, written while its pictures come.
//   video_sink.h -> png_chunks.h -> [animated_png.h]
//
// Each frame is the rectangle that differs from the frame before (one pixel where nothing
// does), and replaces what it covers. A frame's duration is one over the rate, as near as
// two 16-bit numbers come; the animation repeats for ever.
//
// Errors, threads  as video_sink.h; kTooLarge: more than 2^31 - 1 frames, or parts.
// Source  PNG specification, 3rd edition, 11.3.6.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "ingest/video_sink.h"

namespace haarmony::ingest {

[[nodiscard]] Result<std::unique_ptr<VideoSink>> open_animated_png(
    const VideoSinkOptions& options,
    FilmOutput output);

}  // namespace haarmony::ingest
