// Frames become a video, or go on with one: built into a file, counted, and kept with its row.
//
//   video_job -> [video_build] -> engine/video/build.h, mrv_writer.h
//                     '--> video_service
//
// Counts   seen: frames read, those of a video that grows among them; updated: time nodes
//          written; added: 1 at the end of a new video.
// Result   video: its id.
// Errors   those of the source and of the build; kTooLarge before the disk is full: a clip
//          waits there without loss while it is built, and the database needs room, too. A
//          job that was interrupted ends without an error and without a video.
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

// The video's frames, and then those of `source` (at most `most`, unless that is 0; `frames`
// where it is known how many there will be): its file is copied, frames are appended to the copy, and the copy takes its place. A name or a delta
// is not asked for; signatures are made where the video has some.
// Errors: as video::append(); kNotFound: the video has been removed meanwhile.
[[nodiscard]] Result<void> append_to_video(JobContext& job,
                                           VideoService& videos,
                                           std::int64_t id,
                                           video::FrameSource& source,
                                           std::int64_t most,
                                           std::optional<std::int64_t> frames);

}  // namespace haarmony::server
