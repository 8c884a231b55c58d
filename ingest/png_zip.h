// A ZIP archive with one PNG a picture: 000000.png, 000001.png, ...
//   video_sink.h -> png_chunks.h, zip_writer.h -> [png_zip.h]
//
// Errors, threads  as video_sink.h.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "ingest/video_sink.h"

namespace haarmony::ingest {

[[nodiscard]] Result<std::unique_ptr<VideoSink>> open_png_zip(
    const VideoSinkOptions& options,
    FilmOutput output);

}  // namespace haarmony::ingest
