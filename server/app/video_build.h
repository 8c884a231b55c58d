// Frames become a video: built into a file, counted, and kept with its row.
//
//   video_job -> [video_build] -> engine/video/build.h, mrv_writer.h
//                     '--> video_service
//
// Counts   seen: frames read; updated: time nodes written; added: 1 at the end.
// Result   video: its id.
// Errors   those of the source and of the build. A job that was interrupted ends without an
//          error and without a video.
// Threads  the job's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/core/result.h"
#include "engine/video/frame_source.h"
#include "server/app/job_context.h"
#include "server/app/video_request.h"
#include "server/app/video_service.h"

namespace haarmony::server {

// `frames` where it is known how many there will be.
[[nodiscard]] Result<void> build_video(JobContext& job,
                                       VideoService& videos,
                                       video::FrameSource& source,
                                       const VideoWishes& wishes,
                                       std::optional<std::int64_t> frames);

// A whole .mrv file, `path`, becomes a video: its row is added and the file renamed.
// Requires: its content is on the disk.
[[nodiscard]] Result<void> keep_video(JobContext& job,
                                      VideoService& videos,
                                      const std::string& path,
                                      const VideoWishes& wishes);

}  // namespace haarmony::server
