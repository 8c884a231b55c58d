// Frames from files of other programs: films, animations, and folders of numbered pictures.
//
//   video_job -> [video_media] -> ingest/video_source.h, picture_sequence.h
//
// Errors   those of the ingest library; for a folder kForbidden where one of its pictures
//          is a link to somewhere outside the media roots.
// Threads  one caller.
#pragma once

#include <memory>
#include <string>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "server/app/media_roots.h"

namespace haarmony::server {

// `path` is real: no link is left in it.
[[nodiscard]] Result<std::unique_ptr<video::FrameSource>> open_media(
    const std::string& path,
    const MediaRoots& media_roots);

}  // namespace haarmony::server
