// Films that libav encodes, in a child process (haarmony-video).
//   video_sink.h -> [film_child.h] -> libav_film.h
//
// Errors, threads  as video_sink.h.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "ingest/video_sink.h"

namespace haarmony::ingest {

// Requires: options.container is kMp4 or kWebm.
[[nodiscard]] Result<std::unique_ptr<VideoSink>> open_film_child(
    const VideoSinkOptions& options,
    FilmOutput output);

}  // namespace haarmony::ingest
