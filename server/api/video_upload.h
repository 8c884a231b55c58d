// POST /videos, POST /videos/{id}/frames: what is to become a video, or to follow upon the
// frames of one, checked before its job is queued.
//
//   Inputs, body -> [video_upload] -> server/app/video_request.h -> the job "video"
//
// Errors   400 for options of another type or unknown; 413 for JSON above Context::max_body;
//          415 for a body of no known kind; 422 for bytes that are not whole frames, leaves
//          that no frame can have, a shape outside the limits of a clip, frames of another
//          size or rate than those that they are to follow; 409 for a video with loss, which
//          cannot grow: all before there is a job. A film's shape is seen by its job.
#pragma once

#include "server/api/context.h"
#include "server/api/outcome.h"

namespace haarmony::server {

// 202 with the job and its Location.
[[nodiscard]] Reply post_video(const Context& context, const http::Request& request);
[[nodiscard]] Reply post_frames(const Context& context, const http::Request& request);

}  // namespace haarmony::server
